"""Running-in: the roughness of worn bodies, in the scar and beside it."""

from __future__ import annotations

from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.lab.roughness import Roughness, parameters, without_form
from tribo.lab.scar import diameter
from tribo.result.body import BodyResult
from tribo.result.export import profile
from tribo.result.layout import TRACK
from tribo.result.read import Result

T = TypeVar("T")
FORM = 4
"""Order of the form removed.

The second leaves 40 nm rms of a smooth groove 2 µm deep, and of a ball beside its scar; the
fourth, 4 nm and 0.2 nm.
"""
SIDES = 32
WORN = 0.1
"""Part of the largest depth from which a cell is in the scar: its edge is form."""


class BeforeAndAfter(NamedTuple, Generic[T]):
    """A measurement of a worn body in three places.

    `scar` is taken in the scar, or in the contact where nothing is worn; `unworn` at the same place
    on the first surface; `beside` on the surface outside of all wear.
    """

    scar: T
    unworn: T
    beside: T


def worn_roughness(result: Result, body: BodyResult, save: int) -> BeforeAndAfter[Roughness]:
    """Return the roughness of a body at a save; NaN where there are too few cells."""
    return BeforeAndAfter(*map(parameters, reliefs(result, body, save)))


def reliefs(result: Result, body: BodyResult, save: int) -> BeforeAndAfter[Array]:
    """Return the heights of a body at a save, form removed and NaN elsewhere, in m."""
    scar, surface = scar_cells(result, body, save), body.surface(save)
    gone = body.wear_depth[save] + body.plastic_depth[save]
    beside = ~outlined(scar | (gone > 0))
    places = (scar, surface), (scar, body.height), (beside, surface)
    return BeforeAndAfter(*(without_form(np.where(cells, z, np.nan), FORM) for cells, z in places))


def contact_roughness(surface: Array, pressure: Array) -> Roughness:
    """Return the roughness of a surface (m) within the outline of {p > 0}, form removed."""
    return parameters(without_form(np.where(outlined(pressure > 0), surface, np.nan), FORM))


def scar_cells(result: Result, body: BodyResult, save: int) -> Mask:
    """Return the scar of a body at a save, shape (nx, ny), its unworn valleys included.

    It is the outline of the cells worn to a tenth of the largest depth, or of the cells in contact
    where nothing is worn.
    """
    depth = body.wear_depth[save]
    deepest = float(np.max(depth))
    if deepest > 0:
        return outlined(depth >= WORN * deepest)
    return outlined(result.field("pressure", save) > 0)


def outlined(cells: Mask) -> Mask:
    """Return the cells inside the convex outline of some, as seen from `SIDES` sides."""
    inside = np.full(cells.shape, bool(cells.any()))
    x, y = np.ogrid[: cells.shape[0], : cells.shape[1]]
    if not inside.any():
        return inside
    for angle in np.arange(0.5 * SIDES) * (2 * np.pi / SIDES):
        distance = x * np.cos(angle) + y * np.sin(angle)
        ends = distance[cells]
        inside &= (distance > np.min(ends) - 0.01) & (distance < np.max(ends) + 0.01)
    return inside


def rough_bodies(result: Result) -> list[str]:
    """Return the names of the bodies that are rough at first."""
    history = result.table("history")
    return [name for name in result.body_names if f"bodies.{name}.Sq_m" in history]


def groove_length(result: Result, name: str) -> float | None:
    """Return the length of a body's groove on its track at the end, in m; None if all along it."""
    if TRACK in dir(result):
        depth = np.nan_to_num(result.field(TRACK, len(result.times) - 1, name))
    elif result.case_tables.get("kinematics", {}).get("positions", "average") != "average":
        # In a window that repeats.
        depth = result.body(name).wear_depth[-1]
    else:
        return None
    return None if depth.all() else diameter(depth, 0, result.grid.spacing[0])


def worn_surfaces(result: Result, name: str) -> list[dict[str, Any]]:
    """Return the data of ``tribo show --json`` on a body's surface at each save.

    ``roughness`` has the parameters in the scar, and under ``unworn`` and ``beside`` parameters to
    compare with. For the moving body of a resolved cycle ``track_x_m`` and ``track_depth_m`` are
    the depth at y = 0 along its whole track.
    """
    rows: list[dict[str, Any]] = []
    body = result.body(name)
    for save in range(len(result.times)):
        scar, unworn, beside = worn_roughness(result, body, save)
        more = {"unworn": unworn._asdict(), "beside": beside._asdict()}
        rows.append({"roughness": scar._asdict() | more, **_track(result, name, save)})
    return rows


def _track(result: Result, name: str, save: int) -> dict[str, list[float]]:
    if TRACK not in dir(result):
        return {}
    depth = profile(result.field(TRACK, save, name), 0)
    known = np.isfinite(depth)
    if not known.any():
        return {}
    x = (np.arange(depth.size) - 0.5 * (depth.size - 1)) * result.grid.spacing[0]
    return {"track_x_m": x[known].tolist(), "track_depth_m": depth[known].tolist()}
