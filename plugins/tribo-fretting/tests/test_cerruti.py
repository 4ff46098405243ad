"""Displacements under a tangential traction."""

import numpy as np
import pytest
from tribo import HalfSpace, Material, solve_bounded

from tribo_fretting.cerruti import Cerruti, coefficients, dundurs_beta, tangential_compliances

STEEL = Material(young="207 GPa", poisson=0.3)
TITANIUM = Material(young="116 GPa", poisson=0.32)
PAIR = tangential_compliances([STEEL, TITANIUM])
SPACING = (2e-6, 3e-6)


def test_far_from_a_cell_it_is_a_point_force():
    whole, mixed = PAIR
    uxx, uyy, uxy = coefficients((80, 80), SPACING, PAIR)
    i, j = 30, 25
    x, y = i * SPACING[0], j * SPACING[1]
    r, area = np.hypot(x, y), SPACING[0] * SPACING[1]
    expected = [(whole - mixed) / r + mixed * s**2 / r**3 for s in (x, y)]
    assert [uxx[i, j], uyy[i, j]] == pytest.approx([area * u for u in expected], rel=1e-3, abs=0)
    assert uxy[i, j] == pytest.approx(area * mixed * x * y / r**3, rel=1e-3, abs=0)
    assert [uxy[-i, j], uxy[-i, -j]] == [-uxy[i, j], uxy[i, j]]


def test_an_even_traction_on_a_square_moves_its_middle_as_by_integration():
    # Over a square, the integrals of 1/r and of x²/r³ are 8 L ln(1 + √2) and half of that.
    whole, mixed = PAIR
    size = 17 * 1e-6
    operator = Cerruti((17, 17), (1e-6, 1e-6), PAIR, 2)
    traction = np.zeros((2, 17, 17))
    traction[0] = 1.0
    integral = 4 * size * np.log(1 + np.sqrt(2))
    middle = operator.apply(traction)[:, 8, 8]
    assert middle[0] == pytest.approx((whole - 0.5 * mixed) * integral, rel=1e-12, abs=0)
    assert abs(middle[1]) <= 1e-12 * middle[0]


def test_the_padded_operator_is_the_sum_over_cells_and_symmetric():
    operator = Cerruti((6, 7), SPACING, PAIR, 2)
    uxx, uyy, uxy = coefficients((30, 30), SPACING, PAIR)
    generator = np.random.default_rng(1)
    one, other = generator.normal(size=(2, 2, 6, 7))
    direct = np.zeros((2, 6, 7))
    for i, j in np.ndindex(6, 7):
        near = np.ix_(np.arange(6) - i, np.arange(7) - j)
        direct[0] += uxx[near] * one[0, i, j] + uxy[near] * one[1, i, j]
        direct[1] += uxy[near] * one[0, i, j] + uyy[near] * one[1, i, j]
    assert operator.apply(one) == pytest.approx(direct, rel=1e-11, abs=1e-13 * direct.max())
    back = np.sum(one * operator.apply(other))
    assert np.sum(other * operator.apply(one)) == pytest.approx(back, rel=1e-12, abs=0)


def test_without_poissons_ratio_it_is_loves_displacement():
    cork = Material(young="200 GPa", poisson=0.0)
    operator = Cerruti((16, 16), SPACING, tangential_compliances([cork, cork]), 1)
    x, y = ((np.arange(16) - 7.5) * d for d in SPACING)
    gap = (x[:, None] ** 2 + y**2) / 2e-3
    # 1/(πG) = 1/(πE*) for ν = 0 and G = E*: a tangential solve is a normal one.
    normal = HalfSpace((16, 16), SPACING, 100e9)
    assert operator.apply(gap) == pytest.approx(normal.apply(gap), rel=1e-12, abs=0)
    pressures = [solve_bounded(each, gap, 0.05).pressure for each in (operator, normal)]
    assert pressures[0] == pytest.approx(pressures[1], rel=1e-5, abs=1e-7 * pressures[1].max())


def test_bodies_of_one_material_are_not_coupled():
    assert dundurs_beta([STEEL, STEEL]) == 0
    # Dundurs (1969): β = ½ [μ₁(1 − 2ν₂) − μ₂(1 − 2ν₁)]/[μ₁(1 − ν₂) + μ₂(1 − ν₁)].
    shear = [m.young / (2 * (1 + m.poisson)) for m in (STEEL, TITANIUM)]
    above = shear[0] * (1 - 2 * 0.32) - shear[1] * (1 - 2 * 0.3)
    below = shear[0] * (1 - 0.32) + shear[1] * (1 - 0.3)
    beta = abs(dundurs_beta([STEEL, TITANIUM]))
    assert beta == pytest.approx(0.5 * above / below, rel=1e-12, abs=0)
