"""The errors that the study of a case states are those that a finer run shows."""

from unittest.mock import Mock

import pytest
from paper_models import archard, flat, foundation, motion, named, paraboloid, small, steel

from tribo import Grid
from tribo.case import Stop
from tribo.core.errors import CaseError
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.verification import refinement
from tribo.verification.refinement import refine


def worn(**changes):
    parts = {
        "grid": Grid((0.7e-3, 0.7e-3), (49, 49)),
        "bodies": [named("ball", paraboloid(), steel(), archard()), named("disk", flat(), steel())],
        "contact": foundation(),
        "kinematics": motion(duration=200),
    }
    return small(**{**parts, **changes})


def by_name(study):
    return {estimate.name: estimate for estimate in study.estimates}


@pytest.fixture(scope="module")
def implicit():
    return refine(worn())


@pytest.mark.slow
def test_stated_uncertainties_cover_a_much_finer_run(implicit):
    stepping = Implicit(pressure_tolerance=0.005, depth_tolerance=1e-5, settle=1e-3)
    fine = refinement._run(worn(), (99, 99), stepping)
    found = by_name(implicit)
    # A body that does not wear is left out.
    assert not [name for name in found if name.startswith("disk")]
    for name, estimate in found.items():
        value = fine.end[name]
        assert abs(estimate.value - value) <= max(estimate.uncertainty, 1e-9 * value), name
        # The range of a width that is counted is at least a half of the coarsest cells.
        most = 0.2 if "width" in name else 0.1
        assert estimate.uncertainty < most * value, name
    # The volume is exact, and a counted width good to a cell.
    assert found["ball: volume"].uncertainty < 1e-12 * found["ball: volume"].value
    assert {"peak pressure": "Pa", "ball: volume": "m^3", "ball: scar across": "m"}.items() <= {
        name: estimate.unit for name, estimate in found.items()
    }.items()
    width = found["contact width along"]
    assert width.uncertainty >= width.floor == pytest.approx(0.7e-3 / 49)


@pytest.mark.slow
def test_explicit_steps_are_made_shorter_and_show_first_order():
    study = refine(worn(stepping=Explicit(time_step=2.0)))
    assert [level.steps for level in study.steps] == [100, 150, 225]
    assert study.grids[2] is study.steps[0]
    depth = by_name(study)["ball: largest depth"]
    assert depth.steps.order == pytest.approx(1.0, abs=0.1)
    # The uncertainty is that of the case's own steps, the longest.
    coarse, _, fine = depth.steps.values
    assert depth.steps.uncertainty > abs(coarse - fine)


def test_saves_do_not_keep_steps_from_being_refined(implicit):
    # One every half second would leave all three levels the same steps, and so no error at all.
    assert refine(worn(save_times=tuple(0.5 * i for i in range(400)))) == implicit


def test_of_a_run_that_ends_at_a_depth_the_path_is_what_is_uncertain(implicit):
    found = by_name(refine(worn(stop=Stop(depth="2 um"))))
    assert found["ball: largest depth"].uncertainty < 1e-4 * found["ball: largest depth"].value
    path = found["path slid"]
    assert 0 < path.uncertainty < 0.1 * path.value < 2
    assert "path slid" not in by_name(implicit)


def test_five_runs_are_announced_and_the_one_that_fails_is_named(monkeypatch):
    told = []
    refine(worn(kinematics=motion(duration=2)), told.append)
    assert len(told) == 5
    assert told[0].startswith("49 × 49 cells")
    monkeypatch.setattr(refinement, "_run", Mock(side_effect=CaseError("no contact")))
    with pytest.raises(CaseError, match=r"^49 × 49 cells.*: no contact"):
        refine(worn(kinematics=motion(duration=2)))
