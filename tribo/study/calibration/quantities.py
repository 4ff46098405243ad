"""What a lab measures of a worn body, as a run gives it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.measures import between_cells
from tribo.lab.conversion import mass_from_volume
from tribo.lab.inferred import track_section
from tribo.lab.scar import crown, diameter
from tribo.result.body import BodyResult
from tribo.result.export import profile
from tribo.result.read import Result
from tribo.simulation.model import Model

Reading = Callable[[Result, BodyResult, int], float]
EDGES = 0.15
"""Standard deviation of a computed diameter, in cells."""


@dataclass(frozen=True)
class WornQuantity:
    """One number that is measured of a worn body.

    Parameters
    ----------
    words : str
        What it is called in a table.
    unit : str
        Its SI unit.
    shown : str
        The unit it is shown in.
    per_unit : float
        How many of those make one in SI.
    of : str
        Which bodies have it: those that stay in the contact, those swept
        through it, or both.
    read : callable
        Reads it off a result, for a body at a save.
    read_off : callable
        Standard deviation with which the grid gives it.
    """

    words: str
    unit: str
    shown: str
    per_unit: float
    of: Literal["both", "stationary", "swept"]
    read: Reading
    read_off: Reading = lambda result, body, save: 0.0


def _volume(result: Result, body: BodyResult, save: int) -> float:
    return float(result.table("saves")[f"bodies.{body.name}.wear_volume_m3"][save])


def _mass(result: Result, body: BodyResult, save: int) -> float:
    assert body.density is not None
    return mass_from_volume(_volume(result, body, save), body.density)


def _diameter(axis: int) -> Reading:
    return lambda result, body, save: diameter(
        body.wear_depth[save], axis, result.grid.spacing[axis]
    )


def _crown(result: Result, body: BodyResult, save: int) -> float:
    return crown(profile(body.surface(save), 1), profile(body.wear_depth[save], 1))


def _edges(axis: int) -> Reading:
    return lambda result, body, save: EDGES * result.grid.spacing[axis]


def _feet(result: Result, body: BodyResult, save: int) -> float:
    """The unworn surface falls as steeply as this at the feet of the chord under the crown."""
    depth, spacing = body.wear_depth[save], result.grid.spacing[1]
    unworn = profile(body.surface(save) + depth, 1)
    half = 0.5 * diameter(depth, 1, spacing)
    fall = np.abs(np.interp([-half, half], result.grid.y, np.gradient(unworn, spacing)))
    return 0.5 * EDGES * spacing * float(np.mean(fall))


def _section(result: Result, body: BodyResult, save: int) -> float:
    area = track_section(result, body, save)
    assert area is not None
    return area


QUANTITIES = {
    "mass": WornQuantity("mass lost", "kg", "mg", 1e6, "both", _mass),
    "volume": WornQuantity("volume lost", "m^3", "mm³", 1e9, "both", _volume),
    "scar_along": WornQuantity("scar along", "m", "mm", 1e3, "stationary", _diameter(0), _edges(0)),
    "scar_across": WornQuantity("scar across", "m", "mm", 1e3, "both", _diameter(1), _edges(1)),
    "depth": WornQuantity(
        "largest depth",
        "m",
        "µm",
        1e6,
        "both",
        lambda _, body, i: float(np.max(body.wear_depth[i])) + between_cells(body.wear_depth[i]),
    ),
    "crown": WornQuantity("crown", "m", "µm", 1e6, "stationary", _crown, _feet),
    "section": WornQuantity("section of the track", "m^2", "mm²", 1e6, "swept", _section),
}
"""What is one number, by its name in a file of measured values; diameters for the scar's sizes."""
PROFILES = {"profile_along": 0, "profile_across": 1}
"""Depths along a line through the centre of the contact, with the axis that it follows."""
DEPTH = QUANTITIES["depth"]


def unit_of(name: str) -> str:
    """Return the SI unit of a quantity or of a profile's depths."""
    return QUANTITIES.get(name, DEPTH).unit


def in_words(name: str, value: float) -> str:
    """Return a value of a quantity in the unit it is shown in, as ``"2.05 mg"``."""
    quantity = QUANTITIES.get(name, DEPTH)
    return f"{quantity.per_unit * value:.3g} {quantity.shown}"


def in_si(value: float, unit: str) -> str:
    """Return a value in SI with its unit, if that is not 1, as ``"7.08e-15 1/Pa"``."""
    return f"{value:.3g}" if unit == "1" else f"{value:.3g} {unit}"


def percent(part: float) -> str:
    """Return a part in percent, rounded, for a table or a sentence; without the sign."""
    return f"{100 * part:.0f}" if part >= 0.095 else f"{100 * part:.1f}"


def read_profile(result: Result, body: BodyResult, save: int, name: str, at: Array) -> Array:
    """Return a profile's depths at positions, in m."""
    axis = PROFILES[name]
    known = (result.grid.x, result.grid.y)[axis]
    return np.asarray(np.interp(at, known, profile(body.wear_depth[save], axis)))


def check_available(model: Model, body: str, name: str) -> None:
    """Check that runs of a model give a quantity of a body.

    Raises
    ------
    CaseError
        If they do not; the message says why.
    """
    found = model.bodies[body]
    if found.wear is None:
        raise CaseError(
            f"body {body!r} does not wear in this case; give it a wear law, bodies.{body}.wear"
        )
    if name == "mass" and found.material.density is None:
        raise CaseError(f"a mass needs a density; add bodies.{body}.material.density to the case")
    swept = model.is_swept(body)
    of = "stationary" if name == "profile_along" else QUANTITIES.get(name, DEPTH).of
    if of == "stationary" and swept:
        raise CaseError(
            f"body {body!r} is swept: its scar is a track, the same all along, and has no {name}"
        )
    if of == "swept" and not swept:
        raise CaseError(f"body {body!r} stays in the contact: it has no track, and so no {name}")


def is_available(model: Model, body: str, name: str) -> bool:
    """Return whether runs of a model give a quantity of a body; see `check_available`."""
    try:
        check_available(model, body, name)
    except CaseError:
        return False
    return True
