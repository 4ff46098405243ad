"""Wear in the units that are reported."""

import pytest

from tribo.lab import conversion


def test_wear_rate_of_the_weighed_volume():
    volume = conversion.volume_from_mass(2.2e-6, 7850.0)
    assert volume == pytest.approx(2.80255e-10, rel=1e-5, abs=0)
    k = conversion.specific_wear_rate(volume, 100.0, 9000.0)
    assert k == pytest.approx(3.1139e-16, rel=1e-4, abs=0)
    assert conversion.in_mm3_per_newton_metre(k) == pytest.approx(3.1139e-7, rel=1e-4)
    assert conversion.mass_from_volume(volume, 7850.0) == pytest.approx(2.2e-6, rel=1e-12, abs=0)
