"""The scalars of a result: one list for files, tables, JSON and CSV."""

from __future__ import annotations

from functools import partial
from typing import Any

from tribo.core.column import Column
from tribo.core.state import Snapshot


def _measured(
    name: str, unit: str, description: str, path: str = "", *, of_bodies: bool = False
) -> Column:
    """Return a column of the measures of a snapshot, at a path there if that is not its name."""

    def read(snapshot: Snapshot, *body: str) -> float:
        value: Any = snapshot.measures.bodies[body[0]] if body else snapshot.measures
        for part in (path or name).split("."):
            value = getattr(value, part)
        return float(value)

    return Column(name, unit, description, read, of_bodies)


_of_body = partial(_measured, of_bodies=True)

INVARIANTS = (
    _measured("force_error", "1", "Relative error of the load carried", "residuals.force"),
    _measured(
        "complementarity_error", "1", "Relative gap under pressure", "residuals.complementarity"
    ),
    _measured(
        "penetration_error", "1", "Relative overlap outside the contact", "residuals.penetration"
    ),
    _measured(
        "volume_error",
        "1",
        "Relative error of the volume worn in the step, against the laws",
        "invariants.volume",
    ),
    _measured("regrowth", "m", "Depth that grew back in the step", "invariants.regrowth"),
)
"""Errors of the invariants of a run."""

COLUMNS = (
    _measured("time", "s", "Time"),
    _measured("distance", "m", "Path slid"),
    _measured("load", "N", "Normal load, mean over the path of a cycle"),
    _measured("load_distance", "N m", "Load times path, summed over the run"),
    _measured("friction_force", "N", "Friction force, mean over a cycle; 0 at rest"),
    _measured("friction_energy", "J", "Work of friction, summed over the run"),
    _measured("max_pressure", "Pa", "Largest contact pressure"),
    _measured("centre_pressure", "Pa", "Pressure at the window's centre"),
    _measured("contact_half_width_x", "m", "Half the contact's extent along x", "half_width_x"),
    _measured("contact_half_width_y", "m", "Half the contact's extent along y", "half_width_y"),
    _measured("contact_area", "m^2", "Area of the cells in contact", "area"),
    _measured("plastic_area", "m^2", "Area of the cells at the hardness limit"),
    _measured("approach", "m", "Rigid approach of the bodies"),
    *INVARIANTS,
    _measured("contact_solves", "1", "Contact solves so far"),
    _measured("solver_iterations", "1", "Solver iterations so far"),
)

BODY_COLUMNS = (
    _of_body("max_wear_depth", "m", "Largest wear depth"),
    _of_body("centre_wear_depth", "m", "Wear depth at the centre"),
    _of_body("wear_volume", "m^3", "Volume of the whole scar or track"),
    _of_body("max_plastic_depth", "m", "Largest permanent displacement"),
)
