"""The Winkler solutions against known figures and against quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribo.closed_forms import ball_wear, winkler

STIFFNESS = 1.2973e15  # 16E*/3πa of the steel case, to five digits
CASE = {"load": 100.0, "radius": 5e-3, "stiffness": STIFFNESS, "wear_coefficient": 3.11e-16}


def worn_radius(s):
    first = winkler.sphere(CASE["load"], CASE["radius"], STIFFNESS).half_width
    given = {name: CASE[name] for name in ("load", "radius", "wear_coefficient")}
    return ball_wear.elastic_ball_half_width(s, initial_half_width=first, **given)


def test_worn_radius_has_the_known_values():
    a = worn_radius([1.0, 20.0, 360.0])
    # K_w is given to five digits, and enters the first radius to the power 1/4.
    assert a * 1e6 == pytest.approx([161.998, 258.287, 517.584], rel=1e-5)


def test_worn_centre_pressure_has_the_known_values():
    p = winkler.worn_sphere_pressure(0.0, [1.0, 20.0], **CASE)
    assert p / 1e6 == pytest.approx([2353.98, 510.443], rel=2e-5)


@pytest.mark.parametrize("part", [0.0, 0.3, 0.9, 1.05, 1.3])
def test_worn_pressure_solves_its_equation(part):
    """Against the integral over the history, without Dawson's function."""
    contact = winkler.sphere(100.0, 5e-3, STIFFNESS)
    r, s, rate = part * contact.half_width, 8.0, 3.11e-16 * STIFFNESS
    first = max(part**4 - 1.0, 0.0) / rate
    assert first < s

    def fed(sigma):
        growth = 0.5 * contact.approach * rate / np.sqrt(1.0 + rate * sigma)
        return STIFFNESS * growth * np.exp(-rate * (s - sigma))

    start = STIFFNESS * max(contact.approach - r**2 / 1e-2, 0.0)
    expected = start * np.exp(-rate * s) + quad(fed, first, s, epsrel=1e-11)[0]
    assert winkler.worn_sphere_pressure(r, s, **CASE) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("s", [0.0, 1.0, 20.0])
def test_worn_pressure_carries_the_load(s):
    a = float(worn_radius(s))
    start = float(worn_radius(0.0))

    def ring(r):
        return 2 * np.pi * r * float(winkler.worn_sphere_pressure(r, s, **CASE))

    pieces = [quad(ring, 0.0, start)[0], quad(ring, start, a)[0]]
    assert sum(pieces) == pytest.approx(100.0, rel=1e-7)
    assert winkler.worn_sphere_pressure(1.001 * a, s, **CASE) == 0.0


def test_worn_pressure_survives_long_sliding():
    p = winkler.worn_sphere_pressure(0.0, 1e7, **CASE)
    a = worn_radius(1e7)
    # All of the load is then on a flat face; what is left of the start fades as 1/s.
    assert p == pytest.approx(100.0 / (np.pi * a**2), rel=1e-6)
