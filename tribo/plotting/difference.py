"""Map how far one result is from another."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.plotting.maps import Frame, draw_image, draw_lines, frame, new_maps
from tribo.plotting.style import difference_colours, house_style
from tribo.plotting.units import Unit, height_unit, pressure_unit
from tribo.plotting.window import scar_mask
from tribo.result.read import Result

_LEVELS = (-0.5, -0.25, 0.25, 0.5)
"""Lines on a map of differences, in parts of the largest one."""


def difference_map(results: Mapping[str, Result], label: str, time: float) -> Figure:
    """Draw how far a result is from the first: pressure, and wear of bodies that stay.

    Lines are at a quarter and at half of the largest difference, where they
    are whole, and dashed where the result lies below the first.

    Parameters
    ----------
    results : Mapping
        The results by label.
    label : str
        The one to draw.
    time : float
        Of a save of both, in s.

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
    fields: list[tuple[str, Callable[[float], Unit], Array]] = [
        ("Pressure", pressure_unit, result.pressure(i) - first.pressure(j))
    ]
    touched = (result.pressure(i) > 0) | (first.pressure(j) > 0)
    for name in result.body_names:
        if name in first.body_names and not result.body(name).swept:
            worn, other = result.wear_depth(name, i), first.wear_depth(name, j)
            touched |= scar_mask(worn) | scar_mask(other)
            if np.any(worn != other):
                fields.append((f"Wear depth of {name}", height_unit, np.asarray(worn - other)))
    shown = frame(touched, grid)
    with house_style():
        figure, panels = new_maps(shown, len(fields))
        for axes, (what, fitting, field) in zip(panels, fields, strict=True):
            unit = fitting(float(np.max(np.abs(field))))
            _draw_difference(axes, grid, shown, unit.of(field), f"{what} ({unit.name})")
        panels[0].set_title(f"{label} less {first_label}, t = {time:g} s", loc="left")
    return figure


def _draw_difference(axes: Axes, grid: Grid, shown: Frame, field: Array, label: str) -> None:
    largest = float(np.max(np.abs(field))) or 1.0
    draw_image(
        axes,
        grid,
        shown,
        field,
        label,
        cmap=difference_colours(),
        vmin=-largest,
        vmax=largest,
        interpolation="nearest",
    )
    looks = [{"linestyles": "dashed" if level < 0 else "solid"} for level in _LEVELS]
    levels = [largest * level for level in _LEVELS]
    draw_lines(axes, grid, shown, field, levels, [{"colors": "black"} | look for look in looks])
