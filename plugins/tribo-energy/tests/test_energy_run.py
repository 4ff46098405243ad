"""The energy law in runs of the whole program: implicit steps, stroke averages."""

import copy
import runpy
import tomllib
from pathlib import Path

import pytest
from tribo import CaseError, Simulation
from tribo.lab.report import lab_report

from tribo_energy.plugin import EXAMPLE, tribo_figures

HERE = Path(__file__).parent
ALPHA, MU, LOAD = 3.11e-15, 0.1, 100.0


def case(duration=100, cells=24, **wear):
    data = tomllib.loads(EXAMPLE.read_text())
    data["grid"] = {"size": "0.8 mm", "cells": cells}
    data["kinematics"]["duration"] = duration
    data["output"] = {}
    for body in data["bodies"].values():
        body["wear"].update(wear)
    return data


@pytest.mark.parametrize(
    ("without", "needs"),
    [("effects", "friction_traction"), ("friction", "coefficient of friction")],
)
def test_a_case_without_friction_is_refused(without, needs):
    data = copy.deepcopy(case())
    del data[without]
    with pytest.raises(CaseError, match=needs):
        Simulation(data)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:averaging:tribo.TriboWarning")
def test_the_readme_shows_what_the_example_prints(capsys):
    runpy.run_path(str(HERE.parent / "examples" / "compare_with_archard.py"), run_name="__main__")
    printed = capsys.readouterr().out.rstrip()
    archard, energy, half = (line.split(":")[1] for line in printed.splitlines())
    assert archard == energy != half
    assert printed in (HERE.parent / "README.md").read_text()


def test_the_lab_is_told_the_energy_and_the_volume_it_wore():
    data = tomllib.loads(EXAMPLE.read_text())
    data["kinematics"]["duration"], data["output"] = 50, {}
    with Simulation(data).run() as result:
        energy, volume = lab_report(result).rows
        (draw,) = tribo_figures(result).values()
        (axes,) = draw().axes
    assert axes.get_xlabel() == "Dissipated energy (J)"
    assert [line.get_linestyle() for line in axes.lines] == ["-", "--"]
    # Two bodies, each V = α Σ E.
    assert energy.value == pytest.approx(MU * LOAD * 2 * 2e-3 * 25 * 50, rel=1e-9, abs=0)
    assert volume.value == pytest.approx(2 * ALPHA, rel=1e-9, abs=0)
