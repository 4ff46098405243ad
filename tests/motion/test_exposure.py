import numpy as np

from tribo.core.grid import Grid
from tribo.motion.exposure import Track

GRID = Grid((1e-3, 2e-3), (8, 12))
RATE = np.random.default_rng(1).random(GRID.cells)


def test_track_average_is_over_the_track_not_the_window():
    # Equation 5 of the paper with N = L: np.mean over x would be right only
    # where the window is as long as the track.
    track = Track(GRID, 5e-3)
    expected = RATE.sum(axis=0) * GRID.spacing[0] / 5e-3
    np.testing.assert_allclose(track.average(RATE)[0], expected)
    assert track.average(RATE).shape == (1, 12)


def test_envelope_is_the_maximum_along_the_track():
    np.testing.assert_array_equal(Track(GRID, 5e-3).envelope(RATE)[0], RATE.max(axis=0))


def test_an_unloaded_row_has_the_compliance_of_its_law():
    pressure = RATE.copy()
    pressure[:, 3] = 0
    compliance = Track(GRID, 5e-3).compliance(np.full(GRID.cells, 2.0), pressure)
    np.testing.assert_allclose(compliance.swept, 2.0 / 5e-3)
