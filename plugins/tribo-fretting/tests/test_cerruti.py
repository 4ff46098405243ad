"""Displacements under a tangential traction."""

import numpy as np
import pytest
from tribo import HalfSpace, Material

from tribo_fretting.cerruti import Cerruti, coefficients, tangential_compliances

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
    assert operator.apply(gap[None])[0] == pytest.approx(normal.apply(gap), rel=1e-12, abs=0)
