"""The first loading of a contact from rest, from which a whole cycle follows."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from tribo import Array, Grid, Material

from tribo_fretting.cerruti import Cerruti, cerruti, tangential_compliances
from tribo_fretting.drive import Drive
from tribo_fretting.projected_cg import Drag, dragged

SMALLEST = 16
"""Edge of the smallest box in which a traction is found, in cells."""


def first_loading(
    drive: Drive,
    grid: Grid,
    materials: Mapping[str, Material],
    pressure: Array,
    friction: Array,
    amplitude: float,
) -> Drag:
    """Drag a contact from rest to the reversal, where the traction is q₁ and the slip s₁.

    Under a steady pressure a motion between ±δ leads to the tractions ±q₁, and each point slips
    4 s₁ a cycle: Masing's rule. With a rig the contact moves by δ less Q/k; with a force amplitude
    by less, if Q reaches it. Answers are kept while the same contact is asked for again.

    Pressure (Pa) and coefficient of friction have the shape of the grid, the amplitude δ is in m.
    The answer has both components of the traction.
    """
    limit = np.where(pressure > 0, friction * pressure, 0.0)
    compliances = tangential_compliances(materials.values())
    return _loading(drive, grid.cells, grid.spacing, compliances, limit.tobytes(), amplitude)


@lru_cache(maxsize=8)
def _loading(
    drive: Drive,
    cells: tuple[int, int],
    spacing: tuple[float, float],
    compliances: tuple[float, float],
    limits: bytes,
    amplitude: float,
) -> Drag:
    limit = np.frombuffer(limits).reshape(cells)
    rows, columns = _extent(limit)
    near = limit[rows, columns]
    box = np.zeros((_edge(near.shape[0]), _edge(near.shape[1])))
    box[: near.shape[0], : near.shape[1]] = near
    components = 2 if drive.direction == "free" else 1
    operator = cerruti(box.shape, spacing, compliances, components)
    inside = _settled(drive, operator, box, amplitude, spacing[0] * spacing[1])
    traction = np.zeros((2, *cells))
    traction[:components, rows, columns] = inside.traction[:, : near.shape[0], : near.shape[1]]
    # Beyond the contact, as a point that comes to be touched would slip.
    moved = cerruti(cells, spacing, compliances, 2).apply(traction)
    slip = np.hypot(inside.displacement - moved[0], moved[1] if components == 2 else 0.0)
    pressed = limit > 0
    slip[pressed] = inside.slip[box > 0]
    for array in (traction, slip):
        array.setflags(write=False)
    return Drag(inside.displacement, traction, slip, inside.iterations)


def _settled(drive: Drive, operator: Cerruti, limit: Array, amplitude: float, area: float) -> Drag:
    """Drag until the rig's amplitude or the force amplitude is reached, whichever is first."""
    last: list[Drag] = []

    def excess(displacement: float) -> float:
        start = last[-1].traction if last else None
        drag = dragged(operator, displacement, limit, start, drive.tolerance)
        last[:] = [drag]
        force = float(np.sum(drag.traction[0])) * area
        rig = force / drive.stiffness if drive.stiffness else 0.0
        ratio = force / drive.force_amplitude if drive.force_amplitude else 0.0
        return max((displacement + rig) / amplitude, ratio) - 1

    if excess(amplitude) > 0:
        known = {0.0: -1.0, amplitude: excess(amplitude)}
        ends = drive.tolerance * amplitude
        root = brentq(lambda x: known[x] if x in known else excess(x), 0.0, amplitude, xtol=ends)
        excess(root)
    return last[0]


def _extent(limit: Array) -> tuple[slice, slice]:
    """Return the rows and columns of the cells that bear a traction; one cell if there are none."""
    lines = [np.flatnonzero(limit.any(axis=axis)) for axis in (1, 0)]
    rows, columns = (slice(int(at[0]), int(at[-1]) + 1) if len(at) else slice(0, 1) for at in lines)
    return rows, columns


def _edge(cells: int) -> int:
    """Return an edge of few distinct lengths, {4, 5, 6, 7}·2^k cells, so that kernels serve."""
    unit = SMALLEST // 4
    while 7 * unit < cells:
        unit *= 2
    return max(SMALLEST, unit * -(-cells // unit))
