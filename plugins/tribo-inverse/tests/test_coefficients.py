"""Pictures of local coefficients frame all that they show."""

import numpy as np
import pandas as pd
import pytest

from tribo_inverse.calibration.maps import LocalMap
from tribo_inverse.fitted import fit_picture
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


def test_a_fit_stands_over_what_was_measured():
    data = pd.DataFrame(
        {
            "test": ["", "long"],
            "body": ["ball", "disk"],
            "quantity": ["scar_across", "mass"],
            "time_s": [np.nan, 60.0],
            "measured": [1e-3, 2e-7],
            "below": [False, True],
            "sigma": [1e-5, 1e-7],
            "computed": [1.1e-3, 2e-7],
        }
    )
    figure = fit_picture(data)
    fitted = next(line for line in figure.axes[0].lines if line.get_label() == "fitted")
    np.testing.assert_allclose(fitted.get_xdata(), [1.1, 1.0])
    labels = [text.get_text() for text in figure.axes[0].get_yticklabels()]
    assert labels == ["ball, scar_across", "long: disk, mass at 60 s"]
    (limit,) = [each for each in figure.axes[0].lines if "below this limit" in each.get_label()]
    assert limit.get_xydata().tolist() == [[1.0, 0.0]]
