"""Displacements under a tangential traction."""

import numpy as np
import pytest
from tribo import Material

from tribo_fretting.cerruti import coefficients, tangential_compliances

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
