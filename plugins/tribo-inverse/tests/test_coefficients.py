"""Pictures of local coefficients frame all that they show."""

import numpy as np
import pytest

from tribo_inverse.calibration.maps import LocalMap
from tribo_inverse.pictures import depth_fit

NOISE = 1e-8 * np.array([[1.0, -2.0, 0.5, -1.0]])


def fitted(measured, computed):
    """A fit to depths known to 10 nm."""
    nothing = np.zeros(measured.shape)
    sigma = np.full(measured.shape, 1e-8)
    return LocalMap(nothing, nothing, nothing, (1e-5, 1e-5), measured, computed, sigma)


@pytest.mark.parametrize(("off", "reach"), [(0.0, 3.0), (50.0, 52.0)])
def test_the_residuals_of_a_groove_are_seen_however_bad_its_fit(off, reach):
    depth, residual = depth_fit(fitted(NOISE, np.full((1, 4), off * 1e-8))).axes
    assert depth.get_ylim()[0] < 1e6 * NOISE.min()
    np.testing.assert_allclose(residual.get_ylim(), [-reach, reach])


def test_the_residuals_of_a_scar_are_coloured_about_white():
    measured = np.array([[0.0, np.nan], [1e-7, 2e-7]])
    figure = depth_fit(fitted(measured, np.full((2, 2), 1e-6)))
    (image,) = figure.axes[1].images
    np.testing.assert_allclose(image.get_clim(), [-100, 100])
