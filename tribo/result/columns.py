"""The scalars of a result: one list for files, tables, JSON and CSV."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tribo.core.measures import BodyMeasures, Measures


def labelled(name: str, unit: str) -> str:
    """Return a name with its unit, as ``max_pressure_Pa`` or ``dissipated_energy_J_m2``."""
    suffix = re.sub(r"\W+", "_", unit.replace("^", ""))
    return name if unit == "1" else f"{name}_{suffix}"


@dataclass(frozen=True)
class Column:
    """A named scalar with its unit, its meaning, and its path in measures if that is not its name.

    A roughness that measures lack, of a body that is smooth, is NaN.
    """

    name: str
    unit: str
    description: str
    path: str = ""

    @property
    def label(self) -> str:
        """Name with the unit, as in JSON and CSV: ``max_pressure_Pa``."""
        return labelled(self.name, self.unit)

    def read(self, measures: Measures | BodyMeasures) -> float:
        """Return its value in `unit`."""
        value: Any = measures
        for part in (self.path or self.name).split("."):
            known = isinstance(value, Mapping)
            value = value.get(part, math.nan) if known else getattr(value, part)
        return float(value)


COLUMNS = (
    Column("time", "s", "Time"),
    Column("distance", "m", "Path slid"),
    Column("load", "N", "Normal load, mean over the path of a cycle"),
    Column("load_distance", "N m", "Load times path, summed over the run"),
    Column("friction_force", "N", "Friction force, mean over a cycle; 0 at rest"),
    Column("friction_energy", "J", "Work of friction, summed over the run"),
    Column("max_pressure", "Pa", "Largest contact pressure"),
    Column("centre_pressure", "Pa", "Pressure at the window's centre"),
    Column("contact_half_width_x", "m", "Half the contact's extent along x", "half_width_x"),
    Column("contact_half_width_y", "m", "Half the contact's extent along y", "half_width_y"),
    Column("contact_area", "m^2", "Area of the cells in contact", "area"),
    Column("plastic_area", "m^2", "Area of the cells at the hardness limit"),
    Column("approach", "m", "Rigid approach of the bodies"),
    Column("force_error", "1", "Relative error of the load carried", "residuals.force"),
    Column(
        "complementarity_error", "1", "Relative gap under pressure", "residuals.complementarity"
    ),
    Column(
        "penetration_error", "1", "Relative overlap outside the contact", "residuals.penetration"
    ),
    Column(
        "volume_error",
        "1",
        "Volume worn in the step against that of the laws, relative",
        "invariants.volume",
    ),
    Column("regrowth", "m", "Depth that grew back in the step", "invariants.regrowth"),
    Column(
        "chattering",
        "1",
        "Share of the load that goes back and forth between steps",
        "invariants.chattering",
    ),
    Column(
        "cycle_error",
        "1",
        "Estimated relative error of the wear depth, as it has so many positions",
    ),
    Column("contact_solves", "1", "Contact solves so far"),
    Column("solver_iterations", "1", "Solver iterations so far"),
)

BODY_COLUMNS = (
    Column("max_wear_depth", "m", "Largest wear depth"),
    Column("centre_wear_depth", "m", "Wear depth at the centre"),
    Column("wear_volume", "m^3", "Volume of the whole scar or track"),
    Column("max_plastic_depth", "m", "Largest permanent displacement"),
)

ROUGHNESS_COLUMNS = tuple(
    Column(name, unit, f"{meaning}, within the contact", f"roughness.{labelled(name, unit)}")
    for name, unit, meaning in (
        ("Sa", "m", "Arithmetical mean height"),
        ("Sq", "m", "Root mean square height"),
        ("Sz", "m", "Maximum height"),
        ("Ssk", "1", "Skewness of the heights"),
        ("Sku", "1", "Kurtosis of the heights"),
        ("Ra_along", "m", "Arithmetical mean height of profiles along x"),
        ("Rq_along", "m", "Root mean square height of profiles along x"),
        ("Ra_across", "m", "Arithmetical mean height of profiles along y"),
        ("Rq_across", "m", "Root mean square height of profiles along y"),
    )
)
"""The columns that the history has besides, where a body is rough; NaN for one that is not."""
