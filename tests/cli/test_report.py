"""What a run ends with, in terminals of all widths."""

import io

import numpy as np
import pytest
from made_results import made
from paper_models import archard, case, foundation, motion, pair

from tribo import Effect, Field, Grid, Load, Simulation, Stage
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


@pytest.mark.parametrize("width", [44, 60, 80])
@pytest.mark.parametrize("names", [("ball", "disk"), ("upper-specimen-number-1", "lower_one")])
def test_no_number_is_cut_and_no_line_is_too_long(width, names):
    text = printed(made(names=names), width)
    assert "…" not in text
    assert max(map(len, text.splitlines())) <= width
    # The last save: the time and both depths are never left out.
    cells = next(line for line in text.splitlines() if line.split()[:1] == ["3600"]).split()
    assert cells[-2:] == ["27.95", "1.026"]


def test_a_narrow_terminal_is_told_what_it_misses():
    assert "Left out" not in printed(made(), 80)
    assert "Left out for want of width: area, p centre." in printed(made(), 60)


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


def test_a_load_that_changes_along_the_stroke_is_told():
    dx = 0.4e-3 / 20
    along = [{"at": -2 * dx, "share": 0.5}, {"at": 2 * dx, "share": 1.25}]
    with brief(
        grid=Grid((0.4e-3, 0.4e-3), (20, 20)),
        load=Load(normal=20, along=along),
        contact=foundation(),
        kinematics=motion(stroke=4 * dx, duration=0.05, positions="cells"),
    ) as result:
        text = printed(result, 100)
    assert "changes along the stroke, from 0.5 to 1.25 of the normal load" in text


class Warmth(Effect):
    type = "test.warmth"
    provides = (Field("warmth", "K", "How warm it is."),)

    def fields(self, contact):
        return {"warmth": dict.fromkeys(contact.materials, np.full((1, 1), 293.0))}


def test_what_effects_provide_is_shown():
    text = printed(brief(effects=[Warmth()]))
    assert row(text, "warmth, K") == ["293", "293", "293"]
    assert text.count("warmth") == 1


def test_yield_is_judged_by_the_pressure_that_was_computed():
    # On these springs it is beyond 1.6 H/2.8 = 2286 MPa, where Hertz's 2155 MPa is not.
    result = brief(contact=foundation())
    first = 1e-6 * result.saves()[0]["max_pressure_Pa"]
    text = " ".join(printed(result).split())
    assert first > 2285.7
    # Hertz's theory is no smooth limit of springs.
    assert "Hertz 2155.4 MPa;" in text
    assert "Hertz 2155.4 MPa (" in " ".join(printed(brief()).split())
    assert "; the softer body yields beneath the surface at first" in text
    assert f"{100 * first / 2285.7:.0f} % of 1.6 H/2.8" in text
    assert "94 % of the pressure at which the softer body first yields" in printed(
        brief(), width=200
    )
