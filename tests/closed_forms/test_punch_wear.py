"""Rates of punch wear against their integral equation, solved another way, and known numbers."""

import numpy as np
import pytest

from tribo.closed_forms.punch_wear import disc_rates, strip_rates


def test_the_first_rates_are_the_known_ones():
    assert disc_rates()[:3] == pytest.approx([2.06065, 3.671, 5.259], rel=1e-4)
    assert strip_rates()[:2] == pytest.approx([1.7267, 3.314], rel=1e-4)
    assert strip_rates(odd=True)[0] == pytest.approx(1.0031, abs=5e-5)


@pytest.mark.slow
def test_a_strip_of_cells_tends_to_the_rates():
    # Constant pressure on 400 equal cells, displaced at their centres, mean removed.
    n = 400
    half = 1 / n
    x = (np.arange(n) + 0.5) * 2 / n - 1
    away = x[:, None] - x
    edges = [away + half, away - half]
    antiderivative = [t * np.log(np.abs(t)) - t for t in edges]
    kernel = -2 / np.pi * (antiderivative[0] - antiderivative[1])
    free = np.eye(n) - 1 / n
    compliance = np.linalg.eigvals(free @ kernel @ free).real
    rates = 1 / np.sort(compliance)[::-1][:4]
    expected = np.sort([*strip_rates()[:2], *strip_rates(odd=True)[:2]])
    assert rates == pytest.approx(expected, rel=1e-3)
