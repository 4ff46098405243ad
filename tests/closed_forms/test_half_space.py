"""Punch, cone and wave: closed forms against integrals of themselves."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribo.closed_forms import cone, punch, sinusoid

MODULUS = 113.736e9


def test_punch_pressure_carries_the_load():
    # r = a sin t takes the edge singularity away.
    carried, _ = quad(
        lambda t: 2 * np.pi * np.sin(t) * np.cos(t) * float(punch.pressure(np.sin(t), 7.0, 1.0)),
        0.0,
        np.pi / 2,
    )
    assert carried == pytest.approx(7.0, rel=1e-7)
    assert punch.pressure([0.0, 1.5], 7.0, 1.0) == pytest.approx(
        [7 / (2 * np.pi), 0.0], rel=1e-6, abs=0
    )


def test_punch_approach_is_the_displacement_of_its_pressure():
    # On the axis u = (2/E*) ∫ p dr, the sum of rings.
    total, _ = quad(lambda t: np.cos(t) * float(punch.pressure(np.sin(t), 7.0, 1.0)), 0, np.pi / 2)
    assert punch.approach(7.0, 1.0, MODULUS) == pytest.approx(2 * total / MODULUS, rel=1e-7, abs=0)


def test_cone_pressure_carries_the_load_and_bends_the_surface():
    contact = cone.cone(50.0, np.radians(85.0), MODULUS)
    a = contact.half_width
    carried, _ = quad(
        lambda r: 2 * np.pi * r * float(cone.pressure(r, 50.0, np.radians(85.0), MODULUS)), 0, a
    )
    centre, _ = quad(lambda r: float(cone.pressure(r, 50.0, np.radians(85.0), MODULUS)), 0, a)
    assert carried == pytest.approx(50.0, rel=1e-7)
    assert contact.approach == pytest.approx(2 * centre / MODULUS, rel=1e-6)
    assert contact.mean_pressure == pytest.approx(50.0 / (np.pi * a**2), rel=1e-12)


def test_sinusoid_wears_as_its_equation_says():
    q = 2 * np.pi / 1e-4
    compliance = sinusoid.compliance(q, MODULUS)
    k, s = 3.11e-16, 2.0
    left = sinusoid.worn_amplitude(s, k, compliance)
    assert left == pytest.approx(np.exp(-k * MODULUS * q * s / 2), rel=1e-12, abs=0)


def test_westergaard_at_0_4_of_complete_contact():
    complete = np.pi * MODULUS * 1e-6 / 1e-4
    contact = sinusoid.westergaard(0.4 * complete, 1e-6, 1e-4, MODULUS)
    # Known to four digits.
    assert contact.contact_fraction == pytest.approx(0.4359, abs=5e-5)
    assert contact.peak_pressure / contact.complete == pytest.approx(1.2649, abs=5e-5)


@pytest.mark.parametrize("ratio", [0.4, 1.5])
def test_westergaard_pressure_carries_the_load(ratio):
    complete = np.pi * MODULUS * 1e-6 / 1e-4
    contact = sinusoid.westergaard(ratio * complete, 1e-6, 1e-4, MODULUS)
    half = contact.contact_fraction * 0.5e-4

    def pressure(x):
        return float(sinusoid.westergaard_pressure(x, contact, 1e-4))

    carried, _ = quad(pressure, -half, half, epsabs=0, epsrel=1e-10)
    assert carried / 1e-4 == pytest.approx(ratio * complete, rel=1e-7)
    assert pressure(0.0) == pytest.approx(contact.peak_pressure, rel=1e-12)
