"""Temperature and wear in runs of the whole program: implicit steps, stroke averages."""

import json
import math
import runpy
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner
from tribo import CaseError, ContactConditions, Simulation
from tribo.cli.main import tribo
from tribo.lab.report import lab_report

from tribo_thermal.flash import Flash
from tribo_thermal.plugin import EXAMPLE, tribo_figures

# The case is small, and its stroke is the paper's.
pytestmark = [
    pytest.mark.filterwarnings(f"ignore:{about}:tribo.TriboWarning")
    for about in ("resolution", "averaging")
]

HERE = Path(__file__).parent


def case(energy="50 kJ/mol", duration=300, **effect):
    data = tomllib.loads(EXAMPLE.read_text())
    data["kinematics"]["duration"] = duration
    data["effects"][0].update(effect)
    for body in data["bodies"].values():
        body["wear"]["activation_energy"] = energy
    return data


def lost(data):
    last = Simulation(data).run().saves()[-1]
    return {name: body["wear_volume_m3"] for name, body in last["bodies"].items()}


def test_bodies_that_share_a_temperature_lose_the_same_volume():
    volumes = lost(case())
    assert volumes["ball"] == pytest.approx(volumes["disk"], rel=1e-9, abs=0)


def faster(data, save):
    """By what Arrhenius multiplies the rate at a save, for the ball."""
    with Simulation(data).run() as result:
        pressure = result.field("pressure", save)
    model = Simulation(data).model
    conditions = ContactConditions(
        system=model.contact.system,
        pressure=pressure,
        speed=0.1,
        time=300.0,
        distance=30.0,
        swept=frozenset({"disk"}),
        track=2e-3,
        turns_back=True,
        fields={"friction_coefficient": {"ball": np.full(model.grid.cells, 0.1)}},
    )
    paths = {"ball": {"length": "5 mm", "area": "78.5 mm^2"}}
    rise = Flash(ambient="90 degC", heat_paths=paths).rises(conditions)["ball"]
    return math.exp(50e3 / 8.314462618 * (1 / 363.15 - 1 / (363.15 + rise)))


def test_a_warm_contact_wears_faster_than_archard():
    # More than k F s, by what Arrhenius makes of the rise at the end, when it is least.
    least = faster(case(), -1)
    ratio = lost(case())["ball"] / (3.11e-16 * 100 * 30)
    assert 1 < least < ratio < least**2


def largest_step(energy):
    """The longest stable explicit step at first, in s."""
    data = case(energy)
    data["stepping"] = {"type": "explicit", "time_step": "300 s"}
    with pytest.raises(CaseError, match="largest stable step") as refused:
        Simulation(data).run()
    return float(str(refused.value).split("stable step is ")[1].split(" s")[0])


def test_one_temperature_shortens_the_stable_step_as_it_raises_the_rate():
    # It follows the load and the size of the contact, not single cells.
    ratio = largest_step("0 J/mol") / largest_step("50 kJ/mol")
    assert ratio == pytest.approx(faster(case(), 0), rel=2e-3)


def test_the_body_that_takes_the_heat_wears_more():
    volumes = lost(case(heat_fraction={"ball": 1.0, "disk": 0.0}))
    assert volumes["disk"] == pytest.approx(3.11e-16 * 100 * 30, rel=1e-8, abs=0)
    assert volumes["ball"] > 1.5 * volumes["disk"]


def test_a_case_without_the_effect_is_refused():
    data = case()
    del data["effects"]
    with pytest.raises(CaseError, match="temperature"):
        Simulation(data)


def test_a_case_without_conductivity_ends_with_its_place():
    data = case()
    del data["bodies"]["ball"]["material"]["conductivity"]
    with pytest.raises(CaseError, match=r"bodies\.ball\.material\.conductivity"):
        Simulation(data).run()


@pytest.fixture(scope="module")
def ten_to_one():
    return runpy.run_path(str(HERE.parent / "examples" / "ten_to_one.py"))


def test_ten_to_one_needs_the_difference_that_it_says(ten_to_one):
    hotter = 363.15 + ten_to_one["needed_difference"](50)
    assert math.exp(50e3 / 8.314462618 * (1 / 363.15 - 1 / hotter)) == pytest.approx(10)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sharing", "friction", "energy"),
    [("shared", 0.3, 100), ("held hot", 0.1, 25)],
)
def test_ten_to_one_says_what_the_readme_shows(ten_to_one, sharing, friction, energy):
    rows = (HERE.parent / "README.md").read_text().splitlines()
    (row,) = (row for row in rows if row.startswith(f"{sharing:<10}{friction:>9}"))
    shown = row.split()[-3:][ten_to_one["ENERGIES"].index(energy)]
    ratio = ten_to_one["ratio"](friction, energy, sharing)
    assert f"{ten_to_one['rounded'](ratio):g}" == shown


def test_the_lab_is_told_the_temperature_that_the_wear_followed():
    with Simulation(case(duration=20)).run() as result:
        ball, disk = lab_report(result).rows
        (draw,) = tribo_figures(result).values()
        axes = draw().axes[0]
        first, second = axes.lines
        config = Flash.model_validate(result.case_tables["effects"][0])
    assert ball.value == disk.value
    # The first contact is the smallest, and so the hottest; its rise is that of a lone source.
    assert config.ambient + 5 < ball.value < config.ambient + 50
    assert ball.unit == "K"
    assert axes.get_ylabel() == "Temperature in the contact (K)"
    assert max(first.get_ydata()) == ball.value
    # Both are seen where they coincide.
    assert first.get_markersize() > second.get_markersize()


def test_the_temperature_is_shown_drawn_exported_and_in_the_dataset(tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr("tribo.plotting.figures.write_figures", lambda p, *_: drawn.extend(p) or [])
    file = tmp_path / "warm.h5"
    Simulation(case(duration=20)).run(file).close()
    for command in ("export", "plot"):
        done = CliRunner().invoke(tribo, [command, str(file)], catch_exceptions=False)
        assert done.exit_code == 0, done.output
    shown = CliRunner().invoke(tribo, ["show", str(file), "--json"], catch_exceptions=False)
    told = json.loads(shown.stdout)["saves"][-1]["bodies"]["ball"]["effects"]["temperature_K"]
    with xr.open_dataset(file) as dataset:
        stored = dataset.temperature.sel(body="ball").isel(time=-1)
        assert told["max"] == pytest.approx(float(stored.max()))
    assert any("temperature" in name for name in drawn)
    tables = "".join(p.read_text() for p in tmp_path.rglob("*.csv"))
    assert "temperature_K" in tables
