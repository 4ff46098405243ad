"""The worn bodies drawn together, in section."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array
from tribo.plotting.pressure import AXIS_LABELS
from tribo.plotting.profiles import enlargement, visible
from tribo.plotting.style import WIDE, Stroke, house_style, legend_below, new_figure
from tribo.plotting.units import Unit, height_unit, length_unit, time_labels
from tribo.plotting.window import Limits, limits, number_of_saves, removed, scar_mask, spread
from tribo.results.body import BodyResult
from tribo.results.export import profile
from tribo.results.read import Result

WORN = Stroke("black", width=1.0)
UNWORN = Stroke("#404040", dashes=(0.0, (3.0, 1.6)), width=0.8)
UPPER, LOWER = "#e4e4e4", "#b4b4b4"
_SHAPE = 0.62


def worn_section(result: Result) -> Figure:
    """Draw both bodies in section at the last save, along and across sliding.

    They are set down on each other without load, so that they touch at their
    closest point and the scars are seen to conform. A swept body lies below.
    The unworn surfaces are dashed; where the upper one would run inside the
    lower body it is left out, and the depths of the scars are stated instead.

    Parameters
    ----------
    result : Result
        What to draw.

    Returns
    -------
    Figure
        The picture, which states how much it enlarges heights.

    Raises
    ------
    CaseError
        If there is no save.
    """
    last = number_of_saves(result) - 1
    upper, lower = _stacked(result)
    grid = result.grid
    marked = np.zeros(grid.cells, dtype=bool)
    for body in (upper, lower):
        if not body.swept:
            marked |= scar_mask(removed(result, body.name)[last])
    if not marked.any():
        marked = result.pressure(last) > 0
    # Both panels have one scale, so that their shapes compare.
    ends = [limits(marked, grid, axis) for axis in (0, 1)]
    window = (min(low for low, _ in ends), max(high for _, high in ends))
    sections = [_section(upper, lower, last, axis) for axis in (0, 1)]
    xs = (grid.x, grid.y)
    height = spread(
        [
            visible(line, x, window)
            for section, x in zip(sections, xs, strict=True)
            for line in (section.upper, section.lower, section.first_lower)
        ]
    )
    # Room for the names inside the bodies.
    room = height[1] - height[0]
    height = (height[0] - 0.2 * room, height[1] + 0.12 * room)
    length, unit = length_unit(window[1] - window[0]), height_unit(height[1] - height[0])
    with house_style():
        figure = new_figure(56.0, WIDE)
        panels = figure.subplots(1, 2, sharey=True)
        for axis, axes in enumerate(panels):
            curves = _draw(axes, length.of(xs[axis]), sections[axis], height, unit)
            axes.set_xlim(*(length.factor * end for end in window))
            axes.set_box_aspect(_SHAPE)
            axes.xaxis.set_major_locator(MaxNLocator(6))
            axes.set_xlabel(f"{AXIS_LABELS[axis]} ({length.name})")
        for body, height_of_text, side in ((upper, 0.97, "top"), (lower, 0.04, "bottom")):
            depth = float(np.max(removed(result, body.name)[last]))
            for axes, label in zip(panels, (body.name, _scar(body.name, depth)), strict=True):
                axes.text(
                    0.5, height_of_text, label, transform=axes.transAxes, ha="center", va=side
                )
        panels[0].set_ylabel(f"Height ({unit.name})")
        panels[0].set_title(f"t = {time_labels(result)[last]}, unloaded", loc="left")
        panels[1].set_title(enlargement(window, height, _SHAPE), loc="right", fontsize=7.0)
        legend_below(figure, curves)
    return figure


def _scar(name: str, depth: float) -> str:
    """Return a body's name and how deep its scar is."""
    if depth <= 0:
        return name
    unit = height_unit(depth)
    return f"{name}: {unit.factor * depth:.3g} {unit.name} deep"


@dataclass(frozen=True)
class _Section:
    """Profiles of both bodies in one frame, worn and unworn, in m."""

    upper: Array
    lower: Array
    first_upper: Array
    first_lower: Array


def _section(upper: BodyResult, lower: BodyResult, save: int, axis: int) -> _Section:
    top, bottom = upper.surface(save), lower.surface(save)
    lift = float(np.max(top + bottom))
    return _Section(
        upper=lift - profile(top, axis),
        lower=profile(bottom, axis),
        first_upper=lift - profile(upper.height, axis),
        first_lower=profile(lower.height, axis),
    )


def _stacked(result: Result) -> tuple[BodyResult, BodyResult]:
    """Return the upper and the lower body: a swept one lies below, else the second."""
    first, second = (result.body(name) for name in result.body_names)
    return (second, first) if first.swept and not second.swept else (first, second)


def _draw(axes: Axes, x: Array, section: _Section, height: Limits, unit: Unit) -> list[Line2D]:
    low, high = (unit.factor * end for end in height)
    top, bottom = unit.of(section.upper), unit.of(section.lower)
    axes.fill_between(x, top, high, color=UPPER, linewidth=0.0)
    axes.fill_between(x, bottom, low, color=LOWER, linewidth=0.0)
    # Inside the lower body it would seem to be a part of that.
    first_upper = np.where(section.first_upper >= section.lower, section.first_upper, np.nan)
    for line in (first_upper, section.first_lower):
        unworn = UNWORN.draw(axes, x, unit.of(line), "unworn")
    for line in (top, bottom):
        worn = WORN.draw(axes, x, line, "worn")
    axes.set_ylim(low, high)
    return [worn, unworn]
