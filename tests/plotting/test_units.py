"""Units a person would choose."""

import numpy as np
import pytest

from tribo.lab.units import fitting, height_unit, shown_in, size, time_labels, time_unit


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


@pytest.mark.parametrize(
    ("times", "labels"),
    [
        ((0.0, 200.0, 10000.0), ["0 s", "200 s", "10000 s"]),
        ((0.0, 5400.0, 7200.0), ["0 h", "1.5 h", "2 h"]),
        ((0.0, 123.4567), ["0 s", "123.5 s"]),
    ],
)
def test_time_labels(times, labels):
    assert time_labels(np.asarray(times)) == labels


def test_values_and_units_go_together():
    assert 2e-4 / size(fitting("m", 2e-4)) == pytest.approx(0.2)
    assert [fitting("m", v) for v in (2e-4, 9e-5, 9e-8, 0.0)] == ["mm", "µm", "nm", "mm"]
    assert [height_unit(v) for v in (1.4e-4, 8e-6, 8e-9, 0.0)] == ["µm", "µm", "nm", "µm"]
    assert [fitting("Pa", v) for v in (2e9, 2e5, 2e4, 2.0)] == ["MPa", "MPa", "kPa", "Pa"]


def test_a_small_volume_and_a_wear_rate_have_their_power_of_ten_in_the_unit():
    for si, unit in (("m^3", "mm³"), ("1/Pa", "mm³/(N·m)")):
        words, factor = shown_in(si, np.array([1.8e-14, 3e-15]))
        assert words == f"10⁻⁵ {unit}"
        assert factor == pytest.approx(1e-14, rel=1e-9, abs=0)
        assert shown_in(si, np.array([2e-11]))[0] == unit
