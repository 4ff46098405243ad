"""Explicit steps decay below their limit of stability and grow above it."""

from dataclasses import replace

import numpy as np
import pytest
from paper_models import archard, flat, motion, named, small, steel

from tribo.contact.periodic import Periodic
from tribo.core.grid import Grid
from tribo.evolution.interval import Moment
from tribo.stepping.explicit import Explicit, largest_stable_increment
from tribo.stepping.first_contact import first_contact
from tribo.surfaces.surface import Surface

WAVELENGTH = 1e-4
GRID = Grid((4e-4, 4e-4), (32, 32))


class Wave(Surface):
    type = "test.wave"

    def height(self, grid):
        wave = 1e-8 * np.cos(2 * np.pi * grid.mesh[0] / WAVELENGTH)
        return np.broadcast_to(wave, grid.cells).copy()


def model():
    return small(
        grid=GRID,
        load=300.0,
        bodies=[named("wavy", Wave(), steel(), archard()), named("b", flat(), steel())],
        contact=Periodic(),
        kinematics=motion(),
    )


SCHEME = Explicit(time_step=1.0)


@pytest.mark.parametrize(("part", "grows"), [(0.98, False), (1.02, True)])
def test_explicit_steps_decay_just_below_the_stated_limit_and_grow_just_above(part, grows):
    wavy = model()
    state = first_contact(wavy)
    chequer = (-1.0) ** np.add.outer(*map(np.arange, GRID.cells))
    ball = state.bodies["wavy"]
    state = replace(
        state, bodies={**state.bodies, "wavy": replace(ball, wear=ball.wear + 1e-13 * chequer)}
    )
    state = SCHEME.step(wavy, state, 1e-9, 1e-8)
    limit = largest_stable_increment(wavy, state, Moment(1.0, 1.0, 1.0))

    def content(state):
        return abs(np.sum(state.contact.pressure * chequer))

    before = content(state)
    for i in range(20):
        state = SCHEME.step(wavy, state, part * limit, i + 1.0)
    assert (content(state) > before) == grows
