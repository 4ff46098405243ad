"""A pin on a disk so small that its path is longer and faster away from the axis."""

import numpy as np
import pytest
from paper_models import Faster, archard, flat, foundation, last, named, small, sphere, steel

from tribo import CaseError, Effect, Field, Grid, Rotating

K, LOAD, RADIUS = 3e-16, 100.0, 2e-3
GRID = Grid((0.75e-3, 1e-3), (20, 25))
ROWS = RADIUS + GRID.mesh[1][0]
RADII = np.hypot(GRID.mesh[0], ROWS)


def run(pin, law, distance, **changes):
    return small(
        grid=GRID,
        bodies=[named("pin", pin, steel(), law), named("disk", flat(), steel())],
        contact=foundation(),
        kinematics=Rotating(speed=0.1, track_radius=RADIUS, distance=distance),
        **changes,
    )


def test_a_law_is_asked_at_the_speed_of_each_row():
    model = run(flat(), Faster(), distance=2000, ends_at_window=True)
    # Worn evenly, p r v is the same everywhere.
    even = LOAD / (GRID.size[0] * GRID.size[1]) / np.mean(RADII**-2.0) / RADII**2
    np.testing.assert_allclose(last(model).contact.pressure, even, rtol=3e-3)


class Clock(Effect):
    """A second for each second."""

    type = "test.clock"
    state_fields = (Field("seconds", "s", "Time that has passed."),)

    def state_rates(self, contact):
        return {"seconds": np.ones(contact.pressure.shape)}


def test_time_is_the_same_for_all_points():
    model = run(sphere(), archard(K), distance=0.2, effects=(Clock(),))
    np.testing.assert_allclose(last(model).between["seconds"], 2, rtol=1e-9)


def test_an_axis_in_the_window_is_refused():
    near = Rotating(speed=0.1, track_radius="0.4 mm", distance=1)
    with pytest.raises(CaseError, match=r"0\.4 mm .*0\.5 mm .*0\.8 mm") as refused:
        small(grid=GRID, kinematics=near)
    assert refused.value.path == "kinematics.track_radius"
    small(grid=GRID, kinematics=near.model_copy(update={"track_radius": 0.501e-3}))
