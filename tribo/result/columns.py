"""The scalars of a result: one list for files, tables, JSON and CSV."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from tribo.core.measures import BodyMeasures, Measures

M = TypeVar("M")


def labelled(name: str, unit: str) -> str:
    """Return a name with its unit, as ``max_pressure_Pa`` or ``dissipated_energy_J_m2``."""
    suffix = re.sub(r"\W+", "_", unit.replace("^", ""))
    return name if unit == "1" else f"{name}_{suffix}"


@dataclass(frozen=True)
class Column(Generic[M]):
    """A named scalar with its unit, meaning, and how to read it off measures."""

    name: str
    unit: str
    description: str
    read: Callable[[M], float]

    @property
    def label(self) -> str:
        """Name with the unit, as in JSON and CSV: ``max_pressure_Pa``."""
        return labelled(self.name, self.unit)


COLUMNS: tuple[Column[Measures], ...] = (
    Column("time", "s", "Time", lambda m: m.time),
    Column("distance", "m", "Path slid", lambda m: m.distance),
    Column("load", "N", "Normal load, mean over the path of a cycle", lambda m: m.load),
    Column(
        "load_distance", "N m", "Load times path, summed over the run", lambda m: m.load_distance
    ),
    Column("friction_force", "N", "Friction force, mean over a cycle", lambda m: m.friction_force),
    Column(
        "friction_energy", "J", "Work of friction, summed over the run", lambda m: m.friction_energy
    ),
    Column("max_pressure", "Pa", "Largest contact pressure", lambda m: m.max_pressure),
    Column("centre_pressure", "Pa", "Pressure at the window's centre", lambda m: m.centre_pressure),
    Column(
        "contact_half_width_x", "m", "Half the contact's extent along x", lambda m: m.half_width_x
    ),
    Column(
        "contact_half_width_y", "m", "Half the contact's extent along y", lambda m: m.half_width_y
    ),
    Column("contact_area", "m^2", "Area of the cells in contact", lambda m: m.area),
    Column(
        "plastic_area", "m^2", "Area of the cells at the hardness limit", lambda m: m.plastic_area
    ),
    Column("approach", "m", "Rigid approach of the bodies", lambda m: m.approach),
    Column("force_error", "1", "Relative error of the load carried", lambda m: m.residuals.force),
    Column(
        "complementarity_error",
        "1",
        "Relative gap under pressure",
        lambda m: m.residuals.complementarity,
    ),
    Column(
        "penetration_error",
        "1",
        "Relative overlap outside the contact",
        lambda m: m.residuals.penetration,
    ),
    Column(
        "volume_error",
        "1",
        "Volume worn in the step against that of the laws, relative",
        lambda m: m.invariants.volume,
    ),
    Column("regrowth", "m", "Depth that grew back in the step", lambda m: m.invariants.regrowth),
    Column(
        "chattering",
        "1",
        "Share of the load that goes back and forth between steps",
        lambda m: m.invariants.chattering,
    ),
    Column(
        "cycle_error",
        "1",
        "Estimated relative error of the wear depth, as it has so many positions",
        lambda m: m.cycle_error,
    ),
    Column("contact_solves", "1", "Contact solves so far", lambda m: m.contact_solves),
    Column("solver_iterations", "1", "Solver iterations so far", lambda m: m.solver_iterations),
)

BODY_COLUMNS: tuple[Column[BodyMeasures], ...] = (
    Column("max_wear_depth", "m", "Largest wear depth", lambda m: m.max_wear_depth),
    Column("centre_wear_depth", "m", "Wear depth at the centre", lambda m: m.centre_wear_depth),
    Column("wear_volume", "m^3", "Volume of the whole scar or track", lambda m: m.wear_volume),
    Column(
        "max_plastic_depth", "m", "Largest permanent displacement", lambda m: m.max_plastic_depth
    ),
)


def _roughness(name: str, unit: str, description: str) -> Column[BodyMeasures]:
    label = labelled(name, unit)
    meaning = f"{description}, within the contact"
    return Column(name, unit, meaning, lambda m: m.roughness.get(label, math.nan))


ROUGHNESS_COLUMNS: tuple[Column[BodyMeasures], ...] = (
    _roughness("Sa", "m", "Arithmetical mean height"),
    _roughness("Sq", "m", "Root mean square height"),
    _roughness("Sz", "m", "Maximum height"),
    _roughness("Ssk", "1", "Skewness of the heights"),
    _roughness("Sku", "1", "Kurtosis of the heights"),
    _roughness("Ra_along", "m", "Arithmetical mean height of profiles along x"),
    _roughness("Rq_along", "m", "Root mean square height of profiles along x"),
    _roughness("Ra_across", "m", "Arithmetical mean height of profiles along y"),
    _roughness("Rq_across", "m", "Root mean square height of profiles along y"),
)
"""The columns that the history has besides, where a body is rough; NaN for one that is not."""

INVARIANTS = (
    "force_error",
    "complementarity_error",
    "penetration_error",
    "volume_error",
    "regrowth",
    "chattering",
)
"""The columns that are 0 where all that must hold holds exactly."""
