"""The worn bodies drawn together, in section."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribo.core.arrays import Array
from tribo.plotting.sections import Section, note_enlargement
from tribo.plotting.style import WIDE, Stroke, house_style, legend_below, new_figure, ticks
from tribo.plotting.units import Unit, height_unit, time_labels
from tribo.plotting.window import (
    Limits,
    number_of_saves,
    positions,
    removed,
    scar_mask,
    section_limits,
    spread,
)
from tribo.result.body import BodyResult
from tribo.result.export import profile
from tribo.result.read import Result

WORN = Stroke("black", width=1.0)
UNWORN = (
    Stroke("#202020", dashes=(0.0, (1.2, 1.2)), width=1.0),
    Stroke("#404040", dashes=(0.0, (5.0, 1.6)), width=0.8),
)
"""Of the upper and of the lower body."""
_SHAPE = 0.8
"""Height of the axes over their width, on paper."""
UPPER, LOWER = "#e4e4e4", "#b4b4b4"


def worn_section(result: Result) -> Figure:
    """Draw both bodies in section at the last save, along and across sliding.

    They are set down on each other without load, so that they touch at their
    closest point and the scars are seen to conform. A swept body lies below.
    The unworn surface of each worn body is drawn where its points were: that
    of the upper one, dotted, runs inside the lower body.

    Parameters
    ----------
    result : Result
        What to draw.

    Returns
    -------
    Figure
        The picture, which states how much it enlarges heights and how deep
        the scars are.

    Raises
    ------
    CaseError
        If there is no save.
    """
    last = number_of_saves(result) - 1
    bodies = _stacked(result)
    depths = [float(np.max(removed(result, body.name)[last])) for body in bodies]
    grid = result.grid
    marked = np.zeros(grid.cells, dtype=bool)
    for body in bodies:
        if not body.swept:
            marked |= scar_mask(removed(result, body.name)[last])
    if not marked.any():
        marked = result.pressure(last) > 0
    sections = []
    for axis in (0, 1):
        x = positions(grid, axis)
        window = section_limits(marked, grid, axis)
        lines = _lines(bodies, last, axis)
        sections.append(Section(axis, window, [(x, line) for line in lines]))
    height = spread([line for section in sections for line in section.visible()])
    # Room for the names inside the bodies.
    room = height[1] - height[0]
    height = (height[0] - 0.2 * room, height[1] + 0.12 * room)
    unit = height_unit(height[1] - height[0])
    with house_style():
        figure = new_figure(66.0, WIDE)
        panels = figure.subplots(1, 2, sharey=True)
        for axes, section in zip(panels, sections, strict=True):
            curves = _draw(axes, section, height, unit, bodies, depths)
            note_enlargement(axes, section.window, height, _SHAPE)
        for body, depth, at, side in zip(
            bodies, depths, (0.97, 0.04), ("top", "bottom"), strict=True
        ):
            for axes, label in zip(panels, (body.name, _scar(body.name, depth)), strict=True):
                axes.text(0.5, at, label, transform=axes.transAxes, ha="center", va=side)
        panels[0].set_ylabel(f"Height ({unit.name})")
        panels[0].yaxis.set_major_locator(ticks(7))
        panels[0].set_title(f"t = {time_labels(result)[last]}, unloaded", loc="left")
        legend_below(figure, curves)
    return figure


def _scar(name: str, depth: float) -> str:
    """Return a body's name and how deep its scar is."""
    if depth <= 0:
        return name
    unit = height_unit(depth)
    return f"{name}: {unit.factor * depth:.3g} {unit.name} deep"


def _lines(bodies: tuple[BodyResult, BodyResult], save: int, axis: int) -> list[Array]:
    """Return the worn profiles of the upper and lower body in one frame, then the unworn ones."""
    upper, lower = bodies
    top, bottom = upper.surface(save), lower.surface(save)
    lift = float(np.max(top + bottom))
    return [
        lift - profile(top, axis),
        profile(bottom, axis),
        lift - profile(upper.height, axis),
        profile(lower.height, axis),
    ]


def _stacked(result: Result) -> tuple[BodyResult, BodyResult]:
    """Return the upper and the lower body: a swept one lies below, else the second."""
    first, second = (result.body(name) for name in result.body_names)
    return (second, first) if first.swept and not second.swept else (first, second)


def _draw(
    axes: Axes,
    section: Section,
    height: Limits,
    unit: Unit,
    bodies: tuple[BodyResult, BodyResult],
    depths: list[float],
) -> list[Line2D]:
    section.label(axes)
    low, high = (unit.factor * end for end in height)
    x = section.unit.of(section.curves[0][0])
    top, bottom, *unworn = (unit.of(line) for _, line in section.curves)
    axes.fill_between(x, top, high, color=UPPER, linewidth=0.0)
    axes.fill_between(x, bottom, low, color=LOWER, linewidth=0.0)
    before = [
        stroke.draw(axes, x, line, f"{body.name} unworn")
        for stroke, line, body, depth in zip(UNWORN, unworn, bodies, depths, strict=True)
        if depth > 0
    ]
    for line in (top, bottom):
        worn = WORN.draw(axes, x, line, "worn")
    axes.set_ylim(low, high)
    return [worn, *before]
