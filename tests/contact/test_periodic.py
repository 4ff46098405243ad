"""The periodic half-space: its modes, waves pressed flat, and contact between the limits."""

from __future__ import annotations

import numpy as np
import pytest
from contact_problems import MODULUS, ball, problem

from tribo.contact.periodic import Periodic, PeriodicHalfSpace
from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.grid import Grid


def solve(gap: Array, size: tuple[float, float], load: float) -> ContactSolution:
    return Periodic().solve(problem(gap, size, load))


@pytest.mark.parametrize("shape", [(12, 10), (9, 7), (16, 4)])
def test_each_mode_is_displaced_by_two_over_modulus_and_wavenumber(shape: tuple[int, int]) -> None:
    spacing = (2e-6, 3e-6)
    operator = PeriodicHalfSpace(shape, spacing, MODULUS)
    x, y = Grid((shape[0] * spacing[0], shape[1] * spacing[1]), shape).mesh
    for modes in ((1, 0), (3, 2)):
        q = [2 * np.pi * m / (n * d) for m, n, d in zip(modes, shape, spacing, strict=True)]
        if modes[1] >= shape[1]:
            continue
        pressure = 1e9 * np.cos(q[0] * x + q[1] * y)
        expected = 2 / (MODULUS * np.hypot(*q)) * pressure
        assert operator.apply(pressure) == pytest.approx(expected, abs=1e-12 * expected.max())
    assert operator.apply(np.full(shape, 1e9)) == pytest.approx(0, abs=1e-20)
    assert (operator.symbol() > 0).all()


@pytest.mark.parametrize("amplitude", [1e-10, 1e-14, 1e-18])
def test_what_is_worn_to_almost_flat_is_solved_down_to_rounding(amplitude: float) -> None:
    shape, width = (32, 24), 1e-3
    gap = amplitude * np.random.default_rng(0).standard_normal(shape)
    along, across = (2 * np.pi * np.fft.fftfreq(n, width / n) for n in shape)
    stiffness = 0.5 * MODULUS * np.hypot(along[:, None], across)
    expected = 1e8 - np.fft.ifft2(stiffness * np.fft.fft2(gap)).real
    found = solve(gap, (width, width), 1e8 * width**2)
    assert found.pressure == pytest.approx(expected, rel=1e-14)


def test_the_smallest_compliance_is_that_of_the_chequerboard() -> None:
    case = ball(16)
    stated = Periodic().smallest_compliance(case.system)
    operator = PeriodicHalfSpace((16, 16), case.system.grid.spacing, MODULUS)
    signs = (-1.0) ** np.add.outer(np.arange(16), np.arange(16))
    assert operator.apply(signs) == pytest.approx(stated * signs, rel=1e-12, abs=0)
    assert stated == pytest.approx(operator.symbol().min(), rel=1e-12, abs=0)
