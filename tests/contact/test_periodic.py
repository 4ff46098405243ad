"""The periodic half-space: its modes, waves pressed flat, and contact between the limits."""

import numpy as np
import pytest
from contact_problems import MODULUS, problem

from tribo.contact.periodic import Periodic


def solve(gap, size, load):
    return Periodic().solve(problem(gap, size, load))


@pytest.mark.parametrize("amplitude", [1e-10, 1e-14, 1e-18])
def test_what_is_worn_to_almost_flat_is_solved_down_to_rounding(amplitude):
    shape, width = (32, 24), 1e-3
    gap = amplitude * np.random.default_rng(0).standard_normal(shape)
    along, across = (2 * np.pi * np.fft.fftfreq(n, width / n) for n in shape)
    stiffness = 0.5 * MODULUS * np.hypot(along[:, None], across)
    expected = 1e8 - np.fft.ifft2(stiffness * np.fft.fft2(gap)).real
    found = solve(gap, (width, width), 1e8 * width**2)
    assert found.pressure == pytest.approx(expected, rel=1e-14)


def test_a_contact_without_gaps_takes_no_iteration():
    wave = 1e-7 * np.cos(2 * np.pi * (np.arange(32) + 0.5) / 32)
    closes = np.pi * MODULUS * 1e-7 / 1e-3 * 1e-6
    iterations = [solve(wave[:, None] + wave, (1e-3, 1e-3), f * closes).iterations for f in (1, 3)]
    assert iterations[0] > iterations[1] == 0
