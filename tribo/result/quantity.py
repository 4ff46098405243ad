"""One quantity of a result, by its name, body, time and place."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import map_coordinates

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.rounding import ROUND_OFF
from tribo.result.read import Result


def quantity(
    result: Result,
    name: str,
    body: str | None = None,
    time: float | None = None,
    places: Sequence[tuple[float, float]] = (),
) -> tuple[Array, str]:
    """Return the values of a variable, one for each place, and their SI unit.

    `name` names a variable of the result; the last save counts if there is no `time` (s), and
    the largest value of a field if there are no `places` (x, y), in m. `CaseError` if there is no
    such variable, body or save.
    """
    known = result._variables.get(name)
    dims = known.dims if known else ()
    if known and ("body" in dims) != (body is not None):
        bodies = " or ".join(result.body_names)
        wanted = f"of a body; give body = {bodies}" if body is None else "of the contact, not"
        raise CaseError(f"{name} is {wanted} {body or ''}".rstrip())
    save = len(result.times) - 1 if time is None else result.save_at(time)
    values = result.field(name, save, body)
    assert known
    if places and "y" not in dims:
        raise CaseError(f"{name} is one number at each time; leave out the places")
    if places:
        values = interpolated(values, result.grid.spacing, *np.transpose(places))
        if np.isnan(values).any():
            raise CaseError("a place lies outside of the window; it is in m")
    return np.atleast_1d(values if places else np.max(values)), known.unit


def interpolated(field: Array, spacing: tuple[float, float], x: Array, y: Array) -> Array:
    """Return a field of cells of this size at places, in m: linear between them; NaN outside."""
    # A cell more at each end extrapolates over the last half cell; a single cell is constant.
    padded = np.pad(field, 1, "reflect", reflect_type="odd")
    axes = list(zip((x, y), spacing, field.shape, strict=True))
    at = np.broadcast_arrays(*(axis / cell + 0.5 * (count + 1) for axis, cell, count in axes))
    edge = 0.5 * (1 + ROUND_OFF)
    within = [np.abs(axis) <= edge * cell * count for axis, cell, count in axes]
    return np.where(within[0] & within[1], map_coordinates(padded, at, order=1), np.nan)
