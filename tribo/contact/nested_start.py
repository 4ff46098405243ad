"""The nested start: a contact problem on half the cells, and its pressure on the fine grid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tribo.core.arrays import Array
from tribo.core.box import Box, around
from tribo.core.contact import ContactProblem, WearCompliance
from tribo.core.grid import Grid


def coarsen(problem: ContactProblem) -> ContactProblem:
    """Return `problem` on cells of twice the edge length.

    Along an axis with an even count, cells are averaged in pairs; with an odd
    count every other cell is kept, from the first to the last, which keeps a
    symmetric problem symmetric.
    """
    grid = problem.system.grid
    cells = (grid.cells[0] + 1) // 2, (grid.cells[1] + 1) // 2
    size = 2 * grid.spacing[0] * cells[0], 2 * grid.spacing[1] * cells[1]
    wear = problem.wear
    if wear is not None:
        local = _halve(_halve(wear.local, 0), 1)
        wear = WearCompliance(local=local, swept=_halve(wear.swept, 0))
    return replace(
        problem,
        system=replace(problem.system, grid=Grid(size=size, cells=cells)),
        gap=_halve(_halve(problem.gap, 0), 1),
        cap=None if problem.cap is None else _halve(_halve(problem.cap, 0), 1),
        wear=wear,
    )


def prolong(pressure: Array, cells: tuple[int, int]) -> Array:
    """Return `pressure` of a coarsened problem on the finer grid of `cells`."""
    # Only the contact is refined, which is a small part of most windows.
    box = around(pressure > 0, 1)
    part = pressure[box.slices]
    for axis in (0, 1):
        coarse = np.moveaxis(part, axis, 0)
        even = cells[axis] % 2 == 0
        fine = np.empty((2 * len(coarse) - (0 if even else 1), coarse.shape[1]))
        fine[::2] = coarse
        fine[1::2] = coarse if even else 0.5 * (coarse[:-1] + coarse[1:])
        part = np.moveaxis(fine, 0, axis)
    first = 2 * box.first[0], 2 * box.first[1]
    shape = part.shape[0], part.shape[1]
    return Box(first, shape, cells).embed(part)


def _halve(values: Array, axis: int) -> Array:
    lines = np.moveaxis(values, axis, 0)
    even = lines.shape[0] % 2 == 0
    return np.moveaxis(0.5 * (lines[::2] + lines[1::2]) if even else lines[::2], 0, axis)
