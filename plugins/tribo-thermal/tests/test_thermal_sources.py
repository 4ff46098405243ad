"""Sources that find no heat of their own; cases have the others."""

import math

import pytest

from tribo_thermal.sources import kept_per_power


@pytest.mark.parametrize("turns_back", [True, False])
def test_a_source_that_does_not_come_back_finds_no_heat_of_its_own(turns_back):
    assert kept_per_power(1.0, 1.0, 2.0, math.inf, turns_back) == 0
    assert kept_per_power(1.0, 1.0, 2.0, 1e6, turns_back) < 1e-5
