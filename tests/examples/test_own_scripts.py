"""A law, an effect and a solver of one's own, each a flat script that keeps the contract."""

import runpy
from pathlib import Path

import pytest

from tribo.testing import check

EXAMPLES = Path(__file__).parents[2] / "examples"
MODELS = {"own_law": "Threshold", "own_effect": "Debris", "own_solver": "Coated"}


@pytest.mark.slow
@pytest.mark.parametrize(("script", "model"), MODELS.items())
def test_each_model_keeps_the_contract(script, model):
    check(runpy.run_path(str(EXAMPLES / f"{script}.py"))[model])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::tribo.core.errors.TriboWarning")
@pytest.mark.parametrize(
    ("script", "shown"),
    [
        ("own_law", "Wear after 200 m"),
        ("own_effect", "debris thickness"),
        ("own_solver", "951 MPa"),
    ],
)
def test_each_script_runs(script, shown, capsys):
    runpy.run_path(str(EXAMPLES / f"{script}.py"), run_name="__main__")
    assert shown in capsys.readouterr().out
