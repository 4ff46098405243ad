"""The memory that a case needs, and the memory available."""

from __future__ import annotations

import math
from collections.abc import Sequence

from tribo.case import Case
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.effects.effect import Effect
from tribo.guards.parts import GuardedEffect
from tribo.model.cycle import Cycle

FIELDS = 88
"""Arrays of the window's size that a run holds at its peak.

83 were measured, where a ball's contact grows until it fills the window: 768² cells.
"""
FIELDS_IF_PLASTIC = 16
"""Further arrays for yielding; 14 were measured."""
FIELDS_PER_FIELD = 8
"""Further arrays for each state field of a law or field of an effect; 7 were measured."""
FIELDS_PER_POSITION = 40
"""Further arrays for each position of a resolved cycle; 38 were measured, with layers."""
BESIDES = 24 * 2.0**20
"""Memory independent of the grid, in bytes; 18 MiB were measured."""


def memory_needed(
    case: Case, effects: Sequence[Effect | GuardedEffect], cycle: Cycle, *, plastic: bool
) -> float:
    """Return the most memory that a run takes beyond what the process has, in bytes.

    `plastic` is whether a body may yield.
    """
    fields = sum(len(body.wear.state_fields) for body in case.bodies.values() if body.wear)
    fields += len(case.bodies) * sum(len(effect.provides) for effect in effects)
    fields += sum(len(effect.state_fields) for effect in effects)
    arrays = FIELDS + FIELDS_IF_PLASTIC * plastic + FIELDS_PER_FIELD * fields
    if len(cycle) > 1:
        arrays += FIELDS_PER_POSITION * len(cycle)
    window = 8.0 * case.grid.cells[0] * case.grid.cells[1]
    # At its end a run makes its file in memory.
    return BESIDES + window * arrays + size_of_fields(case, effects, cycle)


def size_of_fields(case: Case, effects: Sequence[Effect | GuardedEffect], cycle: Cycle) -> float:
    """Return the size of all fields that a result keeps, before they are compressed, in bytes."""
    bodies = case.bodies.values()
    states = {field for body in bodies if body.wear for field in body.wear.state_fields}
    states |= {field for effect in effects for field in effect.state_fields}
    provided = sum(len(effect.provides) for effect in effects)
    # The pressure, and for each body wear, plastic depth and what its models keep.
    each = 1 + len(bodies) * (2 + provided + len(states))
    saves = 2 + len(case.output.save_times)
    nx, ny = case.grid.cells
    # And all bodies' rows along a track that is longer than the window: wear, what
    # has yielded and what laws remember.
    longest = max(exposure.rows for exposure in cycle.maps.values())
    kept = 1 + any(body.material.hardness is not None for body in bodies) + len(states)
    track = kept * len(bodies) * longest if longest > nx else 0
    return 8.0 * ny * (nx * len(bodies) + saves * (nx * each + track))


def memory_left() -> tuple[float, str]:
    """Return the bytes that this process may still take, and what sets the limit.

    Without psutil nothing is known of a limit.
    """
    try:
        import psutil
    except ImportError:
        return math.inf, "no known limit"
    process = psutil.Process()
    size = process.memory_info()
    least = float(psutil.virtual_memory().total - size.rss), "this machine"
    # Linux and FreeBSD tell it.
    if hasattr(process, "rlimit"):
        soft, _ = process.rlimit(psutil.RLIMIT_AS)
        if soft not in (psutil.RLIM_INFINITY, -1):
            least = min(least, (float(soft - size.vms), "the limit of this process (ulimit -v)"))
    return least


def check_memory(grid: Grid, needed: float) -> None:
    """Raise `CaseError` where a run on `grid` would need more bytes than there are."""
    left, limit = memory_left()
    if needed > left:
        nx, ny = grid.cells
        raise CaseError(
            f"{nx} × {ny} cells take up to {_size(needed)} of memory, and {limit} leaves "
            f"{_size(max(left, 0.0))}: use fewer cells",
            "grid.cells",
        )


def _size(memory: float) -> str:
    return f"{memory / 2**30:.3g} GiB" if memory >= 2**30 else f"{memory / 2**20:.0f} MiB"
