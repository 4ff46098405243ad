"""Sections through the window's centre: their limits, their curves and their panels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.plotting import style
from tribo.plotting.units import axis_units, height_unit, size
from tribo.result.export import profile
from tribo.result.read import Result

MARGIN = 0.2
"""Shown beyond the contact or the scar on each side, in parts of its half-width."""

Limits = tuple[float, float]
Curve = tuple[Array, Array]
"""Positions and values, in SI units."""


@dataclass(frozen=True)
class Section:
    """Curves along an axis, 0 or 1, and the part of the axis that is shown, in m."""

    axis: int
    window: Limits
    curves: Sequence[Curve]
    unit: str
    """In which positions are shown."""

    def draw(
        self, axes: Axes, unit: str, looks: Sequence[style.Look], labels: Sequence[str], up: Limits
    ) -> list[Line2D]:
        """Draw the curves with values in `unit` between the limits `up`, which are in SI units."""
        axes.set_xlim(*(end / size(self.unit) for end in self.window))
        axes.set_xlabel(f"{style.AXIS_LABELS[self.axis]} ({self.unit})")
        axes.xaxis.set_major_locator(style.ticks(5))
        axes.set_ylim(*(end / size(unit) for end in up))
        axes.yaxis.set_major_locator(style.ticks(7))
        lines: list[Line2D] = []
        for (position, values), look, label in zip(self.curves, looks, labels, strict=True):
            # Matplotlib leaves labels that begin with an underscore out of the legend.
            shown = position / size(self.unit), values / size(unit)
            lines += axes.plot(*shown, label=label.lstrip("_"), **look)
        return lines

    def in_sight(self) -> list[Array]:
        """Return the part of each curve that lies inside the limits."""
        low, high = self.window
        return [values[(low <= x) & (x <= high)] for x, values in self.curves]


def through_centre(
    fields: Sequence[tuple[Grid, Array, Mask]],
    axes: Sequence[int] = (0, 1),
    reach: Sequence[float] = (0.0, 0.0),
) -> list[Section]:
    """Return sections of fields, each on its grid, and limits around what is marked of each.

    They run along `axes`: 0 is the sliding direction, and 1 across it. `reach` along both is a
    distance from the centre to be shown as well, in m.
    """
    windows = []
    for axis in axes:
        lows, highs = [], []
        for grid, _, marked in fields:
            x = (grid.x, grid.y)[axis]
            low, high = limits(marked, grid, axis, reach[axis])
            # The outermost cells' centres end a section.
            lows.append(max(low, float(x[0])))
            highs.append(min(high, float(x[-1])))
        windows.append((min(lows), max(highs)))
    units = axis_units([max(map(abs, window)) for window in windows])
    return [
        Section(axis, window, [((g.x, g.y)[axis], profile(f, axis)) for g, f, _ in fields], unit)
        for axis, window, unit in zip(axes, windows, units, strict=True)
    ]


def limits(marked: Mask, grid: Grid, axis: int, reach: float = 0.0) -> Limits:
    """Return limits in m that show all marked cells, a margin, and no more.

    They are those of the window if nothing is marked. `marked` has shape
    (nx, ny) or (1, ny); `reach` is as in `through_centre`.
    """
    edge = 0.5 * grid.size[axis]
    index = np.flatnonzero(np.broadcast_to(marked, grid.cells).any(axis=1 - axis))
    if index.size == 0:
        return -edge, edge
    step = grid.spacing[axis]
    low = min(float(index[0]) * step - edge, -reach)
    high = max(float(index[-1] + 1) * step - edge, reach)
    margin = MARGIN * max(0.5 * (high - low), 2.0 * step)
    return max(low - margin, -edge), min(high + margin, edge)


def removed(result: Result, name: str) -> Array:
    """Return how far a body's surface lies below its first at each save, in m."""
    body = result.body(name)
    return np.asarray(body.wear_depth + body.plastic_depth)


def layer_ends(result: Result, name: str, deepest: float) -> dict[str, float]:
    """Return the depths at which layers of a body end, in m, down to twice the deepest."""
    layers = result.case_tables["bodies"][name].get("layers") or ()
    ends = np.cumsum([float(layer["thickness"]) for layer in layers])
    return {
        f"{name}: end of layer {number}": float(end)
        for number, end in enumerate(ends, start=1)
        if end <= 2 * deepest
    }


def scar_mask(depth: Array) -> Mask:
    """Return where more than a thousandth of the largest depth is gone."""
    deepest = float(np.max(depth, initial=0.0))
    return np.asarray(depth > 1e-3 * deepest)


def draw_profiles(
    sections: Sequence[Section],
    looks: Sequence[style.Look],
    labels: Sequence[str],
    title: str,
    shape: float = 0.62,
    room: Limits = (0.05, 0.05),
    what: str = "Height",
) -> Figure:
    """Draw surfaces in one panel for each section, all with one scale of heights.

    A curve without a label is left out of the legend. `shape` is the height of
    the axes over their width, on paper; `room` is left free below and above
    the curves, in parts of their range; `what` names the heights.
    """
    parts = [line for section in sections for line in section.in_sight()]
    low, high = min(map(np.min, parts)), max(map(np.max, parts))
    span = float(high - low) or 2e-8
    up = float(low) - room[0] * span, float(high) + room[1] * span
    unit = height_unit(max(map(abs, up)))
    two = len(sections) > 1
    with style.house_style():
        figure = style.new_figure(
            20.0 + shape * (52.0 if two else 68.0), style.WIDE if two else style.SINGLE_COLUMN
        )
        panels = figure.subplots(1, len(sections), sharey=True, squeeze=False)[0]
        for axes, section in zip(panels, sections, strict=True):
            lines = section.draw(axes, unit, looks, labels, up)
            axes.set_box_aspect(shape)
            enlarged = shape * (section.window[1] - section.window[0]) / (up[1] - up[0])
            axes.set_title(f"height × {style.times(enlarged)}", loc="right", fontsize=7.0)
        panels[0].set_ylabel(f"{what} ({unit})")
        panels[0].set_title(title, loc="left")
        named = [line for line, label in zip(lines, labels, strict=True) if label]
        style.legend_below(figure, named)
    return figure
