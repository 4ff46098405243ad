"""Quantities that packages read off a run are measured values like any other."""

import sys
import tomllib
from importlib.util import find_spec

import pytest
from calibrations import cheap
from command_line import tribo
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError
from tribo.core.toml import to_toml
from tribo.registry.registry import default_registry

from tribo_inverse.calibration.calibrate import calibrate

with_models = pytest.mark.skipif(
    not (find_spec("tribo_energy") and find_spec("tribo_thermal")),
    reason="takes quantities of tribo-energy and tribo-thermal",
)
ENERGY = {
    "friction.coefficient": 0.1,
    "effects": ["energy.friction_traction"],
    "bodies.ball.wear": {"type": "energy.dissipation", "alpha": 1e-15},
    "bodies.disk.wear": {"type": "energy.dissipation", "alpha": 0.0},
}
ALPHA = "bodies.ball.wear.alpha"
MEASURED = {"quantity": "worn_volume_per_energy", "value": "2.5e-6 mm^3/J", "uncertainty": "4 %"}
K = "bodies.ball.wear.k"
FILE = """
from tribo import Column, Finding, Observer, hookimpl

class Ends(Observer):
    type = "test.ends"

    def findings(self, snapshot):
        return [Finding("stop", "far enough")] * (snapshot.state.distance > 5)

@hookimpl
def tribo_components():
    return [Ends]

def thickness(result, body):
    return result.saves()[-1]["bodies"][body]["wear_volume_m3"] / 1e-6

@hookimpl
def tribo_quantities():
    return [Column("thickness", "m", "mean depth on a square mm", thickness, of_bodies=True)]
"""


@with_models
def test_the_volume_for_each_joule_gives_a_coefficient_and_its_interval():
    case = apply_settings(cheap(100), ENERGY)
    found = calibrate(case, {"measured": [MEASURED], "fit": [{"path": ALPHA}]})
    (row,) = found.parameters.itertuples()
    # The ball alone wears, by α for each J.
    assert row.value == pytest.approx(2.5e-15, rel=1e-6, abs=0)
    assert row.upper - row.lower == pytest.approx(2 * 1.96 * 0.04 * 2.5e-15, rel=0.01, abs=0)


@pytest.fixture
def forgets():
    """Let no file take part after the test."""
    default_registry.cache_clear()
    yield
    sys.modules.pop("plugin_read")
    default_registry.cache_clear()


@pytest.mark.usefixtures("forgets")
def test_a_file_of_the_command_line_gives_a_quantity_and_an_observer_that_ends_runs(tmp_path):
    (tmp_path / "read.py").write_text(FILE)
    case = {**cheap(100), "observers": [{"type": "test.ends"}, {"type": "progress"}]}
    (tmp_path / "my.toml").write_text(to_toml(case))
    entry = {"body": "ball", "quantity": "thickness", "value": "6.22 nm", "uncertainty": "1 %"}
    (tmp_path / "seen.toml").write_text(to_toml({"measured": [entry]}))
    asked = "calibrate", "my.toml", "--measured", "seen.toml", "--plugin", "read.py"
    done = tribo(*asked, "-o", "fitted.toml", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    fitted = tomllib.loads((tmp_path / "fitted.toml").read_text())
    # Archard: 6.22e-15 m³ under 100 N over 5 m and a step, not over 10 m.
    assert 6.3e-18 < fitted["bodies"]["ball"]["wear"]["k"] < 12.44e-18


@with_models
@pytest.mark.parametrize(
    ("changes", "place", "words"),
    [
        ({"body": "ball"}, ".1", "leave body out"),
        ({"quantity": "highest_temperature", "value": "400 K"}, ".1", "give body"),
        ({"time": "10 s"}, ".1", "leave time out"),
        ({"value": "2 mm"}, ".1.value", "1/Pa"),
        ({"quantity": "dissipated_energi", "value": 2}, ".1.quantity", "'dissipated_energy'"),
    ],
)
def test_an_entry_that_does_not_fit_its_quantity_is_refused(changes, place, words):
    with pytest.raises(CaseError, match=words) as caught:
        calibrate(cheap(1), {"measured": [MEASURED | changes], "fit": [{"path": K}]})
    assert str(caught.value).startswith(f"measured{place}: ")


@with_models
def test_a_quantity_that_a_case_lacks_is_refused_by_its_place():
    with pytest.raises(CaseError, match=r"measured\.1: .* no worn_volume_per_energy"):
        calibrate(cheap(1), {"measured": [MEASURED], "fit": [{"path": K}]})
