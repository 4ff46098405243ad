"""A case on a coarse grid, to estimate what it will do."""

from __future__ import annotations

from tribo.case import Case, Output
from tribo.core.grid import Grid
from tribo.model.model import Model
from tribo.simulation.assembly import as_it_repeats, assemble, varied
from tribo.stepping.implicit import Implicit
from tribo.wear.law import WearLaw

MARGINS = (1.5, 1.0)
"""Edges of the windows to try, in those of the case: the contact may outgrow its own."""
LOOSE = Implicit(depth_tolerance=2e-2, pressure_tolerance=0.5, settle=0.1)


def coarsened(case: Case, cells: int, margin: float, half_width_x: float = 0.0) -> Model:
    """Return the model of a case on a coarse grid, smooth and unworn, its steps long.

    It has `cells` along the longer edge of a window `margin` times as large. With half the extent
    of the first contact along x, in m, a short stroke keeps a few positions; every stroke is
    averaged without.
    """
    largest = max(case.grid.size)
    nx, ny = (max(8, 2 * round(0.5 * cells * size / largest)) for size in case.grid.size)
    lx, ly = (margin * size for size in case.grid.size)
    grid = Grid((lx, ly), (nx, ny), ends_at_window=True)
    motion = case.kinematics.coarsened(half_width_x)
    cycle = motion.cycle(as_it_repeats(grid, case.contact))
    load = case.load.averaged() if len(cycle) == 1 else case.load
    changes = {"kinematics": motion, "load": load.thinned(), "stepping": LOOSE, "begin": None}
    return assemble(varied(smoothed(case), grid=grid, output=Output(), **changes))


def smoothed(case: Case) -> Case:
    """Return a case without the relief of its surfaces and of its wear laws."""

    def smooth(law: WearLaw | None) -> WearLaw | None:
        return None if law is None else law.smoothed()

    bodies = {}
    for name, body in case.bodies.items():
        layers = (each.model_copy(update={"wear": smooth(each.wear)}) for each in body.layers)
        form = {"surface": body.surface.smoothed(), "wear": smooth(body.wear)}
        bodies[name] = body.model_copy(update={**form, "layers": tuple(layers)})
    return case.model_copy(update={"bodies": bodies})
