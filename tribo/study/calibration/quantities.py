"""Quantities that a lab measures on a worn body, read off a result."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import pandas as pd
from scipy.interpolate import Akima1DInterpolator
from scipy.ndimage import binary_dilation, binary_erosion

from tribo.core.arrays import Array
from tribo.core.measures import between_cells
from tribo.lab.conversion import mass_from_volume
from tribo.lab.inferred import track_section
from tribo.lab.scar import crown, diameter
from tribo.result.body import BodyResult
from tribo.result.export import profile
from tribo.result.layout import TRACK
from tribo.result.read import Result
from tribo.simulation.model import Model

EDGES, DEPTHS = 0.2, 2e-3
"""Standard deviations of a computed diameter, in cells, and of a depth, in parts of the largest."""
CUT = 0.1
"""That of the mean over a cell that the scar's edge cuts, in parts of the steepest step between
cells."""
WORN = 1e-3
"""Part of the largest depth from which a cell counts as worn."""
ROUNDING, EXACT = 1e-9, 1e-7
"""Part of a number that is none, and an interval's below which its ends are not told apart."""


class WornQuantity(NamedTuple):
    """A quantity that is measured of a worn body, by its SI unit."""

    unit: str
    shown: str
    per_unit: float
    """The unit it is shown in, and how many of those make one in SI."""
    of: Literal["both", "stationary", "swept"] = "both"
    """Which bodies have it: those that stay in the contact, or are swept through it."""


_DEPTH = WornQuantity("m", "µm", 1e6)
QUANTITIES = {
    "mass": WornQuantity("kg", "mg", 1e6),
    "volume": WornQuantity("m^3", "mm³", 1e9),
    "scar_along": WornQuantity("m", "mm", 1e3, "stationary"),
    "scar_across": WornQuantity("m", "mm", 1e3),
    "depth": _DEPTH,
    "crown": _DEPTH._replace(of="stationary"),
    "section": WornQuantity("m^2", "mm²", 1e6, "swept"),
    "profile_along": _DEPTH._replace(of="stationary"),
    "profile_across": _DEPTH,
    "depth_map": _DEPTH,
}
"""By the name in a file of measured values."""
AXES = {"scar_along": 0, "scar_across": 1, "profile_along": 0, "profile_across": 1}
PROFILES = ("profile_along", "profile_across")
"""The axis that a diameter or a profile follows; those are depths at several positions along it."""
DEPTH_MAP = "depth_map"
FIELDS = (*PROFILES, DEPTH_MAP)
"""Quantities that are depths at many places, which may be 0, rather than one positive number."""


class Reading(NamedTuple):
    """One number to read off a run: a body and a quantity; when, if not at the end, and where.

    Of a depth map it is the largest.
    """

    body: str
    quantity: str
    time_s: float = math.nan
    position_m: float = math.nan


def plain(found: Any) -> dict[str, Any]:
    """Return the fields of a dataclass as plain data: tables as lists of rows."""
    data = {}
    for name, value in vars(found).items():
        if isinstance(value, pd.DataFrame):
            value = value.to_dict("records")
        data[name] = value.tolist() if isinstance(value, np.ndarray) else value
    return data


def in_words(name: str, value: float, digits: int = 3) -> str:
    """Return a value of a quantity in the unit it is shown in, as ``"2.05 mg"``."""
    return f"{QUANTITIES[name].per_unit * value:.{digits}g} {QUANTITIES[name].shown}"


def in_si(value: float, unit: str, digits: int = 3) -> str:
    """Return a value in SI with its unit, if that is not 1, as ``"7.08e-15 1/Pa"``."""
    return f"{value:.{digits}g}" if unit == "1" else f"{value:.{digits}g} {unit}"


def digits_of(lower: float, upper: float) -> int:
    """Return how many digits show half of an interval to two of its own, 3 or more.

    One that is next to nothing has 4.
    """
    if not 0 < upper - lower < math.inf:
        return 3
    if upper - lower < EXACT * upper:
        return 4
    return max(3, 2 + math.floor(math.log10(upper)) - math.floor(math.log10((upper - lower) / 2)))


def percent(part: float) -> str:
    """Return a part in percent, rounded, for a table or a sentence; without the sign."""
    if ROUNDING < part < 0.00095:
        return f"{100 * part:.2g}"
    return f"{100 * part:.0f}" if part >= 0.095 else f"{100 * part:.1f}"


def read_all(result: Result, asked: Sequence[Reading]) -> tuple[Array, Array, dict[int, Array]]:
    """Return computed values, their standard deviations due to the grid, and maps by the index."""
    maps = {
        i: _whole(result, each.body, _save(result, each))
        for i, each in enumerate(asked)
        if each.quantity == DEPTH_MAP
    }
    values, errors = np.array([read(result, each) for each in asked]).T
    return values, errors, maps


def read(result: Result, asked: Reading) -> tuple[float, float]:
    """Return the computed value, and its standard deviation due to the grid."""
    save, body = _save(result, asked), result.body(asked.body)
    depth, spacing, name = body.wear_depth[save], result.grid.spacing, asked.quantity
    if name in ("scar_along", "scar_across"):
        axis = AXES[name]
        return diameter(depth, axis, spacing[axis]), EDGES * spacing[axis]
    if name == DEPTH_MAP:
        value = float(np.max(_whole(result, asked.body, save)))
        return value, DEPTHS * value
    if name == "depth":
        value = float(np.max(depth)) + between_cells(depth)
        return value, DEPTHS * value
    if name == "crown":
        return _crown(result, body, save)
    if name == "section":
        return track_section(result, body, save) or 0.0, 0.0
    if name in PROFILES:
        return _on_line(depth, AXES[name], asked.position_m, result)
    volume = float(result.table("saves")[f"bodies.{body.name}.wear_volume_m3"][save])
    return mass_from_volume(volume, body.density or 0.0) if name == "mass" else volume, 0.0


def kinked(depth: Array, part: float) -> Array:
    """Return the error of depths beside a scar's edge, where they have a kink; 0 elsewhere.

    It is a part of the steepest step between cells.
    """
    worn = depth > WORN * np.max(depth)
    edge = binary_dilation(worn) & ~binary_erosion(worn, border_value=1)
    axes = [axis for axis, n in enumerate(depth.shape) if n > 1]
    steps = [np.max(np.abs(np.diff(depth, axis=axis))) for axis in axes]
    return np.asarray(edge * part * max(steps))


def _on_line(depth: Array, axis: int, position: float, result: Result) -> tuple[float, float]:
    """Depth at a place on a middle line, by cubics, as scars are curved; and its error.

    That is larger beside the scar's edge, where the line has a kink.
    """
    centres = result.grid.x, result.grid.y
    known = centres[axis]
    line = profile(depth, axis)
    if depth.shape[1 - axis] > 1:
        line = Akima1DInterpolator(centres[1 - axis], depth, axis=1 - axis)(0.0)
    value = float(Akima1DInterpolator(known, line)(np.clip(position, known[0], known[-1])))
    at_edge = float(np.interp(position, known, kinked(line, EDGES)))
    return value, math.hypot(DEPTHS * float(np.max(depth)), at_edge)


def _save(result: Result, asked: Reading) -> int:
    return -1 if math.isnan(asked.time_s) else result.save_at(asked.time_s)


def _whole(result: Result, body: str, save: int) -> Array:
    """Return the depth on a body's own surface, shape (rows, ny).

    The surface is longer than the window under a resolved stroke. Of a track that is the same all
    along the result repeats the one row that it has.
    """
    depth = result.field("wear_depth", save, body)
    if TRACK in dir(result):
        track = result.field(TRACK, save, body)
        if np.any(known := np.isfinite(track[:, 0])):
            depth = track[known]
    return np.asarray(depth)


def _crown(result: Result, body: BodyResult, save: int) -> tuple[float, float]:
    """Crown; its error is that of the chord's ends times the slope of the surface there."""
    height, depth = profile(body.surface(save), 1), profile(body.wear_depth[save], 1)
    spacing = result.grid.spacing[1]
    half = 0.5 * diameter(body.wear_depth[save], 1, spacing)
    slopes = np.interp([-half, half], result.grid.y, np.gradient(height + depth, spacing))
    return crown(height, depth), 0.375 * EDGES * spacing * float(np.mean(np.abs(slopes)))


def unavailable(model: Model, body: str, name: str) -> str:
    """Return why runs of a model do not give a quantity of a body; nothing if they do."""
    found, swept, of = model.bodies[body], body in model.swept, QUANTITIES[name].of
    if found.wear is None:
        return f"body {body!r} does not wear in this case; give it a wear law, bodies.{body}.wear"
    if name == "mass" and found.material.density is None:
        return f"a mass needs a density; add bodies.{body}.material.density to the case"
    if of == "stationary" and swept:
        return f"body {body!r} is swept: its scar is a track, the same all along, and has no {name}"
    if of == "swept" and not swept:
        return f"body {body!r} stays in the contact: it has no track, and so no {name}"
    return ""
