"""What this package offers for any result with rough bodies."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np
from tribo import Column, Result, hookimpl

from tribo_topography.roughness import Roughness
from tribo_topography.running_in import (
    BeforeAndAfter,
    reliefs,
    rough_bodies,
    worn_roughness,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

QUANTITIES = (
    ("Sa", "m", "Sa in the scar", "scar"),
    ("Sq", "m", "Sq in the scar", "scar"),
    ("Sz", "m", "Sz in the scar", "scar"),
    ("Ssk", "1", "Ssk in the scar", "scar"),
    ("Sku", "1", "Sku in the scar", "scar"),
    ("Ra_along", "m", "Ra along sliding in the scar", "scar"),
    ("Ra_across", "m", "Ra across sliding in the scar", "scar"),
    ("Sa_unworn", "m", "Sa at first in the place of the scar", "unworn"),
    ("Sa_beside", "m", "Sa beside the scar", "beside"),
)
"""Name, unit and words of the quantities of a body, and the place where each is measured."""


_KNOWN: WeakKeyDictionary[Result, dict[str, BeforeAndAfter[Roughness]]] = WeakKeyDictionary()
"""The roughness of the rough bodies at the end; the fits take 0.1 s on 256² cells."""


def _read(field: str, where: str, result: Result, name: str) -> float:
    if result not in _KNOWN:
        _KNOWN[result] = {
            each: worn_roughness(result, result.body(each), -1) for each in rough_bodies(result)
        }
    measured = _KNOWN[result].get(name)
    return np.nan if measured is None else float(getattr(getattr(measured, where), field))


@hookimpl
def tribo_quantities() -> list[Column]:
    """Offer the roughness of each rough body at the end, form removed."""
    columns = []
    for name, unit, words, where in QUANTITIES:
        field = name.removesuffix(f"_{where}") + ("_m" if unit == "m" else "")
        columns.append(Column(name, unit, words, partial(_read, field, where), of_bodies=True))
    return columns


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the relief of the rough bodies that are worn over more than a few cells."""
    from tribo_topography.relief import height_map, material_ratio_curves

    drawn: dict[str, Callable[[], Figure]] = {}
    for name in rough_bodies(result) if len(result.times) > 1 else ():
        if np.isfinite(reliefs(result, result.body(name), -1).scar).any():
            drawn[f"{name}_height_map"] = partial(height_map, result, name)
            drawn[f"{name}_material_ratio"] = partial(material_ratio_curves, result, name)
    return drawn
