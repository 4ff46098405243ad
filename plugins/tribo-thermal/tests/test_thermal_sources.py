"""Heat that stays on a track, against Green's function; the case thermal_sources has the rest."""

import math

import pytest
from greens_function import moved_on, round_a_circle, steady_cycle, to_and_fro

from tribo_thermal.sources import kept_per_power


@pytest.mark.parametrize("way", [to_and_fro, round_a_circle])
@pytest.mark.parametrize("length", [2.0, 10.0, 100.0])
@pytest.mark.parametrize("peclet", [0.2, 2.0, 50.0])
def test_heat_stays_on_the_track_as_by_greens_function(way, length, peclet):
    once = moved_on(peclet)
    kept = kept_per_power(1.0, 1.0, peclet, length, way is to_and_fro)
    whole = steady_cycle(way, length, peclet)
    tolerance = 0.015 if length >= 10 else 0.045
    assert whole > once
    assert once + kept == pytest.approx(whole, rel=tolerance)


@pytest.mark.parametrize("turns_back", [True, False])
def test_a_source_that_does_not_come_back_finds_no_heat_of_its_own(turns_back):
    assert kept_per_power(1.0, 1.0, 2.0, math.inf, turns_back) == 0
    assert kept_per_power(1.0, 1.0, 2.0, 1e6, turns_back) < 1e-5
