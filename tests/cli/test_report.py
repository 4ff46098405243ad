"""What a run ends with, in terminals of all widths."""

import io

import pytest
from made_results import made
from paper_models import archard, case, foundation, motion, pair

from tribo import Simulation, Stage
from tribo.cli.console import Console
from tribo.cli.lab_report import print_report


def printed(result, width=80):
    console = Console(file=io.StringIO(), width=width, highlight=False)
    print_report(result, console)
    return console.file.getvalue()


def row(text, label):
    """Cells of the row that begins with `label`."""
    return next(line for line in text.splitlines() if label in line).split(label)[1].split()


def brief(**changes):
    bodies = pair(archard(), archard(), hardness=(4e9, 4e9))
    kinematics = motion(duration=1)
    return Simulation(case(**{"bodies": bodies, "kinematics": kinematics, **changes})).run()


@pytest.mark.parametrize("width", [44, 80])
@pytest.mark.parametrize("names", [("ball", "disk"), ("upper-specimen-number-1", "lower_one")])
def test_no_number_is_cut(width, names):
    last = next(line for line in printed(made(names=names), width).splitlines() if "3600" in line)
    assert " ".join(last.split()) == "3600 360 143 143 1120 1200 1.050 27.95 1.026"


def test_a_body_that_does_not_wear_has_no_scar():
    text = printed(made(worn=(True, False)))
    assert row(text, "scar along sliding, mm") == ["1.100", "–"]
    assert row(text, "scar across, mm") == ["1.210", "–"]


def test_a_load_has_a_column_where_it_changes():
    assert " load " not in printed(made()).splitlines()[2]
    load = (Stage(until=0.5, normal=20), Stage(until=1, normal=100))
    with brief(load=load, contact=foundation(), save_times=(0.5,)) as result:
        lines = printed(result, 100).splitlines()
    column = lines[2].split().index("load")
    assert [line.split()[column] for line in lines[5:8]] == ["20", "20", "100"]
