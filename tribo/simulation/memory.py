"""The memory that a case needs, and the memory of the machine."""

from __future__ import annotations

from tribo.case import Case
from tribo.core.errors import CaseError
from tribo.core.grid import Grid

FIELDS = 104
"""Arrays of the window's size that a run holds at its peak.

83 were measured, where the contact of a ball grows until it fills the window, 768² cells, and 14
more where it yields.
"""
FIELDS_PER_POSITION = 40
"""Further arrays for each position of a resolved cycle; 38 were measured, with layers."""
BESIDES = 24 * 2.0**20
"""Memory independent of the grid, in bytes; 18 MiB were measured."""


def memory_needed(case: Case, positions: int) -> float:
    """Return about the most memory that a run takes beyond what the process has, in bytes.

    Not counted are 7 more arrays for each field that a law remembers or an effect provides.
    """
    arrays = FIELDS + FIELDS_PER_POSITION * (positions - 1)
    # At its end a run makes its file in memory: the pressure, and of each body wear and yield.
    arrays += (2 + len(case.output.save_times)) * (1 + 2 * len(case.bodies))
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
