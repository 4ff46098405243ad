"""A pin on a disk so small that its path is longer and faster away from the axis."""

import numpy as np
import pytest
from paper_models import (
    Faster,
    archard,
    flat,
    foundation,
    half_space,
    last,
    named,
    small,
    sphere,
    steel,
)

from tribo import CaseError, Effect, Field, Grid, Rotating, Unidirectional
from tribo.verification.paper_bodies import Shape, drawn_radius

K, LOAD, RADIUS = 3e-16, 100.0, 2e-3
GRID = Grid((0.75e-3, 1e-3), (20, 25))
ROWS = RADIUS + GRID.mesh[1][0]
RADII = np.hypot(GRID.mesh[0], ROWS)


def run(
    pin, worn=("pin", "disk"), motion=Rotating, ends_at_window=False, law=None, effects=(), **end
):
    surfaces, law = {"pin": pin, "disk": flat()}, law or archard(K)
    return small(
        grid=GRID,
        ends_at_window=ends_at_window,
        bodies=[
            named(name, surface, steel(), law if name in worn else None)
            for name, surface in surfaces.items()
        ],
        contact=foundation(),
        effects=effects,
        kinematics=motion(speed=0.1, **{"track_radius": RADIUS, **end}),
    )


def test_both_bodies_lose_what_their_points_slide():
    # So short that the pressure stays as it is.
    revolutions = 1e-4
    state = last(run(sphere(), revolutions=revolutions))
    (dx, _), p = GRID.spacing, state.contact.pressure
    # A pin's point slides once round the axis in a revolution; a disk's once through the contact,
    # which is laid straight along its row.
    pin = revolutions * K * p * 2 * np.pi * RADII
    disk = revolutions * K * np.sum(p * RADII / ROWS, axis=0, keepdims=True) * dx
    np.testing.assert_allclose(state.bodies["pin"].wear, pin, atol=1e-4 * pin.max())
    np.testing.assert_allclose(state.bodies["disk"].wear, disk, atol=1e-4 * disk.max())


def test_a_flat_pin_ends_under_a_pressure_that_falls_as_its_path_grows():
    # Worn evenly, p r is the same everywhere, under the load.
    model = run(flat(), worn=("pin",), distance=2000, ends_at_window=True)
    state = last(model)
    mean = LOAD / (GRID.size[0] * GRID.size[1])
    even = mean / np.mean(1 / RADII) / RADII
    assert even.max() > 1.2 * mean
    np.testing.assert_allclose(state.contact.pressure, even, rtol=2e-3)
    volume = np.sum(state.bodies["pin"].wear) * GRID.cell_area
    at_first = K * LOAD * state.distance
    assert volume == pytest.approx(at_first / (np.mean(1 / RADII) * RADIUS), rel=5e-3, abs=0)


def test_a_law_is_asked_at_the_speed_of_each_row():
    model = run(flat(), worn=("pin",), distance=2000, ends_at_window=True, law=Faster())
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
    model = run(sphere(), distance=0.2, effects=(Clock(),))
    np.testing.assert_allclose(last(model).between["seconds"], 2, rtol=1e-9)


def test_far_from_the_axis_it_is_a_straight_track():
    worn = [
        last(run(sphere(), motion=motion, track_radius=1.0, distance=50)).bodies["disk"].wear
        for motion in (Rotating, Unidirectional)
    ]
    np.testing.assert_allclose(worn[0], worn[1], atol=1e-3 * worn[0].max())


@pytest.mark.parametrize("motion", [Rotating, Unidirectional])
def test_an_axis_in_the_window_is_refused(motion):
    near = motion(speed=0.1, track_radius="0.4 mm", distance=1)
    with pytest.raises(CaseError, match=r"0\.4 mm .*0\.5 mm .*0\.8 mm") as refused:
        small(grid=GRID, kinematics=near)
    assert refused.value.path == "kinematics.track_radius"


@pytest.mark.parametrize("motion", [Rotating, Unidirectional])
@pytest.mark.parametrize(("radius", "breadth"), [("0.501 mm", 1e-3), ("0.4 mm", 0.79e-3)])
def test_an_axis_beside_the_window_is_not(motion, radius, breadth):
    grid = Grid((0.75e-3, breadth), (20, 25))
    small(grid=grid, kinematics=motion(speed=0.1, track_radius=radius, distance=1))


def over_a_disc(radii, pressure):
    """Return the mean path of a pin's points over that of its middle, weighted with a pressure."""
    angle = 2 * np.pi * (np.arange(400) + 0.5) / 400
    nodes, weights = np.polynomial.legendre.leggauss(80)
    # r = sin u, so that a punch's pressure is finite.
    u, weights = 0.25 * np.pi * (nodes[:, None] + 1), weights[:, None]
    path = np.hypot(np.sin(u) * np.cos(angle), radii + np.sin(u) * np.sin(angle)) / radii
    weights = weights * np.sin(u) * pressure(path, np.cos(u)) * np.cos(u)
    return np.sum(weights * path) / np.sum(weights)


PRESSURES = {
    "even": lambda path, rise: np.ones_like(path),
    "punch": lambda path, rise: np.ones_like(path) / rise,
    "worn": lambda path, rise: 1 / path,
}


@pytest.mark.parametrize(
    ("radii", "contact", "pressure", "percent", "revolutions"),
    [
        (1.25, foundation(), "even", 8.25, 1e-4),
        (2.5, foundation(), "even", 2.01, 1e-4),
        (5, foundation(), "even", 0.50, 1e-4),
        (1.25, half_space(), "punch", 11.07, 1e-4),
        (2.5, half_space(), "punch", 2.69, 1e-4),
        (5, half_space(), "punch", 0.67, 1e-4),
        (1.25, foundation(), "worn", -9.92, 1e6),
        (2.5, foundation(), "worn", -2.09, 1e6),
        (5, foundation(), "worn", -0.505, 1e6),
    ],
)
def test_a_round_pin_loses_what_its_points_slide_of_a_straight_track(
    radii, contact, pressure, percent, revolutions
):
    exact = over_a_disc(radii, PRESSURES[pressure])
    assert 100 * (exact - 1) == pytest.approx(percent, abs=6e-3)
    grid = Grid((1.1e-3, 1.1e-3), (48, 48))
    inside = np.hypot(*grid.mesh) < 0.5e-3
    middle = radii * drawn_radius(inside, grid)
    kinematics = Rotating(speed=0.1, track_radius=middle, revolutions=revolutions)
    disc = Shape(heights=lambda _: np.where(inside, 0.0, -1e-3))
    pins = [named("pin", disc, steel(), archard(K)), named("disk", flat(), steel())]
    state = last(small(grid=grid, bodies=pins, contact=contact, kinematics=kinematics))
    volume = np.sum(state.bodies["pin"].wear) * grid.cell_area / (K * LOAD * state.distance)
    # Error of the cells, 44 across the disc.
    assert volume - 1 == pytest.approx(exact - 1, rel=2e-2)
