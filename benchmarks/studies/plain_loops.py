"""Wear of a ball and a disk by plain loops over cells and positions: NumPy, and nothing of tribo.

They give the values that the cases loop_* of `tribo verify` expect:

    python -m benchmarks.studies.plain_loops
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
K, RADIUS, LOAD, SPEED = 3.11e-16, 5e-3, 100.0, 0.1
STIFFNESS = 1.2973e15
MODULUS = 0.5 * 207e9 / (1 - 0.3**2)
CELLS, SIZE = (32, 20), (1.2e-3, 0.75e-3)
SPACING = SIZE[0] / CELLS[0], SIZE[1] / CELLS[1]
STROKE = 12
"""In cells."""


def middles(cells: int, size: float) -> Array:
    """Return the middles of equal cells, in m."""
    return np.asarray((np.arange(cells) - 0.5 * (cells - 1)) * size / cells)


def ball(cells: tuple[int, int], size: tuple[float, float], radius: float = RADIUS) -> Array:
    """Return the gap below a ball, in m."""
    x, y = middles(cells[0], size[0])[:, None], middles(cells[1], size[1])
    return np.asarray(radius - np.sqrt(radius**2 - x**2 - y**2))


def pressed(gaps: Array, total: Array | float) -> Array:
    """Return the overlaps of springs with each gap, in m, that add up to `total`."""
    low = gaps.min(axis=(1, 2))
    high = low + total
    for _ in range(50):
        middle = 0.5 * (low + high)
        more = np.maximum(middle[:, None, None] - gaps, 0).sum(axis=(1, 2)) < total
        low, high = np.where(more, middle, low), np.where(more, high, middle)
    return np.maximum(high[:, None, None] - gaps, 0)


def along_stroke(distance: float, steps: int = 1000) -> list[Array]:
    """Wear on springs by forward Euler, at each cell of the stroke."""
    (nx, ny), (dx, dy) = CELLS, SPACING
    worn, disk, gap = np.zeros(CELLS), np.zeros((nx + STROKE, ny)), ball(CELLS, SIZE)
    path = np.full(STROKE + 1, 1 / STROKE)
    path[[0, -1]] /= 2
    for length in distance * np.diff(np.linspace(0, 1, steps + 1) ** 1.5):
        gaps = np.stack([gap + worn + disk[at : at + nx] for at in range(STROKE + 1)])
        p = STIFFNESS * pressed(gaps, LOAD / (dx * dy * STIFFNESS))
        worn += K * length * np.einsum("i,ijk->jk", path, p)
        for at in range(STROKE + 1):
            disk[at : at + nx] += K * length * path[at] * p[at]
    return [worn, disk]


def under_load(load: Callable[[float], float], end: float, steps: int = 1400) -> list[Array]:
    """Wear on springs under a load (N) over time (s), the disk by the average over 2 mm."""
    cells, size = (32, 32), (0.7e-3, 0.7e-3)
    dx = dy = size[0] / cells[0]
    gap, worn, groove = ball(cells, size), np.zeros(cells), np.zeros(cells[1])
    times = end * np.linspace(0, 1, steps + 1) ** 1.5
    for begin, after in pairwise(times):
        total = load(0.5 * (begin + after)) / (dx * dy * STIFFNESS)
        p = STIFFNESS * pressed((gap + worn + groove)[None], total)[0]
        worn += K * SPEED * (after - begin) * p
        groove += K * SPEED * (after - begin) * p.sum(axis=0) * dx / 2e-3
    return [worn, groove]


def influences() -> Array:
    """Displacement (m/Pa) under an even pressure on one cell, at all cells around it.

    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420.
    """

    def corner(u: Array, v: Array) -> Array:
        return np.asarray(u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v)))

    (nx, ny), (dx, dy) = CELLS, SPACING
    x, y = dx * np.arange(1 - nx, nx)[:, None], dy * np.arange(1 - ny, ny)
    parts = [s * t * corner(x + s * dx / 2, y + t * dy / 2) for s in (1, -1) for t in (1, -1)]
    return np.asarray(sum(parts) / (np.pi * MODULUS))


def touching(gap: Array, inside: Array, influence: Array) -> tuple[Array, Array]:
    """Solve a contact of half-spaces from a guess of its cells; return its pressure and cells."""
    (nx, ny), cell = CELLS, SPACING[0] * SPACING[1]
    while True:
        i, j = np.nonzero(inside)
        elastic = influence[i[:, None] - i + nx - 1, j[:, None] - j + ny - 1]
        ones = np.ones((len(i), 1))
        system = np.block([[elastic, -ones], [ones.T, np.zeros((1, 1))]])
        *values, approach = np.linalg.solve(system, [*-gap[inside], LOAD / cell])
        pressures = np.array(values)
        if np.any(pressures < 0):
            inside = inside.copy()
            inside[inside] = pressures >= 0
            continue
        deformed = gap - approach
        for a, b, p in zip(i, j, pressures, strict=True):
            deformed = deformed + p * influence[nx - 1 - a :, ny - 1 - b :][:nx, :ny]
        overlap = ~inside & (deformed < 0)
        if not np.any(overlap):
            pressure = np.zeros(CELLS)
            pressure[inside] = pressures
            return pressure, inside
        inside = inside | overlap


def on_half_spaces(distance: float, steps: int = 200) -> list[Array]:
    """Wear half-spaces by forward Euler at every second cell of the stroke."""
    nx, places = CELLS[0], range(0, STROKE + 1, 2)
    gap, worn, disk = ball(CELLS, SIZE), np.zeros(CELLS), np.zeros((nx + STROKE, CELLS[1]))
    influence, touched = influences(), [gap < 4e-6] * len(places)
    shares = np.array([0.5, 1, 1, 1, 1, 1, 0.5]) / 6
    for length in distance * np.diff(np.linspace(0, 1, steps + 1) ** 1.5):
        solved = [
            touching(gap + worn + disk[at : at + nx], cells, influence)
            for at, cells in zip(places, touched, strict=True)
        ]
        touched = [cells for _, cells in solved]
        for at, share, (pressure, _) in zip(places, shares, solved, strict=True):
            worn += K * length * share * pressure
            disk[at : at + nx] += K * length * share * pressure
    return [worn, disk]


def round_circle(gap: Array, turns: int = 100, count: int = 49) -> list[Array]:
    """Wear a pin and a plate on springs in `count` places of each turn round 0.4 mm."""
    cells, k, load, stiffness, radius, cell = (36, 64), 4e-14, 20.0, 2e14, 0.2e-3, 25e-6
    turn = 2 * np.pi * (np.arange(count) + 0.5) / count
    along, across = (
        np.round(radius * part / cell).astype(int) for part in (np.sin(turn), 1 + np.cos(turn))
    )
    pin, plate = np.zeros(cells), np.zeros((cells[0] + 2 * along.max(), cells[1]))
    ranks = np.arange(1, gap.size + 1)
    for _ in range(turns):
        for i, j in zip(along.max() - along, across, strict=True):
            there = gap + pin + np.roll(plate, -j, axis=1)[i : i + cells[0]]
            heights = np.sort(there, axis=None)
            approach = (load / (stiffness * cell**2) + np.cumsum(heights)) / ranks
            approach = approach[np.flatnonzero(approach > heights)[-1]]
            overlap = np.maximum(approach - there, 0)
            worn = k * stiffness * overlap * 2 * np.pi * radius / count
            pin += worn
            plate[i : i + cells[0]] += np.roll(worn, j, axis=1)
    return [pin, plate]


def main() -> None:
    """Print the largest depths of both bodies, in m."""
    path = 2 * STROKE * SPACING[0] * 25
    for name, worn in {
        "loop_stroke": along_stroke(path * 600),
        "loop_half_space": on_half_spaces(path * 300),
        "loop_blocks": under_load(lambda time: 20.0 if time < 6 else 100.0, 20.0),
        "loop_ramp": under_load(lambda t: float(np.interp(t, [0, 8, 60], [20, 100, 10])), 20.0),
        "loop_circle_ball": round_circle(ball((36, 64), (0.9e-3, 1.6e-3), 20e-3)),
    }.items():
        print(name, *(float(np.max(depth)) for depth in worn))


if __name__ == "__main__":
    main()
