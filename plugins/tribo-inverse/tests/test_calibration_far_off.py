"""Values far from a case are refused; percentages in words."""

import numpy as np
import pytest
from tribo.core.errors import CaseError

from tribo_inverse.calibration.experiment import check_sizes
from tribo_inverse.calibration.measured import read_measurements
from tribo_inverse.calibration.parameters import Parameter


def off(value, uncertainty, own):
    entry = {"body": "disk", "quantity": "mass", "value": value, "uncertainty": uncertainty}
    data = read_measurements({"measured": [entry]}).table()
    check_sizes(
        data, np.array([own]), [Parameter("bodies.disk.wear.k", "1/Pa", 1.5e-16, 0.0, np.inf)]
    )


def test_a_null_result_is_as_far_off_as_its_uncertainty_is():
    """A disk that lost 1.2 ng give or take a microgram, where the case takes off so many σ."""
    off(1.22e-12, 9.8e-10, 299 * 9.8e-10)
    with pytest.raises(CaseError):
        off(1.22e-12, 9.8e-10, 301 * 9.8e-10)


@pytest.mark.parametrize("factor", [299.0, 1 / 299])
def test_what_is_far_off_may_be_meant(factor):
    off(factor * 1e-6, 1e-9, 1e-6)
    with pytest.raises(CaseError, match=r"^measured\.0 was read as "):
        off(factor**1.01 * 1e-6, 1e-9, 1e-6)
