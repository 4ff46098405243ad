"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tribo import Component, LabRow, Result, hookimpl

from tribo_fretting.cerruti import dundurs_beta
from tribo_fretting.cycles import SavedCycle, motion_of
from tribo_fretting.figures import loops, slip_map
from tribo_fretting.motion import Fretting
from tribo_fretting.partial_slip import PartialSlip

COUPLED = 0.02
"""|β|μ above which a report warns that traction and pressure act on each other."""


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer the motion of fretting, and the partial slip that it brings along."""
    return (Fretting, PartialSlip)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)


@hookimpl
def tribo_lab_rows(result: Result) -> list[LabRow]:
    """Offer the force, energy and stick zone of the last cycle, and the volume per energy."""
    motion = motion_of(result)
    if motion is None:
        return []
    cycle = SavedCycle(result, motion, -1)
    last = {name: float(column[-1]) for name, column in result.table("saves").items()}
    stuck, part = cycle.stuck, float(np.sum(cycle.stuck) / np.sum(cycle.pressure > 0))
    rows = [
        LabRow("tangential force", last["tangential_force_N"], "N"),
        LabRow("energy of a cycle", 1e6 * last["cycle_energy_J"], "µJ"),
        LabRow("stick part of the contact (0: gross slip)", part, ""),
    ]
    for axis, spacing in enumerate(result.grid.spacing):
        width = 0.5e6 * spacing * np.count_nonzero(stuck.any(axis=1 - axis))
        rows.append(LabRow(f"half-width of the stick zone along {'xy'[axis]}", width, "µm"))
    energy = last["friction_energy_J"]
    if energy > 0:
        volume = sum(body["wear_volume_m3"] for body in result.saves()[-1]["bodies"].values())
        rows.append(LabRow("worn volume per energy", 1e9 * volume / energy, "mm³/J"))
    coupling = abs(dundurs_beta(cycle.materials.values())) * float(np.max(cycle.friction))
    if coupling > 0:
        rows.append(LabRow("coupling of traction and pressure", coupling, "", COUPLED))
    return rows


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the loops of force over displacement, and a map of the slip."""
    motion = motion_of(result)
    if motion is None:
        return {}
    cycles = [SavedCycle(result, motion, save) for save in range(len(result.times))]
    return {
        "fretting_loops": partial(loops, cycles, motion.frequency),
        "slip_map": partial(slip_map, cycles[-1]),
    }
