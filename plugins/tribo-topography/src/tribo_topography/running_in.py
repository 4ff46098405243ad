"""Running-in: the roughness of worn bodies, in the scar and beside it."""

from __future__ import annotations

from contextlib import suppress
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from tribo import Array, BodyResult, CaseError, Mask, Result
from tribo.kernel_api import without_form

from tribo_topography.roughness import Roughness, is_rough, parameters

T = TypeVar("T")
FORM = 4
"""Order of the form removed.

The second leaves 40 nm rms of a smooth groove 2 µm deep, and of a ball beside its scar; the
fourth, 4 nm and 0.2 nm.
"""
SIDES = 32
"""Of the polygon: its outline of a circle is 0.3 % too large."""
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
    """Return the roughness of a body at a save; NaN where there are too few cells.

    Examples
    --------
    >>> from tribo_topography import worn_roughness
    >>> short = ["stop.depth=0.2 um"]
    >>> result = tribo.load_case("tribo/templates/rough_ball.toml", overrides=short).run()
    >>> found = worn_roughness(result, result.body("ball"), -1)
    >>> found.scar.Sa_m < found.unworn.Sa_m
    True
    """
    return BeforeAndAfter(*map(parameters, reliefs(result, body, save)))


def reliefs(result: Result, body: BodyResult, save: int) -> BeforeAndAfter[Array]:
    """Return the heights of a body at a save, form removed and NaN elsewhere, in m."""
    scar, surface = scar_cells(result, body, save), body.surface(save)
    gone = body.wear_depth[save] + body.plastic_depth[save]
    beside = ~outlined(scar | (gone > 0))
    places = (scar, surface), (scar, body.height), (beside, surface)
    return BeforeAndAfter(*(without_form(np.where(cells, z, np.nan), FORM) for cells, z in places))


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
    """Return the names of the bodies whose surfaces are more than a smooth form."""
    # A class that is not installed leaves its result without roughness.
    with suppress(CaseError):
        surfaces = {name: body.surface for name, body in result.case.bodies.items()}
        # A form states its curvature.
        unsure = [n for n, form in surfaces.items() if not form.smooth and form.curvature is None]
        return [name for name in unsure if is_rough(result.body(name).height)]
    return []
