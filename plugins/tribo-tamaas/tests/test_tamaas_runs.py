"""The package of tamaas: its example, and what it says where tamaas is missing."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tribo import CaseError, ContactSystem, Grid

import tribo_tamaas.solver
from tribo_tamaas import Tamaas

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")

needs_tamaas = pytest.mark.skipif(
    tribo_tamaas.solver.find_spec("tamaas") is None,
    reason="tamaas is not installed: it has wheels for Linux on x86-64 only",
)


def test_without_tamaas_the_error_says_what_to_do(monkeypatch):
    monkeypatch.setattr(tribo_tamaas.solver, "find_spec", lambda _: None)
    system = ContactSystem(Grid((1e-3, 1e-3), (8, 8)), 1e11, 100.0)
    with pytest.raises(CaseError, match=r"pip install tamaas .* x86-64 only.* 'dcfft'"):
        Tamaas().check(system)


def test_offering_the_solver_does_not_import_tamaas():
    code = "import sys, tribo_tamaas.plugin; sys.exit('tamaas' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@needs_tamaas
def test_readme_and_example_run(capsys):
    code = README.split("```python\n")[1].split("```")[0]
    exec(compile(code, "README.md", "exec"), {"__name__": "readme"})
    first, second = capsys.readouterr().out.splitlines()
    assert first.split()[1] == second.split()[1] == "2153.335"
    namespace = {"__name__": "compare"}
    exec(compile((ROOT / "examples/compare.py").read_text(), "compare.py", "exec"), namespace)
    solution, seconds = namespace["solve"]("tamaas.half_space", 100.0, 0.7e-3, 32)
    assert np.max(solution.pressure) > 2e9
    assert seconds > 0
