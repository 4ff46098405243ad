"""Two maps laid on each other."""

import numpy as np
import pytest
import scipy.ndimage as ndimage
from scar_maps import (
    PITCH,
    RADIUS,
    SHIFT,
    TURN,
    cap,
    of_flat,
    pair,
    seen,
    track,
    volume,
)
from tribo import CaseError, Grid, Heights, Sphere

from tribo_scar import measured_scar
from tribo_scar.registration import register


@pytest.mark.parametrize(
    "changes", [{"shift": (-8.6, 5.5), "turn": -0.03}, {"noise": 50e-9}, {"on": RADIUS}]
)
def test_maps_are_laid_on_each_other_within_a_tenth_of_a_pixel(changes):
    before, after, lost = pair(**changes)
    found = measured_scar(before, after)
    laid = found.registration
    shift, turn = changes.get("shift", SHIFT), changes.get("turn", TURN)
    off = np.array(laid.shift) / PITCH - seen(shift, turn)
    assert np.max(np.abs(off)) < 0.1
    assert np.all(np.abs(off) < 4 * np.array(laid.shift_uncertainty) / PITCH)
    assert laid.rotation == pytest.approx(-turn, abs=1e-3)
    # Noise of both maps, the one before blurred as it is interpolated.
    assert laid.noise == pytest.approx(1.3 * changes.get("noise", 10e-9), rel=0.1, abs=0)
    assert found.volume == pytest.approx(volume(lost), rel=0.01, abs=0)
    assert abs(found.volume - volume(lost)) < 3 * found.volume_uncertainty < 0.05 * volume(lost)


def test_shift_and_volume_are_known_as_well_as_they_say_in_correlated_noise():
    before, after, lost = pair(noise=0)
    random, off = np.random.default_rng(2), []
    for _ in range(3):
        maps = []
        for each in (before, after):
            noise = ndimage.gaussian_filter(random.normal(size=each.heights.shape), 1.5)
            maps.append(Heights(each.heights + 20e-9 * noise / np.std(noise), each.pitch))
        found = measured_scar(*maps)
        laid = found.registration
        off += [(each / PITCH - sh) * PITCH for each, sh in zip(laid.shift, seen(), strict=True)]
        off[-2:] = np.divide(off[-2:], laid.shift_uncertainty)
        off.append((found.volume - volume(lost)) / found.volume_uncertainty)
        assert found.volume_uncertainty < 0.02 * volume(lost)
    assert np.max(np.abs(off)) < 3
    assert np.std(off) < 1.5


def test_the_border_of_a_ball_tells_no_shift():
    """Where blur is one-sided."""
    grid, ball = Grid(128 * 4e-6, 128), Sphere(radius=RADIUS)
    lost = cap(*grid.mesh, wide=100e-6)
    found = measured_scar(ball, of_flat(lost - ball.height(grid), 10e-9, seed=3, pitch=4e-6))
    assert np.all(np.isinf(found.registration.shift_uncertainty))
    assert abs(found.volume - np.sum(lost) * grid.cell_area) < 2 * found.volume_uncertainty


def test_a_direction_that_grooves_do_not_tell_is_undetermined_and_the_other_is_known():
    """They run along x, in which the map is moved by 5.4 pixels."""
    n, shift, random = 128, (5.4, 1.5), np.random.default_rng(0)
    line = ndimage.gaussian_filter1d(random.normal(size=3 * n), 3.0)
    relief = np.broadcast_to(1e-7 * line / np.std(line), (3 * n, 3 * n))
    own = np.indices((n, n)) - 0.5 * (n - 1)
    lost = np.maximum(1e-6 * (1 - np.sum(own**2, axis=0) / 22**2), 0)
    at = own + np.reshape(shift, (2, 1, 1))
    before, after = (
        Heights(
            ndimage.map_coordinates(relief, place + 1.5 * n - 0.5, order=5)
            - worn
            + 5e-9 * random.normal(size=(n, n)),
            (PITCH, PITCH),
        )
        for place, worn in ((own, 0), (at, lost))
    )
    laid = measured_scar(before, after).registration
    off = np.array(laid.shift) / PITCH - seen(shift, 0.0)
    sure = np.array(laid.shift_uncertainty) / PITCH
    assert np.isinf(sure[0])
    assert abs(off[1]) < 2 * sure[1] < 0.03
    assert abs(laid.rotation) < 3 * laid.rotation_uncertainty


def filled(shape, value=np.nan):
    return Heights(np.full(shape, value), (PITCH, PITCH))


def rows(heights, first, last):
    inside = (np.arange(96) >= first) & (np.arange(96) < last)
    return Heights(np.where(inside[:, None], heights.heights, np.nan), heights.pitch)


REFUSED = {
    r"a pixel every 1 × 1 µm, and that after every 1\.1 × 1 µm": lambda before, after: register(
        before, Heights(after.heights, (1.1e-6, 1e-6))
    ),
    "before and after are the same": lambda before, _: measured_scar(before, before),
    "one map has 2 times as many pixels": lambda before, after: measured_scar(
        before, Heights(after.heights[::2, ::2], after.pitch)
    ),
    "map after is 0 m: nothing": lambda before, _: measured_scar(before, filled((96, 96), 0.0)),
    r"shape before does not cover the map after .*pitch": lambda _, after: measured_scar(
        Sphere(radius=1e-6), after
    ),
    r"only \d+ % of the pixels in common; 20 % at least": lambda before, after: register(
        rows(before, 0, 20), rows(after, 70, 96)
    ),
    "every height of the map is missing": lambda *_: filled((32, 32)),
    r"shape \(4, 32\) are no map: 16 × 16 at least": lambda *_: filled((4, 32), 0.0),
    r"shape \(3, 32, 32\) .* no map": lambda *_: filled((3, 32, 32), 0.0),
    r"1 of its 1024 heights .* first is inf m": lambda *_: Heights(
        np.where(np.arange(1024) == 5, np.inf, 0.0).reshape(32, 32), (PITCH, PITCH)
    ),
    r"no depth exceeds .* 4 times .*larger area": lambda *_: measured_scar(*pair(depth=0)[:2]),
    r"no depth exceeds .*give the map of before first": lambda before, after: measured_scar(
        after, before
    ),
    r"% of the 96 × 96 pixels differ|if over half of the map is worn": lambda *_: measured_scar(
        *track(wide=29 * PITCH)[:2]
    ),
    r"radius: a ball of 0\.01 mm radius cannot have": lambda before, after: measured_scar(
        before, after, radius=1e-5
    ),
    r"track_length: 0\.04 mm is too short: the track is 0\.0": lambda *_: measured_scar(
        *track()[:2], track_length=40 * PITCH
    ),
    "form: form is 1": lambda before, after: measured_scar(before, after, form=3),
}


@pytest.mark.parametrize("words", REFUSED)
def test_maps_that_do_not_fit_are_refused(standard, words):
    with pytest.raises(CaseError, match=words):
        REFUSED[words](*standard[:2])
