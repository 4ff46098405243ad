"""Depth and widths of a scar."""

import warnings

import numpy as np
import pytest
import scipy.ndimage as ndimage
from scar_maps import (
    PITCH,
    RADIUS,
    WIDE,
    cap,
    grooved,
    of_flat,
    pair,
    places,
    volume,
    worn,
)
from tribo import Flat, Heights, TriboWarning

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
    lost, missed = cap(*places(64), 50e-9), 0
    for seed in range(8):
        lost = lost if shape == "curved" else 50e-9 * (lost > 0)
        found = measured_scar(Flat(), of_flat(lost, 14e-9, seed))
        missed += abs(found.depth - 50e-9) > 1.96 * found.depth_uncertainty
    assert missed < 3


def test_the_deepest_may_lie_in_a_hole():
    x, y = places(160)
    hole = np.maximum(abs(x), abs(y - PITCH)) < 4 * PITCH
    lost = cap(x, y, wide=5**0.5 * WIDE)
    found = measured_scar(Flat(), of_flat(lost, missing=hole))
    assert abs(found.depth - 1e-6) < 3 * found.depth_uncertainty
    assert found.depth_uncertainty < 2e-9


@pytest.mark.parametrize(("pitch", "noise"), [(4e-6, 0), (10e-6, 10e-9)])
def test_the_largest_depth_of_a_curved_bottom_is_that_of_no_mean(pitch, noise):
    """A ball worn 1 µm flat, of which means over some pixels are 13 and 80 nm less."""
    random, (x, y) = np.random.default_rng(4), places(pitch=pitch)
    before = -(x**2 + y**2) / (2 * RADIUS) + ndimage.gaussian_filter(
        2e-7 * random.normal(size=(96, 96)), 2.0, mode="wrap"
    )
    lost = np.maximum(1e-6 - (x**2 + y**2) / (2 * RADIUS), 0)
    maps = [each + noise * random.normal(size=each.shape) for each in (before, before - lost)]
    found = measured_scar(*(Heights(each, (pitch, pitch)) for each in maps))
    assert abs(found.depth - np.max(lost)) < 3 * found.depth_uncertainty
    assert found.depth_uncertainty < 0.6 * noise + 1e-12


@pytest.mark.parametrize("radius", [25.3e-6, 25.6e-6])
def test_the_width_of_a_scar_with_steep_sides_is_theirs(radius):
    """As of a pin; a parabola through the lowest levels would widen it by a pixel and more."""
    lost = np.where(np.hypot(*places()) < radius, 1e-6, 0.0)
    found = measured_scar(Flat(), of_flat(lost, 1e-8, seed=2))
    for axis in ("along", "across"):
        sure = getattr(found, f"{axis}_uncertainty")
        assert abs(getattr(found, axis) - 2 * radius) < 2.1 * sure < 3e-6


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
        found = measured_scar(*worn(shape, shift=shift, turn=0)[:2], radius=RADIUS)
    assert found.as_json()["cut_off"] is True
    assert (found.along, found.across) == (None, None)
    assert found.section is None
    assert found.inferred == ()


def test_a_gap_that_cuts_a_scar_off_is_told():
    x, y = places()
    after = of_flat(cap(x, y), missing=abs(y - 12 * PITCH) < 4 * PITCH)
    with pytest.warns(TriboWarning, match="the edge of what was measured cuts the scar off"):
        assert measured_scar(Flat(), after).cut_off


def test_whole_scars_and_tracks_are_not_cut_off(standard):
    assert not standard[3].cut_off
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # Rotation leaves wedges along the edges of the common area.
        for askew in (0, 0.1):
            maps = worn(lambda x, y, slope=askew: 1 - (y - slope * x) ** 2 / 15**2, turn=0.03)
            assert not measured_scar(*maps[:2]).cut_off


@pytest.mark.parametrize("noise", [1e-9, 10e-9])
def test_the_width_of_a_groove_that_is_no_parabola_is_within_its_uncertainty(noise):
    found = measured_scar(*grooved(1e-6, noise=noise)[:2])
    assert found.across == pytest.approx(2 * WIDE, rel=0.1, abs=0)
    assert abs(found.across - 2 * WIDE) < 2.5 * found.across_uncertainty < 0.3 * WIDE


def test_a_groove_is_measured_out_to_where_single_depths_drown_in_noise():
    before, after, lost = grooved(150e-9, noise=30e-9)
    found = measured_scar(before, after)
    assert found.volume == pytest.approx(volume(lost), rel=0.05, abs=0)


def test_several_scars_have_no_width():
    def two(x, y):
        return np.maximum(1 - ((x - 25) ** 2 + y**2) / 12**2, 1 - ((x + 25) ** 2 + y**2) / 10**2)

    with pytest.warns(TriboWarning, match="2 areas are worn"):
        found = measured_scar(*worn(two, shift=(0, 0), turn=0)[:2], radius=RADIUS)
    assert (found.along, found.across, found.inferred) == (None, None, ())


@pytest.mark.parametrize("along", [0, 1])
@pytest.mark.parametrize(
    ("beside", "within"),
    [
        (lambda far, way: np.cos(0.2) * far + np.sin(0.2) * way, 0.025),
        (lambda far, way: np.cos(0.05) * far - np.sin(0.05) * way, 0.025),
        # An arc of the track of a pin on a disk.
        (lambda far, way: np.hypot(way, far + 200 * PITCH) - 200 * PITCH, 0.05),
    ],
    ids=["askew", "less askew", "an arc"],
)
def test_a_track_that_lies_askew_or_in_an_arc_is_as_wide(beside, within, along):
    before, after, _ = pair(depth=0, shift=(0, 0), turn=0)
    way, far = places()[:: 1 - 2 * along]
    lost = cap(beside(far, way), 0)
    found = measured_scar(before, Heights(after.heights - lost, after.pitch))
    widths = (found.along, found.across)
    assert np.isinf(widths[along])
    assert widths[1 - along] == pytest.approx(2 * WIDE, rel=within, abs=0)
    assert found.section == pytest.approx(4 / 3 * WIDE * 1e-6, rel=0.005, abs=0)


def test_the_length_of_a_track_is_of_no_use_for_a_scar_within_the_map(standard):
    with pytest.warns(TriboWarning, match="track_length: no track from edge"):
        measured_scar(*standard[:2], track_length=1e-3)
