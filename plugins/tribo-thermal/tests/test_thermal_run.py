"""Temperature and wear in runs of the whole program: implicit steps, stroke averages."""

import math
import runpy
import tomllib
from pathlib import Path

import pytest
from tribo import CaseError, Simulation
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
