"""What is told of maps that look wrong."""

import warnings

import numpy as np
import pytest
import scipy.ndimage as ndimage
from scar_maps import PITCH, RADIUS, WIDE, cap, of_flat, pair, places, volume
from tribo import Flat, Grid, Heights, Sphere, TriboWarning
from tribo.lab import heights

from tribo_scar import measured_scar


def test_a_radius_or_a_shape_that_the_unworn_surface_has_not_is_told():
    before, after, _ = pair(on=RADIUS, sq=5e-9, noise=1e-9)
    with pytest.warns(TriboWarning, match=r"radius of 5.* mm, and the ball one of 3 mm"):
        measured_scar(before, after, radius=3e-3)
    with (
        pytest.warns(TriboWarning, match="differ by more than a tilt: check the shape given"),
        pytest.warns(TriboWarning, match=r"radius of 5.* mm, and the ball one of 4 mm"),
    ):
        measured_scar(Sphere(radius=0.8 * RADIUS), after)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = measured_scar(before, after, radius=RADIUS)
        # An ideal ball has a radius of its own.
        ideal = measured_scar(Sphere(radius=RADIUS), after)
        # But a track on a sphere is made by another ball.
        ball, y = Sphere(radius=20e-3), after.grid.mesh[1]
        groove = ball.height(after.grid) - np.maximum(1e-6 * (1 - (y / WIDE) ** 2), 0)
        assert not measured_scar(ball, Heights(groove, (PITCH, PITCH))).inferred
    assert len(found.inferred) == len(ideal.inferred) > 0


@pytest.mark.parametrize(("missing", "told"), [(36, False), (38, True)])
def test_a_volume_that_lies_in_a_gap_is_told(missing, told):
    """The track begins 38 pixels from the middle of its circle."""
    far = np.hypot(*places(160)) / PITCH
    lost = cap(far - 50, 0, wide=12)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        found = measured_scar(Flat(), of_flat(lost, missing=far < missing))
    assert any("in one gap" in str(each.message) for each in warned) == told
    off = abs(found.volume / volume(lost) - 1)
    assert off > 0.2 if told else off < 0.1


@pytest.mark.parametrize("powers", [(4, 0), (2, 2)])
def test_a_form_of_fourth_order_is_told(powers):
    """Legendre's, of which a curvature takes nothing off: volumes are off by 12 to 14 %."""
    before, after, _ = pair()
    x, y = (each / (48 * PITCH) for each in after.grid.mesh)
    along, across = ([0] * power + [1] for power in powers)
    bent = np.polynomial.legendre.legval(x, along) * np.polynomial.legendre.legval(y, across)
    with pytest.warns(TriboWarning, match="unworn surfaces differ"):
        measured_scar(before, Heights(after.heights + 80e-9 * bent, after.pitch))


def test_spikes_are_left_out_and_counted():
    """In 0.4 % of the pixels, of a ball's scar."""
    before, after, lost = pair(on=RADIUS)
    maps, random, spikes = [], np.random.default_rng(2), 0
    for each in (before, after):
        spiked = random.random(lost.shape) < 0.004
        spikes += np.count_nonzero(spiked & np.isfinite(each.heights))
        maps.append(Heights(each.heights + 1e-6 * spiked, each.pitch))
    with pytest.warns(TriboWarning, match="pixels of the map (before|after) are outliers"):
        found = measured_scar(*maps)
    assert found.as_json()["outliers"] == found.outliers
    # A neighbour of one that is missing may go with it.
    assert spikes <= found.outliers <= spikes + 4
    assert abs(found.volume - volume(lost)) < 3 * found.volume_uncertainty < 0.02 * volume(lost)


def test_neither_steep_sides_nor_relief_are_outliers(standard):
    assert standard[3].outliers == 0
    for radius in (25.0e-6, 25.3e-6):
        pin = of_flat(1e-5 * (np.hypot(*places()) >= radius), 1e-8, seed=2)
        assert not heights.outliers(pin.heights).any()


def test_a_pit_in_a_corner_is_no_form():
    """A corner weighs most in a form."""
    after = of_flat(cap(*places(160), wide=40 * PITCH))
    after.heights[2:8, 2:8] -= 1e-7
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        measured_scar(Flat(), after)


def test_a_steep_ball_has_its_radius():
    """A paraboloid through 0.6 of a radius bends a tenth more than its middle."""
    grid = Grid(96 * 25e-6, 96)
    ball, noise = Sphere(radius=3e-3).height(grid), np.random.default_rng(0)
    maps = [
        Heights(each + noise.normal(0, 3e-8, ball.shape), (25e-6, 25e-6))
        for each in (ball, np.minimum(ball, -1e-4))
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        measured_scar(*maps, radius=3e-3)
    with pytest.warns(TriboWarning, match=r"has a radius of 2.9.* mm, and the ball one of 3.3 mm"):
        measured_scar(*maps, radius=3.3e-3)
    with pytest.warns(TriboWarning, match="surfaces differ by more than a curvature: check the"):
        measured_scar(Sphere(radius=3.05e-3), maps[1], form=2)


def test_a_map_twice_as_wide_as_its_scar_is_large_enough():
    """With few pixels too, though smoothing widens the scar by some."""
    y, random, shape = np.arange(32) - 15.5, np.random.default_rng(0), (32, 32)
    relief = ndimage.gaussian_filter(random.normal(size=shape), 2, mode="wrap") * 0.7e-6
    lost = 2e-6 * np.maximum(1 - (y[:, None] ** 2 + y**2) / 8**2, 0)
    before, after = (
        Heights(relief - each + 20e-9 * random.normal(size=shape), (PITCH, PITCH))
        for each in (0, lost)
    )
    found = measured_scar(before, after)
    assert found.volume == pytest.approx(volume(lost), rel=0.02, abs=0)


@pytest.mark.filterwarnings("ignore:.*are outliers")
def test_zeros_in_place_of_what_is_missing_are_told(standard):
    before, after, *_ = standard
    zeros = np.nan_to_num(before.heights)
    count = np.count_nonzero(zeros == 0)
    with pytest.warns(
        TriboWarning, match=rf"{count} heights of the map before are exactly 0; put NaN"
    ):
        measured_scar(Heights(zeros, before.pitch), after)
    # Steps of an instrument, of which 0 is one, are no such sign.
    steps = [Heights(1e-9 * np.round(1e9 * m.heights), m.pitch) for m in (before, after)]
    assert measured_scar(*steps).volume == pytest.approx(standard[3].volume, rel=0.01, abs=0)


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_nothing_is_known_of_a_radius_where_the_scar_covers_the_map():
    after = of_flat(cap(*places(32), wide=6.4 * PITCH), 0)
    with pytest.warns(TriboWarning, match="fewer than 100 pixels lie beside the scar"):
        measured_scar(Flat(), after, radius=1e-3)
