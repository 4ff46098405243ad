"""Love's kernel and the operator made from it."""

import numpy as np
import pytest
from contact_problems import MODULUS, dense

from tribo.contact.love import nyquist_compliance
from tribo.contact.padded_half_space import HalfSpace

SHAPE, SPACING = (7, 10), (2e-6, 3e-6)


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 2.5), (3.0, 1.0)])
def test_no_pressure_is_stiffer_than_the_chequerboard(spacing):
    smallest = np.linalg.eigvalsh(dense((16, 16), spacing)).min() * MODULUS
    # A finite grid approaches its limit from above.
    assert 1.0 < smallest / nyquist_compliance(spacing) < 1.05


@pytest.mark.parametrize("shape", [SHAPE, (1, 1), (1, 6), (8, 8)])
def test_half_space_is_the_direct_sum_over_cells(shape):
    p = np.random.default_rng(0).random(shape)
    direct = (dense(shape, SPACING) @ p.ravel()).reshape(shape)
    operator = HalfSpace(shape, SPACING, MODULUS)
    assert operator.apply(p) == pytest.approx(direct, rel=1e-13, abs=0)


@pytest.mark.parametrize("shape", [(8, 8), (1, 40), (3, 200), (96, 20), (64, 64)])
def test_symbol_is_positive_on_any_box(shape):
    symbol = HalfSpace(shape, (1e-6, 4e-6), MODULUS).symbol()
    assert symbol.shape == (shape[0], shape[1] // 2 + 1)
    assert symbol.min() > 0
