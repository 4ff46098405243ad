"""Depth and widths of a scar."""

import warnings

import numpy as np
import pytest
import scipy.ndimage as ndimage
from scar_maps import PITCH, RADIUS, WIDE, grooved, pair, track, worn
from tribo import CaseError, Flat, Grid, Heights, TriboWarning

from tribo_scar import measured_scar


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
    """8 scars of 3.5 times the noise: nearly all of them on average, 3 or more once in 170."""
    random, x, y = np.random.default_rng(5), *Grid(64 * PITCH, 64).mesh
    far, missed = (x**2 + y**2) / WIDE**2, 0
    for _ in range(8):
        lost = 50e-9 * (np.maximum(1 - far, 0) if shape == "curved" else far < 1)
        after = Heights(14e-9 * random.normal(size=far.shape) - lost, (PITCH, PITCH))
        found = measured_scar(Flat(), after)
        missed += abs(found.depth - 50e-9) > 1.96 * found.depth_uncertainty
    assert missed < 3


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
        with pytest.warns(TriboWarning, match="the scar encloses an unworn area"):
            depths.append(measured_scar(Flat(), after).depth)
    assert depths[1] == pytest.approx(depths[0], rel=1e-3, abs=0)


@pytest.mark.parametrize(("pitch", "noise"), [(4e-6, 0), (10e-6, 10e-9)])
def test_the_largest_depth_of_a_curved_bottom_is_that_of_no_mean(pitch, noise):
    """A ball worn 1 µm flat, of which means over some pixels are 13 and 80 nm less."""
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


def test_the_width_of_a_scar_with_steep_sides_is_theirs():
    """As of a pin, which smoothing would widen by a tenth."""
    grid = Grid(96 * PITCH, 96)
    x, y = grid.mesh
    lost = np.where(np.hypot(x, y) < 25.3e-6, 1e-6, 0.0)
    after = Heights(1e-8 * np.random.default_rng(2).normal(size=(96, 96)) - lost, (PITCH, PITCH))
    found = measured_scar(Flat(), after)
    for axis in ("along", "across"):
        sure = getattr(found, f"{axis}_uncertainty")
        assert abs(getattr(found, axis) - 50.6e-6) < 2.1 * sure < 3e-6


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


@pytest.mark.parametrize("noise", [1e-9, 10e-9])
def test_the_width_of_a_groove_that_is_no_parabola_is_within_its_uncertainty(noise):
    found = measured_scar(*grooved(1e-6, noise=noise)[:2])
    assert found.across == pytest.approx(2 * WIDE, rel=0.1, abs=0)
    assert abs(found.across - 2 * WIDE) < 2.5 * found.across_uncertainty < 0.3 * WIDE


def test_a_groove_is_measured_out_to_where_single_depths_drown_in_noise():
    before, after, lost = grooved(150e-9, noise=30e-9)
    found = measured_scar(before, after)
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.05, abs=0)


def test_several_scars_have_no_width():
    def two(x, y):
        return np.maximum(1 - ((x - 25) ** 2 + y**2) / 12**2, 1 - ((x + 25) ** 2 + y**2) / 10**2)

    with pytest.warns(TriboWarning, match="2 areas are worn"):
        found = measured_scar(*worn(two, shift=(0, 0), turn=0), radius=RADIUS)
    assert (found.along, found.across, found.inferred) == (None, None, ())


@pytest.mark.parametrize(("askew", "along"), [(-0.2, 0), (0.05, 1)])
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
    with pytest.warns(TriboWarning, match="encloses an unworn area, as a whole circular track"):
        found = measured_scar(Flat(), after, radius=RADIUS)
    assert found.inferred == ()
    assert found.across == pytest.approx(76e-6, rel=0.03, abs=0)
    assert found.volume == pytest.approx(np.sum(lost) * PITCH**2, rel=0.01, abs=0)
