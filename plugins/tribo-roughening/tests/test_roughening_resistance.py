"""The wear resistance that is drawn for each particle."""

import numpy as np
import pytest

from tribo_roughening.resistance import resistance

MADE = {"diameter": 1e-5, "thickness": 5e-7, "spread": 0.5, "seed": 1}


def places(count, length):
    line = np.linspace(0, length, count, endpoint=False)
    return np.meshgrid(line, line, indexing="ij")


@pytest.fixture(scope="module")
def many():
    """Resistances of 100 × 100 particles in ten layers, four points to a spacing."""
    x, y = places(400, 1e-3)
    return np.stack([resistance(x, y, np.full_like(x, z), **MADE) for z in 2.5e-7 * np.arange(20)])


def test_the_mean_is_1_and_the_spread_that_of_linear_interpolation(many):
    # 100 000 particles: the mean is good to 0.5/√n.
    assert many.mean() == pytest.approx(1, abs=3 * 0.5 / np.sqrt(1e5))
    # ∫((1 − u)² + u²) du = 2/3 along the surface; the mean at and midway between layers is 3/4.
    assert many.std() == pytest.approx(0.5 * np.sqrt(3 / 4) * (2 / 3), rel=0.01, abs=0)
    assert many.min() > 0


def test_particles_further_apart_than_a_spacing_are_independent(many):
    fluctuation = many[0] - many[0].mean()
    for apart in (8, 12, 40):
        for axis in (0, 1):
            product = np.mean(fluctuation * np.roll(fluctuation, apart, axis))
            assert abs(product) < 0.02 * np.mean(fluctuation**2)
    deeper = many[4] - many[4].mean()
    assert abs(np.mean(fluctuation * deeper)) < 0.02 * np.mean(fluctuation**2)


def test_it_is_continuous_in_place_and_depth():
    x = np.linspace(-3e-5, 3e-5, 100_001)
    depth = np.linspace(0, 5e-6, 100_001)
    zero = np.zeros_like(x)
    for line in (
        resistance(x, zero, zero, **MADE),
        resistance(zero, x, zero, **MADE),
        resistance(zero, zero, depth, **MADE),
    ):
        assert np.ptp(line) > 0.3
        # At most a few units of resistance a spacing, of which each step is a ten-thousandth.
        assert np.max(np.abs(np.diff(line))) < 1e-3


def test_it_repeats_after_its_period():
    x, y = places(30, 1e-4)
    depth = np.full_like(x, 3e-7)
    one = resistance(x, y, depth, repeats=10, **MADE)
    other = resistance(x - 1e-4, y + 3e-4, depth, repeats=10, **MADE)
    np.testing.assert_allclose(other, one, rtol=1e-9)
    assert np.max(np.abs(resistance(x - 1e-4, y, depth, **MADE) - one)) > 0.1
