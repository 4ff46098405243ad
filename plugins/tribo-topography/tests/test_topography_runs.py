"""Measured bodies in contact, and what a case is told."""

import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from tribo import CaseError, Simulation, read_heights
from tribo.simulation.predict import predict

from tribo_topography.export import export_xyz

# SurfaceTopography, at its first import.
pytestmark = pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")

ROOT = Path(__file__).parents[1]


def namespace(name, code):
    found = {"__name__": name}
    exec(compile(code, name, "exec"), found)
    return found


EXAMPLE = namespace("rough_ball", (ROOT / "examples/rough_ball.py").read_text(encoding="utf-8"))


def test_what_the_file_was_read_as_is_kept_in_the_result_and_what_is_worn_exported(tmp_path):
    path = tmp_path / "ball.x3p"
    data = EXAMPLE["case"](path, EXAMPLE["write_ball"](path, 0.2e-6))
    data["kinematics"]["duration"] = "2 s"
    simulation = Simulation(data)
    facts = predict(simulation.model).facts["bodies.ball.surface"]
    assert facts["read as"] == "x3p, 'Default'"
    assert facts["sha256"] == sha256(path.read_bytes()).hexdigest()
    with simulation.run() as result:
        assert result.provenance["components"]["bodies.ball.surface"]["facts"] == facts
        ball, _ = export_xyz(result, tmp_path / "points")
        x, y, height = np.loadtxt(ball).T.reshape(3, *result.grid.cells)
        np.testing.assert_allclose(height, result.body("ball").surface(-1), rtol=1e-8, atol=1e-18)
        np.testing.assert_allclose(x[:, 0], result.grid.x, rtol=1e-8)
        np.testing.assert_allclose(y[0], result.grid.y, rtol=1e-8)
        again = read_heights(ball)
        np.testing.assert_allclose(again.heights, height, rtol=1e-12, atol=1e-18)
        assert again.pitch == pytest.approx(result.grid.spacing, rel=1e-6)
    np.savetxt(tmp_path / "no_unit.xyz", np.loadtxt(ball))
    words = "states no unit for its heights; export it as .x3p"
    with pytest.raises(CaseError, match=words):
        read_heights(tmp_path / "no_unit.xyz")


def test_offering_the_surface_does_not_import_surfacetopography():
    code = "import sys, tribo_topography.plugin; sys.exit('SurfaceTopography' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_readme_and_example_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    namespace("readme", readme.split("```python\n")[1].split("```")[0])
    assert "64 × 48 pixels on 1.24 × 0.94 mm" in capsys.readouterr().out
    EXAMPLE["main"]()
    assert capsys.readouterr().out.count("GPa") == 2
