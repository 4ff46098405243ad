"""Volume of a scar, and what is piled up beside it."""

import numpy as np
import pytest
from scar_maps import PITCH, RADIUS, WIDE, cap, of_flat, pair, places, track, volume
from tribo import Flat, Grid, Heights

from tribo_scar import measured_scar, measured_scar_map


def test_a_shallow_scar_is_measured_out_to_its_edge():
    before, after, lost = pair(depth=40e-9)
    assert measured_scar(before, after).volume == pytest.approx(volume(lost), rel=0.1, abs=0)


def test_holes_add_as_much_to_the_uncertainty_of_a_volume_as_they_do():
    off, (before, after, _) = [], pair(noise=2e-9, missing=0.0)
    whole, places = measured_scar(before, after), np.indices(after.heights.shape)
    for seed in range(4):
        middles = np.random.default_rng(seed).integers(35, 62, (3, 2))
        holes = [np.sum((places - m[:, None, None]) ** 2, axis=0) < 4**2 for m in middles]
        heights = np.where(np.any(holes, axis=0), np.nan, after.heights)
        found = measured_scar(before, Heights(heights, after.pitch))
        assert 0.02 < found.missing < 0.12
        added = found.volume_uncertainty**2 - whole.volume_uncertainty**2
        off.append((found.volume - whole.volume) / np.sqrt(added))
    assert 0.4 < np.sqrt(np.mean(np.square(off))) < 2


def test_a_ball_worn_flat_has_lost_what_the_formulas_say():
    # A cap of this width.
    before, after, lost = pair(on=RADIUS / 100, depth=WIDE**2 / (2 * RADIUS / 100))
    flat, groove = measured_scar(before, after, radius=RADIUS / 100).inferred
    assert (flat.standard, groove.standard) == ("ASTM G99", "ASTM D7755")
    for each in (flat, groove):
        assert abs(each.relative_error) < 0.1
    assert flat.volume_m3 == pytest.approx(volume(lost), rel=0.1, abs=0)


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


def test_a_thin_low_ridge_along_the_edge_is_not_taken_off_the_volume():
    before, after, lost = pair(sq=30e-9, shift=(0, 0), turn=0, missing=0.0)
    inside = (np.hypot(*after.grid.mesh) - WIDE) / (2 * PITCH)
    ridge = 50e-9 * np.sin(np.pi * np.clip(inside, 0, 1))
    found = measured_scar(before, Heights(after.heights + ridge, after.pitch))
    assert abs(found.volume - volume(lost)) < 3 * found.volume_uncertainty
    assert found.volume_uncertainty < 0.005 * found.volume
    assert found.piled_up == pytest.approx(volume(ridge), rel=0.1, abs=0)


def test_the_relief_of_a_worn_surface_is_hardly_taken_for_ridges_at_its_edge():
    before, after, lost = pair(sq=30e-9, noise=3e-9, shift=(0, 0), turn=0, missing=0.0)
    for seed in range(3):
        random = np.random.default_rng(seed)
        more = 60e-9 * random.normal(size=(1, lost.shape[1])) * (lost > 0)
        found = measured_scar(before, Heights(after.heights + more, after.pitch))
        assert found.volume == pytest.approx(volume(lost - more), rel=0.005, abs=0)
        assert found.piled_up < 0.005 * found.volume


def test_a_ridge_half_as_high_as_the_scar_is_deep_hardly_changes_its_volume():
    """Of a ball worn flat; smoothing moves the border into the scar by half a pixel."""
    far = np.hypot(*places(144)) / PITCH
    lost = cap(far, 0, 6e-7, wide=40)
    ridge = 3e-7 * np.sin(np.pi * np.clip((far - 40) / 3, 0, 1))
    for seed in range(3):
        missing = np.random.default_rng(seed).random(far.shape) < 0.1
        found = measured_scar(Flat(), of_flat(lost - ridge, 1e-8, seed + 3, missing=missing))
        assert found.volume == pytest.approx(volume(lost), rel=0.01, abs=0)
        assert found.piled_up == pytest.approx(volume(ridge), rel=0.1, abs=0)


def test_maps_without_noise_are_not_taken_for_worn_all_over():
    before, *_ = pair(depth=0)
    lost = cap(0, places()[1])
    found = measured_scar(before, Heights(before.heights - lost, before.pitch))
    assert found.volume == pytest.approx(volume(lost), rel=0.01, abs=0)


def test_what_is_piled_up_beside_a_scar_is_told_apart(standard):
    before, after, lost, _ = standard
    x, y = after.grid.mesh
    ridge = np.where(np.abs(np.hypot(x, y) - 34 * PITCH) < 2 * PITCH, 4e-7, 0.0)
    gone = np.hypot(x, y - 34 * PITCH) < 5 * PITCH
    heights = np.where(gone, np.nan, after.heights + ridge)
    whole = measured_scar(before, Heights(after.heights + ridge, after.pitch))
    found = measured_scar(before, Heights(heights, after.pitch))
    for each in (whole, found):
        off = each.piled_up - volume(ridge)
        assert abs(off) < 3 * each.piled_up_uncertainty < 0.3 * each.piled_up
        assert each.volume == pytest.approx(volume(lost), rel=0.03, abs=0)
    assert found.piled_up_uncertainty > 1.5 * whole.piled_up_uncertainty


def test_smooth_balls_without_noise_have_no_shift_and_nothing_piled_up_by_rounding():
    x, y = Grid("1 mm", 64).mesh
    ball = 1e-3 - (x**2 + y**2) / (2 * RADIUS)
    lost = np.maximum(1e-6 * (1 - (x**2 + y**2) / 1e-4**2), 0)
    before, after = (Heights(z, pitch=(1e-3 / 64,) * 2) for z in (ball, ball - lost))
    found = measured_scar(before, after)
    assert found.registration.shift == (0, 0)
    assert found.piled_up == 0
    assert not found.piled.any()
    assert found.volume == pytest.approx(np.sum(lost) * (1e-3 / 64) ** 2, rel=1e-3, abs=0)
    assert len(measured_scar_map(found).axes[0].get_title(loc="left")) < 60
