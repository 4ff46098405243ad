"""A resolved cycle of elastic half-spaces, against plain NumPy that solves and wears by itself."""

import numpy as np
import pytest
from paper_models import K, half_space, last
from stroke import GRID, resolved

from tribo import Implicit

(NX, NY), (DX, DY) = GRID.cells, GRID.spacing
MODULUS = 0.5 * 207e9 / (1 - 0.3**2)
LOAD = 100.0
PLACES = range(0, 13, 2)
"""Rows of the disk at which the window begins: seven positions, three half-widths in all."""


def influences():
    """Displacement (m/Pa) under an even pressure on one cell, at all cells around it.

    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420.
    """

    def corner(u, v):
        return u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v))

    x, y = DX * np.arange(1 - NX, NX)[:, None], DY * np.arange(1 - NY, NY)
    signs = (1, -1)
    parts = [s * t * corner(x + s * DX / 2, y + t * DY / 2) for s in signs for t in signs]
    return sum(parts) / (np.pi * MODULUS)


def touching(gap, inside, influence):
    """Solve a contact from a guess of its cells; return its pressure and its cells."""
    while True:
        i, j = np.nonzero(inside)
        elastic = influence[i[:, None] - i + NX - 1, j[:, None] - j + NY - 1]
        ones = np.ones((len(i), 1))
        system = np.block([[elastic, -ones], [ones.T, np.zeros((1, 1))]])
        *pressures, approach = np.linalg.solve(system, [*-gap[inside], LOAD / (DX * DY)])
        pressures = np.array(pressures)
        if np.any(pressures < 0):
            inside = inside.copy()
            inside[inside] = pressures >= 0
            continue
        deformed = gap - approach
        for a, b, p in zip(i, j, pressures, strict=True):
            deformed = (
                deformed + p * influence[NX - 1 - a : 2 * NX - 1 - a, NY - 1 - b : 2 * NY - 1 - b]
            )
        overlap = ~inside & (deformed < 0)
        if not np.any(overlap):
            pressure = np.zeros(GRID.cells)
            pressure[inside] = pressures
            return pressure, inside
        inside = inside | overlap


@pytest.mark.slow
def test_both_bodies_wear_as_in_a_plain_loop_over_half_spaces():
    stepping = Implicit(depth_tolerance=3e-4, pressure_tolerance=0.02)
    state = last(resolved(len(PLACES), duration=300, contact=half_space(), stepping=stepping))
    x, y = GRID.mesh
    gap = 5e-3 - np.sqrt(25e-6 - x**2 - y**2)
    ball, disk = np.zeros((NX, NY)), np.zeros((NX + 12, NY))
    influence, touched = influences(), [gap < 4e-6] * len(PLACES)
    shares = np.array([0.5, 1, 1, 1, 1, 1, 0.5]) / 6
    for length in state.distance * np.diff(np.linspace(0, 1, 101) ** 1.5):
        solved = [
            touching(gap + ball + disk[at : at + NX], cells, influence)
            for at, cells in zip(PLACES, touched, strict=True)
        ]
        touched = [cells for _, cells in solved]
        for at, share, (pressure, _) in zip(PLACES, shares, solved, strict=True):
            ball += K * length * share * pressure
            disk[at : at + NX] += K * length * share * pressure
    for name, expected in (("ball", ball), ("disk", disk)):
        assert np.max(np.abs(state.bodies[name].wear - expected)) < 5e-3 * expected.max()
    # The ends of the groove are shallower than its middle.
    assert disk[22, 10] > 1.3 * disk[10, 10]
