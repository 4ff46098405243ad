"""Heat sources against Jaeger's integral, the elastic half-space and the paper's numbers."""

import math

import numpy as np
import pytest

from tribo_thermal.sources import LIMITS, kept_per_power, rise_per_power

PROFILES = {
    "uniform": np.ones_like,
    "parabolic": lambda r2: 1.5 * np.sqrt(np.maximum(1 - r2, 0.0)),
}
ALONG, ALONG_WEIGHT = np.polynomial.legendre.leggauss(40)
ROUND, ROUND_WEIGHT = np.polynomial.legendre.leggauss(120)


def jaeger(x, y, peclet, flux):
    """ΔT K/(q a) at (x, y)/a inside a disc source that moves along +x.

    Jaeger's quasi-steady point source, ΔT = Q exp(−v (r − X)/2κ)/(2πKr) with X
    the distance ahead, integrated in polar coordinates about the point.
    """
    angle = math.pi * (ROUND + 1)
    cos, sin = np.cos(angle), np.sin(angle)
    inward = x * cos + y * sin
    reach = np.sqrt(inward**2 + 1 - x * x - y * y) - inward
    u = 0.5 * (ALONG + 1)
    r = reach[:, None] * (1 - (1 - u) ** 2)
    dr = reach[:, None] * (1 - u) * ALONG_WEIGHT
    there = (x + r * cos[:, None]) ** 2 + (y + r * sin[:, None]) ** 2
    decay = np.exp(-peclet * r * (1 + cos[:, None]))
    total = np.sum(math.pi * ROUND_WEIGHT[:, None] * dr * flux(there) * decay)
    return float(total) / (2 * math.pi)


def exact(peclet, profile, rise):
    flux = PROFILES[profile]
    if rise == "maximum":
        return max(jaeger(x, 0.0, peclet, flux) for x in np.linspace(-0.99, 0.99, 67))
    node, weight = np.polynomial.legendre.leggauss(10)
    radius, around = 0.5 * (node + 1), math.pi * (np.arange(16) + 0.5) / 16
    means = [
        np.mean([jaeger(r * math.cos(t), r * math.sin(t), peclet, flux) for t in around])
        for r in radius
    ]
    return float(np.sum(weight * radius * means))


def scaled(peclet, profile, rise):
    """ΔT K/(q a), with q = Q/(π a²)."""
    return math.pi * rise_per_power(1.0, 1.0, peclet, profile, rise)


@pytest.mark.parametrize(("profile", "rise"), LIMITS)
@pytest.mark.parametrize("peclet", [0.0, 0.3, 1.0, 3.0, 10.0, 300.0])
def test_rises_follow_jaeger(profile, rise, peclet):
    # The documented accuracy of the joined formula; the limits are exact.
    joined = {"maximum": 0.023, "mean": 0.049}[rise]
    # Above Pe = 100 heat flows straight down; conduction along adds some 1/Pe.
    tolerance = {0: 1e-4, 300: 0.01}.get(peclet, joined)
    assert scaled(peclet, profile, rise) == pytest.approx(
        exact(peclet, profile, rise), rel=tolerance
    )


@pytest.mark.parametrize("turns_back", [True, False])
def test_a_source_that_does_not_come_back_finds_no_heat_of_its_own(turns_back):
    assert kept_per_power(1.0, 1.0, 2.0, math.inf, turns_back) == 0
    assert kept_per_power(1.0, 1.0, 2.0, 1e6, turns_back) < 1e-5
