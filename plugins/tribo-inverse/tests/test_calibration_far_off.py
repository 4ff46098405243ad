"""Values that a case is far from, and percentages in words."""

import numpy as np
import pytest
from tribo.core.errors import CaseError
from tribo.core.words import digits_of

from tribo_inverse.calibration.doubts import far_off
from tribo_inverse.calibration.measured import read_measurements
from tribo_inverse.calibration.parameters import Parameter
from tribo_inverse.calibration.quantities import percent


def off(value, uncertainty, own):
    entry = {"body": "disk", "quantity": "mass", "value": value, "uncertainty": uncertainty}
    data = read_measurements({"measured": [entry]}).table()
    return far_off(
        data, np.array([own]), [Parameter("bodies.disk.wear.k", "1/Pa", 1.5e-16, 0.0, np.inf)]
    )


@pytest.mark.parametrize(("sigmas", "count"), [(0.5, 0), (4.9, 0), (20.0, 1)])
def test_a_null_result_is_as_far_off_as_its_uncertainty_is(sigmas, count):
    """A disk that lost 1.2 ng give or take a microgram, where the case takes off so many σ."""
    assert len(off(1.22e-12, 9.8e-10, sigmas * 9.8e-10)) == count


@pytest.mark.parametrize("factor", [299.0, 1 / 299])
def test_what_is_far_off_may_be_meant(factor):
    assert len(off(factor * 1e-6, 1e-9, 1e-6)) == 1
    with pytest.raises(CaseError, match=r"^measured\.0 was read as "):
        off(factor**1.01 * 1e-6, 1e-9, 1e-6)


@pytest.mark.parametrize(
    ("part", "text"),
    [(2e-14, "0.0"), (4.2e-5, "0.0042"), (0.0526, "5.3"), (0.0996, "10"), (1, "100"), (2.5, "250")],
)
def test_percent_are_written_out(part, text):
    assert percent(part) == text


@pytest.mark.parametrize(
    ("ends", "digits"),
    [
        ((1.1e-16, 1.4e-14), 3),
        ((2.4995e-15, 2.5005e-15), 6),
        ((0.1404, 0.1404), 3),
        ((0.1404, 0.1404 * (1 + 1e-8)), 11),
        ((0, np.inf), 3),
    ],
)
def test_ends_of_a_narrow_interval_differ(ends, digits):
    assert digits_of(*ends) == digits
