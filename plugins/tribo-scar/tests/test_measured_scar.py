"""Scars measured before and after a test, of pairs of maps that are made up."""

import json
import re
import warnings

import numpy as np
import pytest
import scipy.ndimage as ndimage
from click.testing import CliRunner
from tribo import (
    CaseError,
    Flat,
    Grid,
    Heights,
    Registry,
    Rough,
    Sphere,
    TriboWarning,
    read_heights,
)
from tribo.lab import heights
from tribo.registry.plugins import builtin

from tribo_scar import measured_scar, measured_scar_map
from tribo_scar.command import scar as command
from tribo_scar.registration import register

PITCH = 1e-6
SHIFT, TURN = (3.37, -2.21), 0.01
RADIUS = 5e-3
WIDE = 20 * PITCH
"""Half-width of the scars."""


def pair(
    *, shift=SHIFT, turn=TURN, sq=100e-9, noise=10e-9, depth=1e-6, missing=0.02, on=None, n=96
):
    """Return maps before and after, shifted (pixels), turned, tilted, and the depth worn."""
    random = np.random.default_rng(7)
    large = Grid(2 * n * PITCH, 2 * n)
    waves = {"cut_off": 8 * PITCH, "roll_off": 30 * PITCH, "period": 2 * n * PITCH}
    surface = Rough(sq=sq, seed=3, **waves).relief(large)
    own = np.indices((n, n)) - 0.5 * (n - 1)

    def heights(shift, turn):
        c, s = np.cos(turn), np.sin(turn)
        at = np.stack([c * own[0] - s * own[1] + shift[0], s * own[0] + c * own[1] + shift[1]])
        form = 0 if on is None else -np.sum((at * PITCH) ** 2, axis=0) / (2 * on)
        return ndimage.map_coordinates(surface, at + n - 0.5, order=5) + form, at * PITCH

    (before, _), (after, (x, y)) = heights((0, 0), 0), heights(shift, turn)
    lost = np.maximum(depth * (1 - (x**2 + y**2) / WIDE**2), 0) if depth else np.zeros((n, n))
    after = after - lost + PITCH * (2e-3 * own[0] - 1e-3 * own[1]) + 1e-5
    maps = []
    for each in (before, after):
        noisy = each + noise * random.normal(size=each.shape)
        noisy[random.random(each.shape) < missing] = np.nan
        maps.append(Heights(noisy, (PITCH, PITCH)))
    return *maps, lost


def seen(shift=SHIFT, turn=TURN):
    """Return where the middle of the map before lies in that after, in pixels."""
    c, s = np.cos(turn), np.sin(turn)
    return -np.array([c * shift[0] + s * shift[1], c * shift[1] - s * shift[0]])


@pytest.fixture(scope="module")
def standard():
    """A pair, the depth worn, and what is measured of it."""
    before, after, lost = pair()
    return before, after, lost, measured_scar(before, after)


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
    volume = np.sum(lost) * PITCH**2
    assert found.volume == pytest.approx(volume, rel=0.01, abs=0)
    assert abs(found.volume - volume) < 3 * found.volume_uncertainty < 0.05 * volume


def test_the_depth_is_known_as_well_as_it_says(standard):
    _, _, lost, found = standard
    assert (found.along, found.across) == pytest.approx((2 * WIDE, 2 * WIDE), rel=0.02, abs=0)
    assert found.depth == pytest.approx(1e-6, rel=0.02, abs=0)
    lost = lost[found.registration.part]
    known = np.isfinite(found.depths)
    assert 0.8 < np.mean(known) < 0.95
    off = (found.depths - lost)[known] / found.registration.uncertainty[known]
    assert np.std(off) == pytest.approx(1, abs=0.15)
    assert np.isnan(found.registration.uncertainty[~known]).all()


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["curved", "flat"])
def test_the_largest_depth_holds_where_noise_hides_the_shape_of_the_bottom(shape):
    """40 scars of 3.5 times the noise: all but 2 of them on average, 6 or more once in fifty."""
    random, x, y = np.random.default_rng(5), *Grid(96 * PITCH, 96).mesh
    far, missed = (x**2 + y**2) / WIDE**2, 0
    for _ in range(40):
        lost = 50e-9 * (np.maximum(1 - far, 0) if shape == "curved" else far < 1)
        after = Heights(14e-9 * random.normal(size=far.shape) - lost, (PITCH, PITCH))
        found = measured_scar(Flat(), after)
        missed += abs(found.depth - 50e-9) > 1.96 * found.depth_uncertainty
    assert missed < 6


def test_the_deepest_may_lie_in_a_hole():
    grid = Grid(160 * PITCH, 160)
    x, y = grid.mesh
    depth = 1e-6 - 2e-7 * (x**2 + y**2) / WIDE**2
    after = np.random.default_rng(0).normal(0, 3e-9, x.shape) - np.maximum(depth, 0)
    after[76:84, 77:85] = np.nan
    found = measured_scar(Flat(), Heights(after, (PITCH, PITCH)))
    assert abs(found.depth - 1e-6) < 3 * found.depth_uncertainty
    assert found.depth_uncertainty < 2e-9


def test_what_is_missing_within_a_ring_is_not_of_its_bottom():
    far = np.hypot(*Grid(160 * PITCH, 160).mesh) / PITCH
    lost = 1e-6 * np.maximum(1 - ((far - 50) / 12) ** 2, 0)
    whole = np.random.default_rng(0).normal(0, 3e-9, far.shape) - lost
    depths = []
    for missing in (0, 25):
        after = Heights(np.where(far < missing, np.nan, whole), (PITCH, PITCH))
        with pytest.warns(TriboWarning, match="the scar encloses what is not worn"):
            depths.append(measured_scar(Flat(), after).depth)
    assert depths[1] == pytest.approx(depths[0], rel=1e-3, abs=0)


def test_maps_of_two_bodies_are_refused():
    """A flat before, a ball after."""
    grid = Grid(160 * 15e-6, 160)
    ball = Sphere(radius=3e-3).height(grid)
    flat = np.random.default_rng(0).normal(0, 3e-8, ball.shape)
    pitch = (15e-6, 15e-6)
    with pytest.raises(CaseError, match="check that both maps are of one body"):
        measured_scar(Heights(flat, pitch), Heights(np.minimum(ball, -1e-4) + flat[::-1], pitch))


@pytest.mark.parametrize("noise", [0, 10e-9])
@pytest.mark.parametrize("pitch", [4e-6, 7e-6, 10e-6])
def test_the_largest_depth_of_a_curved_bottom_is_that_of_no_mean(pitch, noise):
    """A ball worn 1 µm flat, of which means over some pixels are 13, 39 and 80 nm less."""
    random = np.random.default_rng(4)
    grid = Grid(96 * pitch, 96)
    x, y = grid.mesh
    before = -(x**2 + y**2) / (2 * RADIUS) + ndimage.gaussian_filter(
        2e-7 * random.normal(size=(96, 96)), 2.0, mode="wrap"
    )
    lost = np.maximum(1e-6 - (x**2 + y**2) / (2 * RADIUS), 0)
    maps = [each + noise * random.normal(size=each.shape) for each in (before, before - lost)]
    found = measured_scar(*(Heights(each, (pitch, pitch)) for each in maps))
    assert abs(found.depth - np.max(lost)) < 3 * found.depth_uncertainty
    assert found.depth_uncertainty < 0.6 * noise + 1e-12


@pytest.mark.parametrize("depth", [1e-6, 10e-6])
def test_the_width_of_a_scar_with_steep_sides_is_theirs(depth):
    """As of a pin, which smoothing would widen by a tenth."""
    grid = Grid(96 * PITCH, 96)
    x, y = grid.mesh
    lost = np.where(np.hypot(x, y) < 25.3e-6, depth, 0.0)
    after = Heights(1e-8 * np.random.default_rng(2).normal(size=(96, 96)) - lost, (PITCH, PITCH))
    found = measured_scar(Flat(), after)
    for axis in ("along", "across"):
        sure = getattr(found, f"{axis}_uncertainty")
        assert abs(getattr(found, axis) - 50.6e-6) < 2.1 * sure < 3e-6


def test_the_depth_from_an_ideal_ball_is_averaged_over_the_bottom():
    grid, ball = Grid(128 * PITCH, 128), Sphere(radius=RADIUS)
    x, y = grid.mesh
    lost = np.maximum(3e-6 * (1 - (x**2 + y**2) / 40e-6**2), 0)
    relief = ndimage.gaussian_filter(np.random.default_rng(1).normal(size=lost.shape), 2)
    after = ball.height(grid) - lost + 85e-9 * relief / np.std(relief)
    found = measured_scar(ball, Heights(after, (PITCH, PITCH)))
    # The relief of 85 nm partly averages out.
    assert abs(found.depth - 3e-6) < 2 * found.depth_uncertainty < 120e-9


def test_shift_and_volume_are_known_as_well_as_they_say_in_correlated_noise():
    before, after, lost = pair(noise=0)
    random, off = np.random.default_rng(2), []
    for _ in range(3):
        maps = []
        for each in (before, after):
            noise = ndimage.gaussian_filter(random.normal(size=each.heights.shape), 1.5)
            maps.append(Heights(each.heights + 20e-9 * noise / np.std(noise), each.pitch))
        found = measured_scar(*maps)
        laid, volume = found.registration, np.sum(lost) * PITCH**2
        off += [(each / PITCH - sh) * PITCH for each, sh in zip(laid.shift, seen(), strict=True)]
        off[-2:] = np.divide(off[-2:], laid.shift_uncertainty)
        off.append((found.volume - volume) / found.volume_uncertainty)
        assert found.volume_uncertainty < 0.02 * volume
    assert np.max(np.abs(off)) < 3
    assert np.std(off) < 1.5


def test_a_shallow_scar_is_measured_out_to_its_edge():
    before, after, lost = pair(depth=40e-9)
    found = measured_scar(before, after)
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.1, abs=0)


def test_the_border_of_a_ball_tells_no_shift():
    """Where blur is one-sided."""
    grid, ball = Grid(128 * 4e-6, 128), Sphere(radius=RADIUS)
    x, y = grid.mesh
    lost = np.maximum(1e-6 * (1 - (x**2 + y**2) / 100e-6**2), 0)
    noise = 10e-9 * np.random.default_rng(3).normal(size=lost.shape)
    found = measured_scar(ball, Heights(ball.height(grid) - lost + noise, (4e-6, 4e-6)))
    assert np.all(np.isinf(found.registration.shift_uncertainty))
    assert abs(found.volume - np.sum(lost) * grid.cell_area) < 2 * found.volume_uncertainty


def worn(shape, **changes):
    """Return maps before and after, of which a part is worn 1 µm deep at most."""
    before, after, _ = pair(depth=0, **changes)
    lost = 1e-6 * np.maximum(shape(*(each / PITCH for each in after.grid.mesh)), 0)
    return before, Heights(after.heights - lost, after.pitch)


@pytest.mark.parametrize(
    ("shape", "shift"),
    [
        (lambda x, y: 1 - ((x - 35) ** 2 + y**2) / 20**2, (0, 0)),
        (lambda x, y: np.where(x < 0, 1 - y**2 / 15**2, 0), (0, 0)),
        (lambda x, y: 1 - (x + y - 60) ** 2 / 15**2, (0, 0)),
        (lambda x, y: 1 - (y - 40) ** 2 / 15**2 + 0 * x, (0, 0)),
        (lambda x, y: 1 - ((x - 20) ** 2 + y**2) / 20**2, (16, 0)),
    ],
    ids=["an edge", "a track's end", "two adjacent edges", "along a track", "the common area"],
)
def test_a_scar_that_the_edge_cuts_off_is_told(shape, shift):
    where = "the area common to both maps" if any(shift) else "what was measured"
    with pytest.warns(TriboWarning, match=f"the edge of {where} cuts the scar off: .*larger area"):
        found = measured_scar(*worn(shape, shift=shift, turn=0), radius=RADIUS)
    assert found.as_json()["cut_off"] is True
    assert (found.along, found.across) == (None, None)
    assert found.section is None
    assert found.inferred == ()


def test_a_gap_that_cuts_a_scar_off_is_told():
    before, after = worn(lambda x, y: 1 - ((x - 5) ** 2 + y**2) / 20**2, shift=(0, 0), turn=0)
    after.heights[:, 56:64] = np.nan
    with pytest.warns(TriboWarning, match="the edge of what was measured cuts the scar off"):
        assert measured_scar(before, after).cut_off


def test_whole_scars_and_tracks_are_not_cut_off(standard):
    assert not standard[3].cut_off
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # Rotation leaves wedges along the edges of the common area.
        for askew in (0, 0.1):
            maps = worn(lambda x, y, slope=askew: 1 - (y - slope * x) ** 2 / 15**2, turn=0.03)
            assert not measured_scar(*maps).cut_off


@pytest.mark.filterwarnings("ignore:.*in one gap")
def test_the_volume_of_a_hole_in_the_scar_is_interpolated_and_its_uncertainty_says_so(standard):
    before, after, lost, whole = standard
    x, y = after.grid.mesh
    hole = np.hypot(x + SHIFT[0] * PITCH, y) < 6 * PITCH
    holed = Heights(np.where(hole, np.nan, after.heights), after.pitch)
    with pytest.warns(TriboWarning, match="missing where the scar is deepest"):
        found = measured_scar(before, holed)
    volume = np.sum(lost) * PITCH**2
    assert found.missing > whole.missing + 0.03
    assert found.volume_uncertainty > 3 * whole.volume_uncertainty
    assert abs(found.volume - volume) < 2 * found.volume_uncertainty < 0.1 * volume
    assert abs(found.depth - np.max(lost)) < 2 * found.depth_uncertainty < 0.5 * np.max(lost)


@pytest.mark.filterwarnings("ignore:pixels are missing where the scar is deepest")
@pytest.mark.parametrize(
    ("missing", "holes", "before_too", "least"),
    [(0.05, 0, False, 0.25), (0.0, 3, False, 0.4), (0.2, 0, True, 0.2)],
)
def test_missing_pixels_add_as_much_to_the_uncertainty_of_a_volume_as_they_do(
    missing, holes, before_too, least
):
    """Scattered ones hardly any, as their neighbours tell the slope."""
    off, (unchanged, after, _) = [], pair(noise=2e-9, missing=0.0)
    whole = measured_scar(unchanged, after)
    for seed in range(8):
        before = unchanged
        random = np.random.default_rng(seed)
        gone = random.random(after.heights.shape) < missing
        places = np.indices(after.heights.shape)
        for middle in random.integers(35, 62, (holes, 2)):
            gone |= np.sum((places - middle[:, None, None]) ** 2, axis=0) < 4**2
        if before_too:
            unseen = random.random(gone.shape) < missing
            before = Heights(np.where(unseen, np.nan, before.heights), before.pitch)
        found = measured_scar(before, Heights(np.where(gone, np.nan, after.heights), after.pitch))
        added = found.volume_uncertainty**2 - whole.volume_uncertainty**2
        off.append((found.volume - whole.volume) / np.sqrt(added))
    assert least < np.sqrt(np.mean(np.square(off))) < 1.6


@pytest.mark.slow
def test_smooth_balls_tell_no_shift_but_a_volume():
    smooth = {"sq": 1e-12, "shift": (0, 0), "turn": 0, "on": RADIUS}
    before, after, lost = pair(**smooth)
    volume = np.sum(lost) * PITCH**2
    for first in (before, Sphere(radius=RADIUS)):
        found = measured_scar(first, after)
        assert found.volume == pytest.approx(volume, rel=0.01, abs=0)
        assert np.all(np.isinf(found.registration.shift_uncertainty))
        assert found.registration.shift == (0, 0)


def test_a_ball_worn_flat_has_lost_what_the_formulas_say():
    # A cap of this width.
    before, after, lost = pair(on=RADIUS / 100, depth=WIDE**2 / (2 * RADIUS / 100))
    flat, groove, along = measured_scar(before, after, radius=RADIUS / 100).inferred
    assert (flat.standard, groove.standard, along.standard) == ("ASTM G99", "ASTM D7755", None)
    for each in (flat, groove, along):
        assert abs(each.relative_error) < 0.1
    assert flat.volume_m3 == pytest.approx(np.sum(lost) * PITCH**2, rel=0.1, abs=0)


def track(radius=50 * RADIUS, wide=WIDE):
    before, after, _ = pair(depth=0, shift=(15.3, 0))
    y = after.grid.mesh[1]
    lost = np.broadcast_to(np.maximum((wide**2 - y**2) / (2 * radius), 0), after.heights.shape)
    return before, Heights(after.heights - 1e3 * lost, after.pitch), 1e3 * lost


@pytest.mark.slow
def test_a_track_has_a_section_and_the_volume_of_its_length():
    before, after, lost = track()
    found = measured_scar(before, after, radius=50 * RADIUS / 1e3, track_length=2e-3)
    section = np.sum(lost[0]) * PITCH
    # What lies beyond the map before is left out.
    assert found.registration.part[0].stop == pytest.approx(96 - 15, abs=2)
    assert np.isinf(found.along)
    assert found.across == pytest.approx(2 * WIDE, rel=0.02, abs=0)
    assert found.section == pytest.approx(section, rel=0.01, abs=0)
    unworn, ends = found.inferred
    assert found.track_volume == pytest.approx(2e-3 * section, rel=0.01, abs=0)
    assert measured_scar(before, after).track_volume is None
    assert unworn.relative_error == pytest.approx(0, abs=0.05)
    assert ends.volume_m3 > unworn.volume_m3


def grooved(depth, sq=5e-8, **changes):
    """Return maps of a groove whose edges are flat, as of a contact that has grown."""
    before, after, _ = pair(depth=0, shift=(0, 0), turn=0, sq=sq, **changes)
    lost = depth * np.maximum(1 - np.abs(after.grid.mesh[1]) / WIDE, 0) ** 1.5
    return before, Heights(after.heights - lost, after.pitch), np.broadcast_to(lost, (96, 96))


@pytest.mark.parametrize("noise", [1e-9, 10e-9])
def test_the_width_of_a_groove_that_is_no_parabola_is_within_its_uncertainty(noise):
    found = measured_scar(*grooved(1e-6, noise=noise)[:2])
    assert found.across == pytest.approx(2 * WIDE, rel=0.1, abs=0)
    assert abs(found.across - 2 * WIDE) < 2.5 * found.across_uncertainty < 0.3 * WIDE


def test_a_groove_is_measured_out_to_where_single_depths_drown_in_noise():
    before, after, lost = grooved(150e-9, noise=30e-9)
    found = measured_scar(before, after)
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.05, abs=0)


@pytest.mark.parametrize("height", [1e-7, 4e-7])
def test_what_is_piled_up_at_the_edge_of_a_scar_is_not_taken_off_its_volume(standard, height):
    before, after, lost, _ = standard
    x, y = after.grid.mesh
    away = np.hypot(x + SHIFT[0] * PITCH, y + SHIFT[1] * PITCH) - WIDE - 3 * PITCH
    ridge = height * np.exp(-0.5 * (away / (1.5 * PITCH)) ** 2)
    found = measured_scar(before, Heights(after.heights + ridge, after.pitch))
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.03, abs=0)
    assert found.piled_up == pytest.approx(np.sum(ridge) * PITCH**2, rel=0.25, abs=0)


@pytest.mark.parametrize(("wide", "height"), [(2, 50e-9), (3, 100e-9), (4, 50e-9)])
def test_a_thin_low_ridge_along_the_edge_is_not_taken_off_the_volume(wide, height):
    before, after, lost = pair(sq=30e-9, shift=(0, 0), turn=0, missing=0.0)
    inside = (np.hypot(*after.grid.mesh) - WIDE) / (wide * PITCH)
    ridge = height * np.sin(np.pi * np.clip(inside, 0, 1))
    found = measured_scar(before, Heights(after.heights + ridge, after.pitch))
    assert abs(found.volume - np.sum(lost) * PITCH**2) < 3 * found.volume_uncertainty
    assert found.volume_uncertainty < 0.005 * found.volume
    assert found.piled_up == pytest.approx(np.sum(ridge) * PITCH**2, rel=0.1, abs=0)


@pytest.mark.filterwarnings("ignore:.*are outliers")
@pytest.mark.parametrize("kind", ["relief", "outliers"])
def test_neither_the_relief_of_a_worn_surface_nor_outliers_are_ridges_at_its_edge(kind):
    before, after, lost = pair(sq=30e-9, noise=3e-9, shift=(0, 0), turn=0, missing=0.0)
    off, piled = [], []
    for seed in range(6):
        random = np.random.default_rng(seed)
        more, noise = np.zeros(lost.shape), 10e-9 * random.normal(size=lost.shape)
        if kind == "relief":
            more, noise = 60e-9 * random.normal(size=(1, lost.shape[1])) * (lost > 0), 0.0
        else:
            noise[random.random(lost.shape) < 0.01] += 100e-9
        found = measured_scar(before, Heights(after.heights + more + noise, after.pitch))
        volume = np.sum(lost - more) * PITCH**2
        off.append((found.volume - volume) / found.volume_uncertainty)
        piled.append(found.piled_up / found.volume)
    assert np.sqrt(np.mean(np.square(off))) < 1.8
    assert np.mean(piled) < 0.001


@pytest.mark.parametrize("seed", range(3))
def test_wide_low_ridges_along_a_track_are_piled_up_and_no_noise(seed):
    """They are as wide as a third of what is unworn, 5 times as high as the noise of a pixel."""
    y, random = (np.arange(96) - 47.5) / 15, np.random.default_rng(seed)
    relief = ndimage.gaussian_filter(random.normal(size=(96, 96)), 2, mode="wrap") * 0.7e-6
    ridge = 150e-9 * np.exp(-(((np.abs(y) - 1.15) / 0.2) ** 2)) * (np.abs(y) > 1)
    lost = 0.5e-6 * np.maximum(1 - y**2, 0)
    before, after = (
        Heights(relief + each + 20e-9 * random.normal(size=(96, 96)), (PITCH, PITCH))
        for each in (0.0, ridge - lost)
    )
    found = measured_scar(before, after)
    assert found.section == pytest.approx(np.sum(lost) * PITCH, rel=0.02, abs=0)
    area = PITCH**2 * len(found.depths)
    assert found.piled_up == pytest.approx(np.sum(ridge) * area, rel=0.15, abs=0)


def test_scattered_missing_pixels_leave_the_depth_as_it_is(standard):
    before, after, lost, _ = standard
    for seed in range(3):
        missing = np.random.default_rng(seed).random(after.heights.shape) < 0.3
        found = measured_scar(
            before, Heights(np.where(missing, np.nan, after.heights), after.pitch)
        )
        assert abs(found.depth - np.max(lost)) < 4 * found.depth_uncertainty


def test_a_scar_longer_than_the_ball_is_wide_is_refused():
    before, after, _ = pair(depth=0, shift=(0, 0), turn=0)
    x, y = before.grid.mesh
    lost = 1e-6 * np.maximum(1 - x**2 / (1.5 * WIDE) ** 2 - y**2 / (0.7 * WIDE) ** 2, 0)
    with pytest.raises(CaseError, match=r"cannot have a scar 0\.0[56]"):
        measured_scar(before, Heights(after.heights - lost, after.pitch), radius=0.9 * WIDE)


def test_several_scars_have_no_width():
    def two(x, y):
        return np.maximum(1 - ((x - 25) ** 2 + y**2) / 12**2, 1 - ((x + 25) ** 2 + y**2) / 10**2)

    with pytest.warns(TriboWarning, match="2 areas are worn"):
        found = measured_scar(*worn(two, shift=(0, 0), turn=0), radius=RADIUS)
    assert (found.along, found.across, found.inferred) == (None, None, ())


def test_a_scar_on_a_flat_has_no_volumes_of_a_ball(standard):
    with pytest.warns(TriboWarning, match="the ball one of 0.2 mm"):
        found = measured_scar(*standard[:2], radius=2e-4)
    assert found.inferred == ()
    assert found.across == pytest.approx(2 * WIDE, rel=0.03)


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


@pytest.mark.parametrize(
    ("high", "wide", "missing"), [(3e-7, 8, 0), (3e-7, 3, 0), (8e-7, 13, 0), (3e-7, 8, 0.1)]
)
def test_a_ridge_that_rises_at_the_edge_takes_nothing_off_the_volume(high, wide, missing):
    """Of a ball worn flat; smoothing would move the border into the scar by half a pixel."""
    off, n, deep = [], 200, 6e-7
    far = np.hypot(*Grid(n * PITCH, n).mesh) / PITCH
    lost = np.maximum(deep * (1 - (far / 40) ** 2), 0)
    ridge = high * np.sin(np.pi * np.clip((far - 40) / wide, 0, 1))
    for seed in range(3):
        random = np.random.default_rng(seed)
        after = random.normal(0, 1e-8, far.shape) + ridge - lost
        after[random.random(far.shape) < missing] = np.nan
        found = measured_scar(Flat(), Heights(after, (PITCH, PITCH)))
        errors = found.volume - np.sum(lost) * PITCH**2, found.piled_up - np.sum(ridge) * PITCH**2
        off.append(np.divide(errors, (found.volume_uncertainty, found.piled_up_uncertainty)))
    assert np.max(np.abs(np.mean(off, axis=0))) < 2


@pytest.mark.parametrize(("missing", "told"), [(25, False), (36, False), (38, True), (44, True)])
def test_a_volume_that_lies_in_a_gap_is_told(missing, told):
    """The track begins 38 pixels from the middle of its circle."""
    far = np.hypot(*Grid(160 * PITCH, 160).mesh) / PITCH
    lost = 1e-6 * np.maximum(1 - ((far - 50) / 12) ** 2, 0)
    after = np.random.default_rng(0).normal(0, 3e-9, far.shape) - lost
    after = Heights(np.where(far < missing, np.nan, after), (PITCH, PITCH))
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        found = measured_scar(Flat(), after)
    assert any("in one gap" in str(each.message) for each in warned) == told
    off = abs(found.volume / (PITCH**2 * np.sum(lost)) - 1)
    assert off > 0.2 if told else off < 0.1


@pytest.mark.filterwarnings("ignore:pixels are missing where the scar is deepest")
def test_pixels_that_are_missing_here_and_there_are_no_gap_however_many():
    x, y = Grid(120 * PITCH, 120).mesh
    lost = 1e-6 * np.maximum(1 - (x**2 + y**2) / (28 * PITCH) ** 2, 0)
    random = np.random.default_rng(0)
    after = np.where(random.random(lost.shape) < 0.8, np.nan, -lost)
    after += random.normal(0, 1e-8, lost.shape)
    found = measured_scar(Flat(), Heights(after, (PITCH, PITCH)))
    assert abs(found.volume / (PITCH**2 * np.sum(lost)) - 1) < 0.02


@pytest.mark.parametrize("radius", [5e-3, 6e-3, 30e-3, 300e-3])
def test_a_radius_far_above_the_ball_s_is_told(radius):
    before, after, _ = pair(on=3e-3, sq=5e-9, noise=1e-9)
    words = rf"radius of [23]\.\d+ mm, and the ball one of {1e3 * radius:g} mm"
    with pytest.warns(TriboWarning, match=words):
        assert measured_scar(before, after, radius=radius).inferred == ()


@pytest.mark.parametrize("powers", [(4, 0), (2, 2)])
def test_a_form_of_fourth_order_is_told(powers):
    """Legendre's, of which a curvature takes nothing off: volumes are off by 12 to 14 %."""
    before, after, _ = pair()
    x, y = (each / (48 * PITCH) for each in after.grid.mesh)
    along, across = ([0] * power + [1] for power in powers)
    bent = np.polynomial.legendre.legval(x, along) * np.polynomial.legendre.legval(y, across)
    with pytest.warns(TriboWarning, match="unworn surfaces differ"):
        measured_scar(before, Heights(after.heights + 80e-9 * bent, after.pitch))


@pytest.mark.parametrize("height", [1e-6, 2e-5])
def test_spikes_are_left_out_and_counted(height):
    """In 0.4 % of the pixels, of a ball's scar."""
    before, after, lost = pair(on=RADIUS)
    volume, maps = np.sum(lost) * PITCH**2, []
    random, spikes = np.random.default_rng(2), 0
    for each in (before, after):
        spiked = random.random(lost.shape) < 0.004
        spikes += np.count_nonzero(spiked & np.isfinite(each.heights))
        maps.append(Heights(each.heights + height * spiked, each.pitch))
    with pytest.warns(TriboWarning, match="pixels of the map (before|after) are outliers"):
        found = measured_scar(*maps)
    assert found.as_json()["outliers"] == found.outliers
    # A neighbour of one that is missing may go with it.
    assert spikes <= found.outliers <= spikes + 4
    assert abs(found.volume - volume) < 3 * found.volume_uncertainty < 0.02 * volume


def test_neither_steep_sides_nor_relief_are_outliers(standard):
    assert standard[3].outliers == 0
    x, y = Grid(96 * PITCH, 96).mesh
    for radius in (25.0e-6, 25.3e-6):
        pin = np.where(np.hypot(x, y) < radius, 0.0, -1e-5)
        assert not heights.outliers(
            pin + 1e-8 * np.random.default_rng(2).normal(size=pin.shape)
        ).any()


def test_a_pit_in_a_corner_is_no_form():
    """A corner weighs most in a form."""
    grid = Grid(160 * PITCH, 160)
    x, y = grid.mesh
    lost = np.maximum(1e-6 * (1 - (x**2 + y**2) / (40 * PITCH) ** 2), 0)
    after = np.random.default_rng(0).normal(0, 3e-9, lost.shape) - lost
    after[2:8, 2:8] -= 1e-7
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        measured_scar(Flat(), Heights(after, (PITCH, PITCH)))


def test_a_steep_ball_has_its_radius():
    """A paraboloid through 0.6 of a radius bends a tenth more than its middle."""
    grid = Grid(160 * 15e-6, 160)
    ball, noise = Sphere(radius=3e-3).height(grid), np.random.default_rng(0)
    maps = [
        Heights(each + noise.normal(0, 3e-8, ball.shape), (15e-6, 15e-6))
        for each in (ball, np.minimum(ball, -1e-4))
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        measured_scar(*maps, radius=3e-3)
    with pytest.warns(TriboWarning, match=r"has a radius of 2.9.* mm, and the ball one of 3.3 mm"):
        measured_scar(*maps, radius=3.3e-3)
    with pytest.warns(TriboWarning, match="surfaces differ by more than a curvature: check the"):
        measured_scar(Sphere(radius=3.1e-3), maps[1], form=2)


def test_maps_of_half_the_pixels_are_refused():
    before, after, _ = pair(missing=0)
    with pytest.raises(CaseError, match="one map has 2 times as many pixels along both axes"):
        measured_scar(before, Heights(after.heights[::2, ::2], np.multiply(1.0005, after.pitch)))


@pytest.mark.parametrize("factor", [0.85, 1.15])
def test_a_wrong_radius_is_told_under_the_relief_of_a_ball(factor):
    """Though the curvature that is left is less than the relief."""
    _, after, _ = pair(on=RADIUS, shift=(0, 0), turn=0, n=192)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        measured_scar(Sphere(radius=RADIUS), after)
    with pytest.warns(TriboWarning, match="differ by more than a tilt: check the shape given"):
        measured_scar(Sphere(radius=factor * RADIUS), after)


@pytest.mark.parametrize("wide", [16, 24])
def test_a_map_twice_as_wide_as_its_scar_is_large_enough(wide):
    """With few pixels too, though smoothing widens the scar by some."""
    y, random = np.arange(2 * wide) - wide + 0.5, np.random.default_rng(0)
    shape = 2 * (2 * wide,)
    relief = ndimage.gaussian_filter(random.normal(size=shape), 2, mode="wrap") * 0.7e-6
    lost = 2e-6 * np.maximum(1 - (y[:, None] ** 2 + y**2) / (wide / 2) ** 2, 0)
    before, after = (
        Heights(relief - each + 20e-9 * random.normal(size=shape), (PITCH, PITCH))
        for each in (0, lost)
    )
    found = measured_scar(before, after)
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.02, abs=0)


def test_few_pixels_are_told_where_the_margin_of_a_scar_is_much_of_the_map():
    far = np.hypot(*Grid(24 * PITCH, 24).mesh) / PITCH
    after = np.random.default_rng(0).normal(0, 1e-10, far.shape)
    after -= np.maximum(1e-5 * (1 - (far / 5) ** 2), 0)
    with pytest.raises(CaseError, match=r"of the 24 × 24 pixels differ, .*or with smaller pixels"):
        measured_scar(Flat(), Heights(after, (PITCH, PITCH)))


@pytest.mark.parametrize("along", [0, 1])
def test_an_arc_of_the_track_of_a_pin_on_a_disk_is_as_wide(along):
    before, after, _ = pair(depth=0, shift=(0, 0), turn=0)
    places, round_ = before.grid.mesh, 200 * PITCH
    beside = np.hypot(places[along], places[1 - along] + round_) - round_
    lost = 1e-6 * np.maximum(1 - beside**2 / WIDE**2, 0)
    found = measured_scar(before, Heights(after.heights - lost, after.pitch))
    assert (found.along, found.across)[1 - along] == pytest.approx(2 * WIDE, rel=0.05, abs=0)


@pytest.mark.parametrize("turn", [0.0, 0.02, 0.04])
def test_a_direction_that_grooves_do_not_tell_adds_to_the_other_where_they_are_turned(turn):
    """They run along x, in which the map is moved by 5.4 pixels."""
    n, shift, random = 128, (5.4, 1.5), np.random.default_rng(0)
    line = ndimage.gaussian_filter1d(random.normal(size=3 * n), 3.0)
    relief = np.broadcast_to(1e-7 * line / np.std(line), (3 * n, 3 * n))
    own, (c, s) = np.indices((n, n)) - 0.5 * (n - 1), (np.cos(turn), np.sin(turn))
    at = np.stack([c * own[0] - s * own[1] + shift[0], s * own[0] + c * own[1] + shift[1]])
    lost = np.maximum(1e-6 * (1 - np.sum(own**2, axis=0) / 22**2), 0)
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
    off = np.array(laid.shift) / PITCH - seen(shift, turn)
    sure = np.array(laid.shift_uncertainty) / PITCH
    assert np.isinf(sure[0])
    assert abs(off[1]) < 2 * sure[1] < 0.03 + 30 * turn
    assert abs(laid.rotation + turn) < 3 * laid.rotation_uncertainty


def test_rounding_of_smooth_balls_tells_no_shift():
    pitch = 10e-6
    x, y = Grid(96 * pitch, 96).mesh
    ball = -(x**2 + y**2) / (2 * RADIUS)
    lost = 2e-6 * np.maximum(1 - (x**2 + y**2) / 0.3e-3**2, 0)
    found = measured_scar(Heights(ball, (pitch, pitch)), Heights(ball - lost, (pitch, pitch)))
    assert found.registration.shift == (0, 0)
    assert found.volume == pytest.approx(np.sum(lost) * pitch**2, rel=1e-3, abs=0)


@pytest.mark.parametrize("askew", [-0.2, 0.05])
@pytest.mark.parametrize("along", [0, 1])
def test_a_track_that_lies_askew_in_the_map_is_as_wide(askew, along):
    before, after, _ = pair(depth=0, shift=(0, 0), turn=0)
    places = before.grid.mesh
    beside = np.cos(askew) * places[1 - along] - np.sin(askew) * places[along]
    lost = 1e-6 * np.maximum(1 - beside**2 / WIDE**2, 0)
    found = measured_scar(before, Heights(after.heights - lost, after.pitch))
    widths = (found.along, found.across)
    assert np.isinf(widths[along])
    assert widths[1 - along] == pytest.approx(2 * WIDE, abs=PITCH)
    assert found.section == pytest.approx(4 / 3 * WIDE * 1e-6, rel=0.005, abs=0)


def test_maps_without_noise_are_not_taken_for_worn_all_over():
    before, *_ = pair(depth=0)
    lost = 1e-6 * np.maximum(1 - before.grid.mesh[1] ** 2 / WIDE**2, 0)
    lost = np.broadcast_to(lost, before.heights.shape)
    found = measured_scar(before, Heights(before.heights - lost, before.pitch))
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.01, abs=0)


def test_what_is_piled_up_beside_a_scar_is_told_apart(standard):
    before, after, lost, _ = standard
    x, y = after.grid.mesh
    ridge = np.where(np.abs(np.hypot(x, y) - 34 * PITCH) < 2 * PITCH, 4e-7, 0.0)
    gone = np.hypot(x, y - 34 * PITCH) < 5 * PITCH
    heights = np.where(gone, np.nan, after.heights + ridge)
    whole = measured_scar(before, Heights(after.heights + ridge, after.pitch))
    found = measured_scar(before, Heights(heights, after.pitch))
    for each in (whole, found):
        off = each.piled_up - np.sum(ridge) * PITCH**2
        assert abs(off) < 3 * each.piled_up_uncertainty < 0.3 * each.piled_up
        assert each.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.03, abs=0)
    assert found.piled_up_uncertainty > 1.5 * whole.piled_up_uncertainty


def test_maps_that_do_not_fit_are_refused(standard):
    before, after, *_ = standard
    with pytest.raises(
        CaseError, match=r"a pixel every 1 × 1 µm, and that after every 1\.1 × 1 µm"
    ):
        register(before, Heights(after.heights, (1.1e-6, 1e-6)))
    with pytest.raises(CaseError, match="swap the axes of one, or measure or resample"):
        register(Heights(before.heights, (2e-6, 1e-6)), Heights(after.heights, (1e-6, 2e-6)))
    with pytest.raises(CaseError, match="before and after are the same"):
        measured_scar(before, before)
    flat = Heights(np.zeros((96, 96)), before.pitch)
    with pytest.raises(CaseError, match="every height of the map after is 0 m: nothing was meas"):
        measured_scar(before, flat)
    with pytest.warns(TriboWarning, match="map before is 0 m, an ideal flat; if it was measured"):
        measured_scar(flat, after)
    with pytest.raises(
        CaseError, match=r"shape before does not cover the map after .*or the pitch"
    ):
        measured_scar(Sphere(radius=1e-6), after)
    part = np.full(before.heights.shape, np.nan)
    part[:20] = before.heights[:20]
    rest = np.where(np.arange(96)[:, None] < 70, np.nan, after.heights)
    with pytest.raises(CaseError, match=r"only \d+ % of the pixels in common; 20 % at least"):
        register(Heights(part, before.pitch), Heights(rest, after.pitch))
    with pytest.raises(CaseError, match="every height of the map is missing"):
        Heights(np.full((32, 32), np.nan), (PITCH, PITCH))
    with pytest.raises(CaseError, match=r"shape \(4, 32\) are no map: 16 × 16 at least"):
        Heights(np.zeros((4, 32)), (PITCH, PITCH))
    with pytest.raises(
        CaseError, match=r"shape \(3, 32, 32\) .* two dimensions; save one map alone"
    ):
        Heights(np.zeros((3, 32, 32)), (PITCH, PITCH))
    with pytest.raises(CaseError, match="1 of its 1024 heights are infinite; put NaN where"):
        Heights(np.where(np.arange(1024) == 5, np.inf, 0.0).reshape(32, 32), (PITCH, PITCH))
    with pytest.raises(CaseError, match=r"worn deeper than .* 4 times .*measure a larger area"):
        measured_scar(*pair(depth=0)[:2])
    with pytest.raises(CaseError, match=r"nothing is worn .*is the map after the test given first"):
        measured_scar(after, before)
    with pytest.raises(
        CaseError, match=r"% of the 96 × 96 pixels differ|if over half of the map is worn"
    ):
        measured_scar(*track(wide=29 * PITCH)[:2])
    with pytest.raises(
        CaseError, match=r"radius: a ball of 0\.01 mm radius cannot have .* radius or pitch"
    ):
        measured_scar(before, after, radius=1e-5)
    with pytest.raises(CaseError, match="form: form is 1"):
        measured_scar(before, after, form=3)


@pytest.mark.slow
def test_the_command_measures_and_draws(tmp_path):
    before, after, lost = pair(on=RADIUS)
    np.save(tmp_path / "before.npy", before.heights)
    np.savetxt(tmp_path / "after.csv", after.heights, delimiter=",")
    files = [str(tmp_path / name) for name in ("before.npy", "after.csv")]
    picture = tmp_path / "scar.png"
    given = [*files, "--pitch", "1 um", "--radius", "5 mm", "-o", str(picture)]
    given += ["-o", str(tmp_path / "depth.NPY")]
    done = CliRunner().invoke(command, given, catch_exceptions=False)
    volume = 1e9 * np.sum(lost) * PITCH**2
    assert float(done.output.split("volume in the map, mm³")[1].split()[0]) == pytest.approx(
        volume, rel=0.01, abs=0
    )
    for words in ("flat scar (ASTM G99)", "In the map after all lies -3.3", "Noise of the unworn"):
        assert words in done.output
    assert picture.stat().st_size > 10_000
    assert done.output.count("Wrote ") == 2
    depth = np.load(tmp_path / "depth.NPY")
    # Whole, so that its middle is that of the map after.
    assert depth.shape == after.heights.shape
    assert np.nansum(depth) == pytest.approx(np.sum(lost), rel=0.1)
    assert np.nanstd(depth - lost) < 0.1 * np.max(lost)
    ideal = [files[1], *given[2:4], "--ideal", '{ type = "sphere", radius = "5 mm" }', "--json"]
    told = CliRunner().invoke(command, ideal, catch_exceptions=False)
    assert '"volume_uncertainty_m3"' in told.output
    assert json.loads(told.output)["cut_off"] is False
    with pytest.raises(CaseError, match="has heights and no scale; give the distance"):
        CliRunner().invoke(command, files, catch_exceptions=False)
    with pytest.raises(CaseError, match=r"--pitch: .*no unit"):
        CliRunner().invoke(command, [*files, "--pitch", "5"], catch_exceptions=False)
    with pytest.raises(CaseError, match="--pitch: 5 mm is too much between two pixels, 1 mm at"):
        CliRunner().invoke(command, [*files, "--pitch", "5 mm"], catch_exceptions=False)
    np.savetxt(tmp_path / "semicolons.csv", after.heights, delimiter=";")
    with pytest.raises(CaseError, match=r"semicolons\.csv .* line 2, .* by commas"):
        read_heights(tmp_path / "semicolons.csv", (PITCH, PITCH))


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ([], "1 file is given; give the maps before and after"),
        (["a.npy", "a.npy"], "3 files are given"),
        (["--radius", "5", "mm"], r"^'mm' is no file: quote a length, as --radius '5 mm'$"),
        (["--ideal", "sphere"], "--ideal radius: missing"),
        (["-o", "none/scar.png"], "there is no folder none; make it first"),
        (["--ideal", "flat", "-o", "./a.npy"], r"--output: a\.npy is a measured map; give another"),
        (["--ideal", '{ type = "sphere" r'], r'sphere" r is no TOML: Unclosed .*; .* put commas'),
    ],
)
def test_wrong_words_of_the_command_are_told(given, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("a.npy", np.zeros((32, 32)))
    with pytest.raises(CaseError, match=words):
        CliRunner().invoke(command, ["a.npy", "--pitch", "1 um", *given], catch_exceptions=False)


def test_the_command_says_what_the_maps_do_not_tell_and_what_is_cut_off(tmp_path):
    grid = Grid(96 * PITCH, 96)
    x, y = grid.mesh
    lost = 1e-6 * np.maximum(1 - ((x - 35e-6) ** 2 + y**2) / WIDE**2, 0)
    np.save(tmp_path / "after.npy", 1e-9 * np.random.default_rng(1).normal(size=x.shape) - lost)
    given = [str(tmp_path / "after.npy"), "--pitch", "1 um", "--ideal", "flat"]
    with pytest.warns(TriboWarning, match="cuts the scar off"):
        done = CliRunner().invoke(command, given, catch_exceptions=False)
    assert "does not tell the shift along x, the shift along y" in done.output
    assert "all lies" not in done.output
    assert "inf" not in done.output
    assert done.output.count("cut off") == 2


def test_the_length_of_a_track_is_of_no_use_for_a_scar_within_the_map(standard):
    with pytest.warns(TriboWarning, match="track_length: no track from edge"):
        measured_scar(*standard[:2], track_length=1e-3)


@pytest.mark.slow
def test_a_track_cannot_be_shorter_than_within_the_map():
    with pytest.raises(CaseError, match=r"track_length: 0\.04 mm is too short: the track is 0\.0"):
        measured_scar(*track()[:2], track_length=40 * PITCH)


def test_a_whole_circular_track_is_told_and_no_ball_made_its_outline():
    random, (x, y) = np.random.default_rng(1), Grid(96 * PITCH, 96).mesh
    lost = 1e-6 * np.maximum(1 - ((np.hypot(x, y) - 30e-6) / 8e-6) ** 2, 0)
    after = Heights(1e-8 * random.normal(size=lost.shape) - lost, (PITCH, PITCH))
    with pytest.warns(TriboWarning, match="encloses what is not worn, as a whole circular track"):
        found = measured_scar(Flat(), after, radius=RADIUS)
    assert found.inferred == ()
    assert found.across == pytest.approx(76e-6, rel=0.03, abs=0)
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.01, abs=0)


def test_the_command_gives_the_volume_of_a_whole_track(tmp_path):
    _, y = Grid(96 * PITCH, 96).mesh
    lost = 1e-6 * np.maximum(1 - np.broadcast_to(y, (96, 96)) ** 2 / WIDE**2, 0)
    np.save(tmp_path / "after.npy", 1e-8 * np.random.default_rng(1).normal(size=lost.shape) - lost)
    given = [str(tmp_path / "after.npy"), "--pitch", "1 um", "--ideal", "flat"]
    given += ["--track-length", "2 mm"]
    done = CliRunner().invoke(command, given, catch_exceptions=False)
    volume, sure = map(float, done.output.split("volume of the track, mm³")[1].split()[:2])
    assert volume == pytest.approx(1e9 * np.sum(lost[0]) * PITCH * 2e-3, rel=0.01, abs=0)
    assert 0 < sure < 0.02 * volume
    assert "whole map" in done.output


def test_heights_in_micrometres_and_fill_values_are_told_by_their_file(standard, tmp_path):
    heights = standard[1].heights
    filled = np.where(np.isnan(heights), -9999, heights)
    for name, wrong in {"micro": 1e6 * heights, "filled": filled}.items():
        np.save(tmp_path / f"{name}.npy", wrong)
        words = rf"{name}\.npy: .* lie further .* wide, 0\.096 mm; .*put NaN for fill .* one in µm"
        with pytest.raises(CaseError, match=words):
            read_heights(tmp_path / f"{name}.npy", (PITCH, PITCH))
    # An instrument may count heights from its own stage.
    assert Heights(heights + 1.0, (PITCH, PITCH)).heights.shape == heights.shape


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


def test_a_picture_leaves_what_is_missing_white(standard):
    (image,) = measured_scar_map(standard[3]).axes[0].images
    assert np.ma.getmaskarray(image.get_array()).any()


def test_the_picture_outlines_what_is_piled_up():
    ridge = lambda x, y: np.exp(-((np.hypot(x, y) - 26) ** 2) / 8)  # noqa: E731
    before, after, *_ = pair(missing=0.0)
    x, y = after.grid.mesh
    raised = Heights(after.heights + 3e-7 * ridge(x / PITCH, y / PITCH), after.pitch)
    figure = measured_scar_map(measured_scar(before, raised))
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["scar", "piled up"]
    title = figure.axes[0].get_title("left")
    value, power = re.match(r"Volume \(([\d.]+) ± .*10\^\{(-\d+)\}\$ mm³", title).groups()
    assert 1e-9 * float(value) * 10.0 ** int(power) == pytest.approx(6.28e-16, rel=0.03, abs=0)


def test_a_file_of_a_format_that_nothing_reads_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(heights, "default_registry", lambda: Registry([builtin()]))
    with pytest.raises(
        CaseError, match=r"map\.x3p is no NumPy, CSV or HDF5 file .* install tribo-t"
    ):
        read_heights(tmp_path / "map.x3p")
    (tmp_path / "list.csv").write_text("1,2,3\n4,5,6\n")
    with pytest.raises(CaseError, match=r"list\.csv: .* a list of x, y, z is no map"):
        read_heights(tmp_path / "list.csv", (PITCH, PITCH))
    with pytest.raises(CaseError, match=r"there is no file .*map\.npy"):
        read_heights(tmp_path / "map.npy")


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_nothing_is_known_of_a_radius_where_the_scar_covers_the_map():
    x, y = Grid(32 * PITCH, 32).mesh
    lost = np.maximum(1e-6 * (1 - (x**2 + y**2) / (6.4 * PITCH) ** 2), 0)
    with pytest.warns(TriboWarning, match="fewer than 100 pixels lie beside the scar"):
        measured_scar(Flat(), Heights(-lost, (PITCH, PITCH)), radius=1e-3)
