"""The memory that a case needs, and the memory of the machine."""

from __future__ import annotations

from collections.abc import Sequence

from tribo.case import Case
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.effects.effect import Effect
from tribo.guards.parts import GuardedEffect
from tribo.model.cycle import Cycle

FIELDS = 104
"""Arrays of the window's size that a run holds at its peak.

83 were measured, where the contact of a ball grows until it fills the window, 768² cells, and 14
more where it yields.
"""
FIELDS_PER_FIELD = 8
"""Further arrays for each state field of a law or field of an effect; 7 were measured."""
FIELDS_PER_POSITION = 40
"""Further arrays for each position of a resolved cycle; 38 were measured, with layers."""
BESIDES = 24 * 2.0**20
"""Memory independent of the grid, in bytes; 18 MiB were measured."""


def memory_needed(case: Case, effects: Sequence[Effect | GuardedEffect], cycle: Cycle) -> float:
    """Return the most memory that a run takes beyond what the process has, in bytes."""
    fields = sum(len(body.wear.state_fields) for body in case.bodies.values() if body.wear)
    fields += sum(len(effect.provides) * len(case.bodies) for effect in effects)
    fields += sum(len(effect.state_fields) for effect in effects)
    arrays = FIELDS + FIELDS_PER_FIELD * fields + FIELDS_PER_POSITION * (len(cycle) - 1)
    # At its end a run makes its file in memory: the pressure, and of each body wear and yield.
    arrays += (2 + len(case.output.save_times)) * (1 + 2 * len(case.bodies) + fields)
    return BESIDES + 8.0 * case.grid.cells[0] * case.grid.cells[1] * arrays


def check_memory(grid: Grid, needed: float) -> None:
    """Raise `CaseError` where a run on `grid` needs more bytes than this machine has.

    Without psutil nothing is checked.
    """
    try:
        import psutil
    except ImportError:
        return
    total = psutil.virtual_memory().total
    if needed > total:
        nx, ny = grid.cells
        raise CaseError(
            f"{nx} × {ny} cells take up to {needed / 2**30:.3g} GiB of memory, and this machine "
            f"has {total / 2**30:.3g} GiB: use fewer cells",
            "grid.cells",
        )
