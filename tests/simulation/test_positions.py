"""Positions left open are chosen by the first contact, once and for all."""

import numpy as np
import pytest
from paper_models import archard, case, last, motion, named, pair, steel

from tribo import (
    Grid,
    Periodic,
    Pin,
    Simulation,
)
from tribo.simulation.positions import composed
from tribo.stepping.explicit import Explicit
from tribo.surfaces.relief import Waves

GRID = Grid((1.4e-3, 1.4e-3), (48, 48))


def left_open(stroke="2 mm", grid=GRID, distance="360 m", stepping=None, **changes):
    return case(
        grid=grid,
        kinematics=motion(
            stroke=stroke, duration=None, distance=distance, positions="auto", **changes
        ),
        **({} if stepping is None else {"stepping": stepping}),
    )


def with_bodies(stroke, *bodies):
    """Return a case left open of which some bodies are others."""
    given = left_open(stroke)
    return given.model_copy(update={"bodies": given.bodies | dict(bodies)})


PIN = named("ball", Pin(radius="0.4 mm", edge="0.12 mm"), steel(), archard())
WAVY = named("disk", Waves(amplitude="10 nm", wavelength="0.2 mm", along="x"), steel(), archard())
CRESTS = named("ball", Waves(amplitude="10 nm", wavelength="0.2 mm", along="x"), steel(), archard())


@pytest.mark.parametrize(
    ("given", "taken"),
    [
        # Long strokes are averaged and others resolved.
        (left_open("0.4 mm"), 9),
        (left_open("4 mm"), 65),
        (left_open("6 mm"), "average"),
        (with_bodies("2 mm", PIN), 19),
        # What the average serves, and what it cannot.
        (with_bodies("2 mm", *pair(archard())), "average"),
        (left_open(stepping=Explicit(time_step=0.25)), "average"),
        (left_open("0.58 mm", swept="ball"), "cells"),
        (with_bodies("0.58 mm", WAVY), "cells"),
        # A contact without ends is averaged over its own period only.
        (with_bodies("6 mm", CRESTS).model_copy(update={"contact": Periodic()}), "cells"),
    ],
)
def test_the_positions_that_are_taken(given, taken):
    model = composed(given)
    assert model.case.kinematics.positions == taken
    assert (len(model.cycle) == 1) == (taken == "average")


def test_the_choice_does_not_follow_the_grid():
    # 20 lengths of Hertz's contact are 5.95 mm.
    for stroke, averaged in (("5.9 mm", False), ("6 mm", True)):
        for cells in (30, 40, 48):
            model = composed(left_open(stroke, Grid((1.4e-3, 1.4e-3), (cells, cells))))
            assert (len(model.cycle) == 1) == averaged


def test_the_positions_taken_are_enough_for_one_percent():
    grid = Grid((0.7e-3, 0.7e-3), (32, 32))

    def groove(positions):
        kinematics = motion(stroke="0.28 mm", duration=None, distance="2 m", positions=positions)
        state = last(composed(case(grid=grid, kinematics=kinematics)))
        return np.max(state.bodies["disk"].wear)

    assert groove("auto") == pytest.approx(groove(99), rel=0.01)
    assert groove("average") > 1.1 * groove(99)


def test_the_choice_is_kept():
    # A stroke in which the contact is resolved at a few positions.
    given = left_open("0.3 mm", grid=Grid((0.7e-3, 0.7e-3), (20, 20)), distance="0.03 m")
    with Simulation(given).run() as result:
        assert result.case_tables["kinematics"]["positions"] == 9
        # What is composed from the result has nothing left to choose.
        again = Simulation(result.case_tables).model
    assert len(again.cycle) == 9


@pytest.mark.parametrize("positions", ["average", 21])
def test_worn_bodies_go_on_in_the_positions_they_had(tmp_path, positions):
    grid = Grid((0.7e-3, 0.7e-3), (20, 20))
    kinematics = motion(stroke="0.7 mm", duration=None, distance="0.1 m", positions=positions)
    Simulation(case(grid=grid, kinematics=kinematics)).run(tmp_path / "a.h5").close()
    given = left_open("0.7 mm", grid=grid, distance="20 m")
    given = given.model_copy(update={"begin": str(tmp_path / "a.h5")})
    assert composed(given).case.kinematics.positions == positions
