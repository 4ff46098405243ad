"""What is told of maps that look wrong."""

import numpy as np
import pytest
import scipy.ndimage as ndimage
from scar_maps import PITCH, RADIUS, of_flat, pair, places, volume
from tribo import Heights, TriboWarning

from tribo_scar import measured_scar
from tribo_scar.smoothing import outliers


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
        assert not outliers(pin.heights).any()


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
