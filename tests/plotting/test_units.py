"""Units a person would choose."""

import numpy as np
import pytest

from tribo.lab.units import shown_in, time_unit


@pytest.mark.parametrize(
    ("times", "unit"),
    [
        ([0], "s"),
        ([0, 200, 500, 1500, 3600], "s"),
        ([0, 1800, 3600], "h"),
        ([0, 600, 1800], "min"),
        ([0, 600, 1234.567], "s"),
        ([0, 0.02, 0.05], "ms"),
    ],
)
def test_times_share_the_largest_unit_that_keeps_them_short(times, unit):
    assert time_unit(np.asarray(times, dtype=float)) == unit


def test_a_small_volume_and_a_wear_rate_have_their_power_of_ten_in_the_unit():
    for si, unit in (("m^3", "mm³"), ("1/Pa", "mm³/(N·m)")):
        words, factor = shown_in(si, np.array([1.8e-14, 3e-15]))
        assert words == f"10⁻⁵ {unit}"
        assert factor == pytest.approx(1e-14, rel=1e-9, abs=0)
        assert shown_in(si, np.array([2e-11]))[0] == unit
