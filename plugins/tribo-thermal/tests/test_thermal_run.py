"""Temperature in runs of the whole program, as the lab and the README show it."""

import runpy
import tomllib
from pathlib import Path

import pytest
from tribo import Simulation
from tribo.lab.report import lab_report

from tribo_thermal.plugin import EXAMPLE, tribo_figures

# The case is small, and its stroke is the paper's.
pytestmark = [
    pytest.mark.filterwarnings(f"ignore:{about}:tribo.TriboWarning")
    for about in ("resolution", "averaging")
]

HERE = Path(__file__).parent


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sharing", "friction", "energy"),
    [("shared", 0.3, 100), ("held hot", 0.1, 25)],
)
def test_ten_to_one_says_what_the_readme_shows(sharing, friction, energy):
    ten_to_one = runpy.run_path(str(HERE.parent / "examples" / "ten_to_one.py"))
    rows = (HERE.parent / "README.md").read_text().splitlines()
    (row,) = (row for row in rows if row.startswith(f"{sharing:<10}{friction:>9}"))
    shown = row.split()[-3:][ten_to_one["ENERGIES"].index(energy)]
    ratio = ten_to_one["ratio"](friction, energy, sharing)
    assert f"{ten_to_one['rounded'](ratio):g}" == shown


def test_the_lab_is_told_the_temperature_that_the_wear_followed():
    data = tomllib.loads(EXAMPLE.read_text())
    data["kinematics"]["duration"] = 20
    with Simulation(data).run() as result:
        ball, disk = lab_report(result).rows
        (draw,) = tribo_figures(result).values()
        first, second = draw().axes[0].lines
        ambient = result.case_tables["effects"][0]["ambient"]
    assert ball.value == disk.value
    # The first contact is the smallest, and so the hottest; its rise is that of a lone source.
    assert ambient + 5 < ball.value < ambient + 50
    assert ball.unit == "K"
    assert max(first.get_ydata()) == ball.value
    # Both are seen where they coincide.
    assert first.get_markersize() > second.get_markersize()
