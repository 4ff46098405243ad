"""Measured bodies in contact, and what a case is told."""

import json
import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from tribo import CaseError, ContactProblem, Simulation, TriboWarning, read_heights
from tribo.cli.main import tribo
from tribo.simulation.predict import predict

from tribo_topography.export import export_xyz

# SurfaceTopography, at its first import.
pytestmark = pytest.mark.filterwarnings("ignore:Could not import mpi4py:ImportWarning")

ROOT = Path(__file__).parents[1]
SIZE = 0.6e-3


def namespace(name, code):
    found = {"__name__": name}
    exec(compile(code, name, "exec"), found)
    return found


EXAMPLE = namespace("rough_ball", (ROOT / "examples/rough_ball.py").read_text(encoding="utf-8"))


@pytest.fixture
def case(tmp_path):
    def making(sq=0.2e-6):
        path = tmp_path / "ball.x3p"
        return EXAMPLE["case"](path, EXAMPLE["write_ball"](path, sq))

    return making


def test_smooth_ball_from_a_file_has_the_contact_of_a_paraboloid(case):
    measured = case(sq=0.0)
    exact = case(sq=0.0)
    exact["bodies"]["ball"]["surface"] = {"type": "paraboloid", "radius": "5 mm"}
    first, second = (Simulation(each).model.contact for each in (measured, exact))
    # The spline through the pixels is a parabola too, but for what x3p rounds.
    np.testing.assert_allclose(first.gap, second.gap, rtol=0, atol=1e-14)


def test_rough_contact_is_smaller_and_harder_and_runs_in(case):
    model = Simulation(case()).model
    solution = model.case.contact.solve(
        ContactProblem(model.contact.system, model.contact.gap, model.contact.system.load)
    )
    assert solution.residuals.worst <= 1e-8
    smooth, rough = Simulation(case(sq=0.0)).run().saves(), Simulation(case()).run().saves()
    assert rough[0]["contact_area_m2"] < 0.8 * smooth[0]["contact_area_m2"]
    assert rough[0]["max_pressure_Pa"] == solution.pressure.max()
    assert rough[0]["max_pressure_Pa"] > 1.5 * smooth[0]["max_pressure_Pa"]
    assert rough[-1]["distance_m"] == pytest.approx(5.0)
    assert rough[-1]["max_pressure_Pa"] < 0.8 * rough[0]["max_pressure_Pa"]
    # Archard: the same load and path remove the same volume, however rough.
    volumes = [
        sum(save["bodies"][name]["wear_volume_m3"] for name in ("ball", "disk"))
        for save in (smooth[-1], rough[-1])
    ]
    assert volumes == pytest.approx(2 * [2 * 3.11e-16 * 40 * 5.0], rel=1e-6, abs=0)


def test_swept_rough_body_is_refused_with_a_remedy(case):
    swept = case()
    swept["kinematics"]["swept"] = "ball"
    with pytest.raises(CaseError, match=r"'ball' is swept .*'topography\.file' does; resolve"):
        Simulation(swept)


def test_window_beyond_the_measurement_names_both_sizes(case):
    wide = case()
    wide["grid"]["size"] = ["0.7 mm", "0.7 mm"]
    with pytest.raises(CaseError, match=r"bodies\.ball\.surface: the window of 0\.7 × 0\.7 mm"):
        Simulation(wide)


def test_mistake_in_the_case_is_told_at_its_place(case):
    wrong = case()
    wrong["bodies"]["ball"]["surface"]["expect_size"] = ["1 N", "2 mm"]
    with pytest.raises(CaseError, match=r"expect_size.*a length \[m\] is needed"):
        Simulation(wrong)
    zero = case()
    zero["bodies"]["ball"]["surface"]["height_scale"] = 0
    with pytest.raises(CaseError, match="height_scale is 0"):
        Simulation(zero)


def test_scale_that_nobody_confirmed_is_told_by_the_run(case):
    unconfirmed = case()
    del unconfirmed["bodies"]["ball"]["surface"]["expect_range"]
    with pytest.warns(TriboWarning, match=r"96 × 96 pixels on 0\.6 × 0\.6 mm, heights over 1"):
        Simulation(unconfirmed)


def test_what_the_file_was_read_as_is_kept_in_the_result_and_what_is_worn_exported(
    case, tmp_path, monkeypatch
):
    data = case()
    path = data["bodies"]["ball"]["surface"]["path"]
    data["kinematics"]["duration"] = "2 s"
    simulation = Simulation(data)
    facts = predict(simulation.model).facts["bodies.ball.surface"]
    assert facts["pixels"] == "96 × 96"
    assert facts["size"] == "0.6 × 0.6 mm"
    assert facts["read as"] == "x3p, 'Default'"
    assert facts["heights"].startswith("over 1")
    assert facts["sha256"] == sha256(Path(path).read_bytes()).hexdigest()
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
    monkeypatch.setattr("tribo.core.number_tables.MOST_PIXELS", 4000)
    with pytest.raises(CaseError, match=r"96 × 96 pixels: .*4,000"):
        read_heights(path)


def test_check_prints_it(case, tmp_path):
    surface = case()["bodies"]["ball"]["surface"]
    quoted = {key: json.dumps(value, default=str) for key, value in surface.items()}
    path = tmp_path / "case.toml"
    text = CASE.format(surface=", ".join(f"{key} = {value}" for key, value in quoted.items()))
    path.write_text(text)
    done = CliRunner().invoke(tribo, ["check", str(path)])
    assert done.exit_code == 0, done.output
    assert "96 × 96" in done.output
    assert sha256(Path(surface["path"]).read_bytes()).hexdigest() in done.output


CASE = """
[grid]
size = "0.5 mm"
cells = 40

[load]
normal = "40 N"

[bodies.ball]
surface = {{ {surface} }}
material = {{ young = "207 GPa", poisson = 0.3 }}
wear = {{ type = "archard", k = "3.11e-16 1/Pa" }}

[bodies.disk]
surface = "flat"
material = {{ young = "207 GPa", poisson = 0.3 }}

[kinematics]
type = "reciprocating"
stroke = "2 mm"
frequency = "25 Hz"
distance = "0.2 m"
positions = "average"
"""


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
