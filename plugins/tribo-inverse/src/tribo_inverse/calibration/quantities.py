"""Quantities measured on a worn body, and their values computed from a result."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import pandas as pd
from scipy.ndimage import binary_dilation, binary_erosion
from tribo import Array, CaseError, Result
from tribo.kernel_api import (
    Model,
    between_cells,
    crown,
    default_registry,
    diameter,
    did_you_mean,
    from_all_plugins,
    profile,
    quantity_rows,
    suggestion,
    track_section,
)

DIAMETER_SIGMA = 0.2
"""Standard deviation of a computed diameter, in cells."""
DEPTH_SIGMA = 2e-3
"""Standard deviation of a computed depth, relative to the largest."""
EDGE_CELL_SIGMA = 0.1
"""Standard deviation of the mean depth of a cell at the scar's edge, relative to the largest
difference between neighbouring cells."""
WORN = 1e-3
"""Part of the largest depth above which a cell counts as worn."""
ROUNDING = 1e-9
"""Relative number that is printed as 0 %."""


class WornQuantity(NamedTuple):
    """A quantity that is measured: on a worn body, or of a run as a package reads it."""

    unit: str
    """SI unit."""
    shown: str
    """Unit in which it is printed."""
    per_unit: float
    """Printed units in one SI unit."""
    of: Literal["both", "stationary", "swept", "run", "body of a run"] = "both"
    """The bodies that have it: stationary, swept, or both. A quantity of a package belongs to a
    run, or to each body of a run, at its end."""
    label: str = ""
    """Its name with the unit, where a package reads it."""


_DEPTH = WornQuantity("m", "µm", 1e6)
QUANTITIES = {
    "mass": WornQuantity("kg", "mg", 1e6),
    "volume": WornQuantity("m^3", "mm³", 1e9),
    "scar_along": WornQuantity("m", "mm", 1e3, "stationary"),
    "scar_across": WornQuantity("m", "mm", 1e3),
    "depth": _DEPTH,
    "crown": _DEPTH._replace(of="stationary"),
    "section": WornQuantity("m^2", "mm²", 1e6, "swept"),
}
"""By the name in a file of measured values; see `quantity` for the quantities of packages."""
AXES = {"scar_along": 0, "scar_across": 1}
"""Axis of a diameter."""


def quantity(name: str) -> WornQuantity:
    """Return a quantity by its name, also one of a package; `CaseError` if none has the name."""
    known = QUANTITIES
    if name not in known:
        known = _read_off(default_registry().ask("tribo_quantities"))
    if name not in known:
        known = of_all()
    if name not in known:
        meant = suggestion(did_you_mean(name, known))
        raise CaseError(f"no quantity is called {name!r}{meant} There are: {', '.join(known)}")
    return known[name]


def of_all() -> dict[str, WornQuantity]:
    """Return the quantities of tribo and of every installed package, by name."""
    return QUANTITIES | _read_off(from_all_plugins("tribo_quantities"))


def _read_off(columns: Sequence[Any]) -> dict[str, WornQuantity]:
    """Return the quantities that packages read off a run, by name."""
    return {
        each.name: WornQuantity(
            each.unit,
            "" if each.unit == "1" else each.unit,
            1.0,
            "body of a run" if each.of_bodies else "run",
            each.label,
        )
        for each in columns
    }


class Reading(NamedTuple):
    """One number to compute from a run.

    `time_s` is NaN for the end of the run; `body` is empty for a quantity of the run.
    """

    body: str
    quantity: str
    time_s: float = math.nan


def plain(found: Any) -> dict[str, Any]:
    """Return the fields of a dataclass as plain data: tables as lists of rows."""
    data = {}
    for name, value in vars(found).items():
        if isinstance(value, pd.DataFrame):
            value = value.to_dict("records")
        data[name] = value.tolist() if isinstance(value, np.ndarray) else value
    return data


def in_words(name: str, value: float, digits: int = 3) -> str:
    """Return a value of a quantity in its printed unit, as ``"2.05 mg"``."""
    found = quantity(name)
    return f"{found.per_unit * value:.{digits}g} {found.shown}".rstrip()


def row_name(row: Any) -> str:
    """Return the name of a row of data or predictions, as ``"heavy: ball, mass at 9 s"``."""
    test = f"{row.test}: " if getattr(row, "test", "") else ""
    time = getattr(row, "time_s", math.nan)
    when = "" if pd.isna(time) else f" at {time:g} s"
    return f"{test}{', '.join(filter(None, (row.body, row.quantity)))}{when}"


def in_si(value: float, unit: str, digits: int = 3) -> str:
    """Return a value in SI with its unit, as ``"7.08e-15 1/Pa"``."""
    return f"{value:.{digits}g}" if unit == "1" else f"{value:.{digits}g} {unit}"


def p_words(p_value: float) -> str:
    """Return a p-value in words, as ``"p = 0.05"``."""
    if p_value > 0.999:
        return "p > 0.999"
    return "p < 1e-6" if p_value < 1e-6 else f"p = {p_value:.2g}"


def percent(part: float) -> str:
    """Return a part in percent, rounded, without the sign."""
    if ROUNDING < part < 0.00095:
        return f"{100 * part:.2g}"
    return f"{100 * part:.0f}" if part >= 0.095 else f"{100 * part:.1f}"


def read(result: Result, asked: Reading) -> tuple[float, float]:
    """Return a computed value, and its standard deviation due to the grid."""
    if label := quantity(asked.quantity).label:
        key = ".".join(filter(None, ("quantities", asked.body, label)))
        return {row.key: row.value for row in quantity_rows(result)}.get(key, math.nan), 0.0
    save = -1 if math.isnan(asked.time_s) else result.save_at(asked.time_s)
    body = result.body(asked.body)
    depth, spacing, name = body.wear_depth[save], result.grid.spacing, asked.quantity
    if name in ("scar_along", "scar_across"):
        axis = AXES[name]
        return diameter(depth, axis, spacing[axis]), DIAMETER_SIGMA * spacing[axis]
    if name == "depth":
        value = float(np.max(depth)) + between_cells(depth)
        return value, DEPTH_SIGMA * value
    if name == "crown":
        return _crown(result, asked.body, save)
    if name == "section":
        return track_section(result, body, save) or 0.0, 0.0
    volume = float(result.table("saves")[f"bodies.{body.name}.wear_volume_m3"][save])
    return volume * (body.density or 0.0) if name == "mass" else volume, 0.0


def edge_sigma(depth: Array, part: float) -> Array:
    """Return the standard deviation of computed depths at a scar's edge; 0 elsewhere.

    It is a part of the largest difference between neighbouring cells.
    """
    worn = depth > WORN * np.max(depth)
    edge = binary_dilation(worn) & ~binary_erosion(worn, border_value=1)
    axes = [axis for axis, n in enumerate(depth.shape) if n > 1]
    steps = [np.max(np.abs(np.diff(depth, axis=axis))) for axis in axes]
    return np.asarray(edge * part * max(steps))


def _crown(result: Result, name: str, save: int) -> tuple[float, float]:
    """Return the crown; its standard deviation is the chord ends' times the slope there."""
    body = result.body(name)
    height, depth = profile(body.surface(save), 1), profile(body.wear_depth[save], 1)
    spacing = result.grid.spacing[1]
    half = 0.5 * diameter(body.wear_depth[save], 1, spacing)
    slopes = np.interp([-half, half], result.grid.y, np.gradient(height + depth, spacing))
    error = 0.375 * DIAMETER_SIGMA * spacing * float(np.mean(np.abs(slopes)))
    return crown(height, depth), error


def unavailable(model: Model, body: str, name: str) -> str:
    """Return why a model does not give a quantity of a body; empty if it does, or may."""
    if (asked := quantity(name)).label:
        return ""
    found, swept, of = model.case.bodies[body], body in model.cycle.swept, asked.of
    if found.wear is None:
        return f"body {body!r} does not wear in this case; give it a wear law, bodies.{body}.wear"
    if name == "mass" and found.material.density is None:
        return f"a mass needs a density; add bodies.{body}.material.density to the case"
    if of == "stationary" and swept:
        return f"body {body!r} is swept: its scar is a track, the same all along, and has no {name}"
    if of == "swept" and not swept:
        return f"body {body!r} stays in the contact: it has no track, and so no {name}"
    return ""
