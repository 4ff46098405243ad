"""Map how far one result is from another."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.plotting.pressure import AXIS_LABELS
from tribo.plotting.style import WIDE, difference_colours, house_style, new_figure
from tribo.plotting.units import Unit, height_unit, length_unit, pressure_unit
from tribo.plotting.window import limits, scar_mask
from tribo.results.read import Result

_LEVELS = (-0.5, -0.25, 0.25, 0.5)
"""Lines on a map of differences, in parts of the largest one."""

Results = Mapping[str, Result]


def difference_map(results: Mapping[str, Result], label: str, time: float) -> Figure:
    """Draw how far a result is from the first: pressure, and wear of bodies that stay.

    Lines are at a quarter and at half of the largest difference, dashed where
    the result lies below the first.

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
    windows = [limits(touched, grid, axis) for axis in (0, 1)]
    length = length_unit(max(abs(end) for window in windows for end in window))
    with house_style():
        figure = new_figure(66.0, WIDE * (0.55 + 0.45 * (len(fields) > 1)))
        panels = figure.subplots(1, len(fields), squeeze=False)[0]
        for axes, (what, fitting, field) in zip(panels, fields, strict=True):
            largest = float(np.max(np.abs(field)))
            _draw_difference(figure, axes, grid, field, length, fitting(largest), what)
            axes.set_xlim(*(length.factor * end for end in windows[0]))
            axes.set_ylim(*(length.factor * end for end in windows[1]))
            axes.set_xlabel(f"{AXIS_LABELS[0]} ({length.name})")
            axes.xaxis.set_major_locator(MaxNLocator(4))
        panels[0].set_ylabel(f"{AXIS_LABELS[1]} ({length.name})")
        figure.suptitle(f"{label} less {first_label}, t = {time:g} s", fontsize=8.0)
    return figure


def _draw_difference(
    figure: Figure, axes: Axes, grid: Grid, field: Array, length: Unit, unit: Unit, what: str
) -> None:
    largest = unit.factor * float(np.max(np.abs(field))) or 1.0
    half_x, half_y = (0.5 * length.factor * size for size in grid.size)
    axes.spines[:].set_visible(True)
    image = axes.imshow(
        unit.of(field).T,
        cmap=difference_colours(),
        vmin=-largest,
        vmax=largest,
        origin="lower",
        extent=(-half_x, half_x, -half_y, half_y),
        interpolation="nearest",
    )
    axes.contour(
        length.of(grid.x),
        length.of(grid.y),
        unit.of(field).T,
        levels=[largest * level for level in _LEVELS],
        colors="black",
        linewidths=0.5,
        linestyles=["dashed", "dashed", "solid", "solid"],
    )
    figure.colorbar(image, ax=axes, label=f"{what} ({unit.name})", ticks=MaxNLocator(7))
