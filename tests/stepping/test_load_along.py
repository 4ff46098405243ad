"""A load that changes along the stroke, against a plain loop over its cells."""

import pytest
from paper_models import foundation, motion, small
from stroke import GRID, STROKE

from tribo import CaseError, Load, Periodic, Place

HALVED = [(-6, 0.5), (-3, 1.0), (3, 1.0), (6, 0.5)]
"""Cells from the middle of the stroke, and the load there."""


def along(pairs=HALVED):
    dx = GRID.spacing[0]
    return tuple(Place(at=cells * dx, share=share) for cells, share in pairs)


def loaded(load, positions="cells", duration=200, **changes):
    kinematics = motion(stroke=STROKE, duration=duration, positions=positions)
    return small(grid=GRID, contact=foundation(), kinematics=kinematics, load=load, **changes)


@pytest.mark.parametrize(
    ("load", "changes", "words"),
    [
        (along(), {"positions": "average"}, "changes by [0-9.]+ % along the stroke"),
        (along(HALVED[1:]), {}, "give the load up to both ends"),
        (along(HALVED[:2]), {}, "give the load up to both ends"),
    ],
)
def test_a_load_along_the_stroke_that_does_not_fit_it_is_refused(load, changes, words):
    with pytest.raises(CaseError, match=rf"load\.along: .*{words}"):
        loaded(Load(normal=100, along=load), **changes)


def test_a_load_along_the_stroke_is_refused_of_a_contact_that_repeats():
    with pytest.raises(CaseError, match=r"load\.along: .*repeats with the window"):
        small(grid=GRID, contact=Periodic(), load=Load(normal=100, along=along()))


@pytest.mark.parametrize(
    ("pairs", "words"),
    [([(0, 1.0)], "one place"), ([(0, 1.0), (0, 2.0)], "increasing"), ([(0, 0.0)], "greater than")],
)
def test_places_that_make_no_sense_are_refused(pairs, words):
    dx = GRID.spacing[0]
    places = [{"at": cells * dx, "share": share} for cells, share in pairs]
    with pytest.raises(ValueError, match=words):
        Load(normal=100, along=places)
