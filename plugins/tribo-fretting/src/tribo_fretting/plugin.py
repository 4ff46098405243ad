"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from tribo import CaseError, Component, Finding, LabRow, Result, hookimpl

from tribo_fretting.cerruti import dundurs_beta
from tribo_fretting.cycles import SavedCycle, motion_of
from tribo_fretting.motion import Fretting
from tribo_fretting.partial_slip import NARROW, PartialSlip

if TYPE_CHECKING:
    from tribo.kernel_api import Model

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
def tribo_findings(model: Model) -> list[Finding]:
    """Say what partial slip refuses of the first contact on the cells of the case."""
    from tribo.kernel_api import Memory, Moment, begin, local_fields

    state = begin(model)
    at, kept = Moment(state.time, state.distance, state.speed), Memory({}, state.between)
    try:
        local_fields(model, state.contact.pressure, at, 0, kept)
    except CaseError as error:
        words = f"a run would stop at once: {error}"
        return [Finding("partial slip", words, limit=NARROW, place=error.path)]
    return []


@hookimpl
def tribo_lab_rows(result: Result) -> list[LabRow]:
    """Offer the force, energy and stick zone of the last cycle, and the volume per energy."""
    motion = motion_of(result)
    if motion is None:
        return []
    cycle = SavedCycle(result, motion, -1)
    stuck, spacing = cycle.stuck, result.grid.spacing
    part = float(np.sum(stuck) / np.sum(cycle.pressure > 0))
    widths = [
        0.5e6 * d * np.count_nonzero(stuck.any(axis=1 - axis)) for axis, d in enumerate(spacing)
    ]
    rows = [
        LabRow("tangential force", cycle.force, "N"),
        LabRow("energy of a cycle", 1e6 * cycle.energy, "µJ"),
        LabRow("stick part of the contact (0: gross slip)", part, ""),
        LabRow("half-width of the stick zone along x", widths[0], "µm"),
        LabRow("half-width of the stick zone along y", widths[1], "µm"),
    ]
    energy = result.table("history")["friction_energy_J"][-1]
    if energy > 0:
        volume = sum(body["wear_volume_m3"] for body in result.saves()[-1]["bodies"].values())
        rows.append(LabRow("worn volume per energy", 1e9 * volume / float(energy), "mm³/J"))
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
    from tribo_fretting.figures import loops, slip_map

    cycles = [SavedCycle(result, motion, save) for save in range(len(result.times))]
    return {
        "fretting_loops": partial(loops, cycles, motion.frequency),
        "slip_map": partial(slip_map, cycles[-1]),
    }
