"""Map how far one result is from another."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.plotting.maps import new_maps
from tribo.plotting.sections import scar_mask
from tribo.plotting.style import DIFFERENCES, house_style
from tribo.plotting.units import fitting, height_unit, size
from tribo.result.read import Result


def difference_map(results: Mapping[str, Result], label: str, time: float) -> Figure:
    """Draw how far a result is from the first: pressure, and wear of bodies that stay.

    `results` are by label; `label` is the one to draw, `time` that of a save of both, in s.

    Raises
    ------
    CaseError
        If the two have different grids, or one has no save then.
    """
    first_label, first = next(iter(results.items()))
    result = results[label]
    grid = first.grid
    if (grid.size, grid.cells) != (result.grid.size, result.grid.cells):
        raise CaseError(
            f"{label} and {first_label} have different grids, so that there is no map of their "
            "difference"
        )
    i, j = result.save_at(time), first.save_at(time)
    pressure, other = result.field("pressure", i), first.field("pressure", j)
    marked = (pressure > 0) | (other > 0)
    fields = {"Pressure": np.asarray(pressure - other)}
    units = {"Pressure": fitting("Pa", _largest(fields["Pressure"]))}
    for name in result.body_names:
        if name in first.body_names and not result.body(name).swept:
            worn = result.field("wear_depth", i, name)
            other = first.field("wear_depth", j, name)
            marked |= scar_mask(worn) | scar_mask(other)
            if np.any(worn != other):
                what = f"Wear depth of {name}"
                fields[what] = np.asarray(worn - other)
                units[what] = height_unit(_largest(fields[what]))
    with house_style():
        figure, maps = new_maps(marked, grid, count=len(fields))
        for shown, (what, field) in zip(maps, fields.items(), strict=True):
            values = field / size(units[what])
            largest = _largest(values) or 1.0
            scale = f"{what} ({units[what]})"
            colours = {"cmap": DIFFERENCES, "interpolation": "nearest"}
            shown.image(values, scale, vmin=-largest, vmax=largest, **colours)
        maps[0].axes.set_title(f"{label} less {first_label}, t = {time:g} s", loc="left")
    return figure


def _largest(field: Array) -> float:
    return float(np.max(np.abs(field)))
