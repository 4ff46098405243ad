"""The first loading of a contact from rest, from which a whole cycle follows."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from tribo import Array, Grid, Material
from tribo.kernel_api import around

from tribo_fretting.cerruti import Cerruti, cerruti, tangential_compliances
from tribo_fretting.drive import Drive
from tribo_fretting.projected_cg import Drag, dragged


def first_loading(
    drive: Drive, grid: Grid, materials: Mapping[str, Material], limit: Array, amplitude: float
) -> Drag:
    """Drag a contact from rest to the reversal, where the traction is q₁ and the slip s₁.

    Under a steady pressure a motion between ±δ leads to the tractions ±q₁, and each point slips
    4 s₁ a cycle: Masing's rule. With a rig the contact moves by δ less Q/k; with a force amplitude
    by less, if Q reaches it. Answers are cached for repeated contacts.

    The limit μp (Pa) has the shape of the grid, the amplitude δ is in m. The answer has both
    components of the traction, and beyond the contact the slip of a point when it first touches.
    """
    compliances = tangential_compliances(materials.values())
    return _loading(drive, grid, compliances, limit.tobytes(), amplitude)


@lru_cache(maxsize=8)
def _loading(
    drive: Drive, grid: Grid, compliances: tuple[float, float], limits: bytes, amplitude: float
) -> Drag:
    cells, spacing, area = grid.cells, grid.spacing, grid.cell_area
    limit = np.frombuffer(limits).reshape(cells)
    pressed = limit > 0
    box = around(pressed, 0)
    rig = area / drive.stiffness if drive.stiffness else 0.0
    operator = cerruti(box.shape, spacing, compliances, drive.components, rig)
    inside = _turned(drive, operator, limit[box.slices], amplitude, area)
    traction = np.zeros((2, *cells))
    traction[: drive.components] = box.embed(inside.traction)
    displacement = inside.displacement - rig * float(np.sum(traction[0]))
    moved = cerruti(cells, spacing, compliances, 2).apply(traction)
    beyond = np.hypot(displacement - moved[0], moved[1] * (drive.components - 1))
    slip = np.where(pressed, box.embed(inside.slip), beyond)
    for array in (traction, slip):
        array.setflags(write=False)
    return Drag(displacement, traction, slip, inside.iterations)


def _turned(drive: Drive, operator: Cerruti, limit: Array, amplitude: float, area: float) -> Drag:
    """Drag by the amplitude of the rig, or until the amplitude of the force is reached."""
    last = [dragged(operator, amplitude, limit, tolerance=drive.tolerance)]
    force = np.inf if drive.force_amplitude is None else drive.force_amplitude / area

    def excess(shift: float) -> float:
        if shift in (0.0, amplitude):
            return float(np.sum(last[0].traction[0])) * shift / amplitude - force
        last.append(dragged(operator, shift, limit, last[-1].traction, drive.tolerance))
        return float(np.sum(last[-1].traction[0])) - force

    if excess(amplitude) > 0:
        excess(brentq(excess, 0.0, amplitude, xtol=drive.tolerance * amplitude))
    return last[-1]
