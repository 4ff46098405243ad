"""Views of fields: the axes along which they vary, limits, and sections."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.lab.units import axis_units, height_unit, size
from tribo.plotting import style
from tribo.plotting.picture import Panel, Picture
from tribo.result.export import profile
from tribo.result.read import Result

MARGIN = 0.2
"""Shown beyond the contact or the scar on each side, in parts of its half-width."""
SHADE = 0.05
"""Part of its size by which a field that does not vary may differ: a shade of twenty."""
MOST_CELLS = 99.0
"""Cells that colours tell apart and by which a field is measured, in percent."""

Limits = tuple[float, float]
Curve = tuple[Array, Array]
"""Positions and values, in SI units."""


@dataclass(frozen=True)
class Section:
    """Curves along an axis, 0 or 1, and the part of the axis that is shown, in m."""

    axis: int
    window: Limits
    core: Limits
    """The part that is marked, without its margin."""
    curves: Sequence[Curve]
    unit: str
    """In which positions are shown."""

    def draw(
        self,
        axes: Axes,
        factor: float,
        looks: Sequence[style.Look],
        labels: Sequence[str],
        up: Limits,
    ) -> list[Line2D]:
        """Draw the curves between the limits `up`, in SI units as they are, over a unit's size."""
        axes.set_xlim(*(end / size(self.unit) for end in self.window))
        axes.set_xlabel(f"{style.AXIS_LABELS[self.axis]} ({self.unit})")
        axes.xaxis.set_major_locator(style.ticks(5))
        axes.set_ylim(*(end / factor for end in up))
        axes.yaxis.set_major_locator(style.ticks(7))
        lines: list[Line2D] = []
        for (position, values), look, label in zip(self.curves, looks, labels, strict=True):
            # Matplotlib leaves labels that begin with an underscore out of the legend.
            shown = position / size(self.unit), values / factor
            lines += axes.plot(*shown, label=label.lstrip("_"), **look)
        return lines

    def in_sight(self) -> list[Array]:
        """Return the part of each curve that is marked."""
        low, high = self.core
        return [values[(low <= x) & (x <= high)] for x, values in self.curves]


def varying(fields: Sequence[Array], marked: Mask) -> tuple[int, ...]:
    """Return the axes, 0 and 1, along which one of the fields varies around what is marked."""
    return tuple(axis for axis in (0, 1) if any(_varies(f, marked, axis) for f in fields))


def _varies(field: Array, marked: Mask, axis: int) -> bool:
    box = tuple(slice(*_cells(marked, along)) for along in (0, 1))
    part = np.broadcast_to(field, marked.shape)[box]
    spread = np.abs(part - np.mean(part, axis=axis, keepdims=True))
    largest, most = (float(np.percentile(np.abs(each), MOST_CELLS)) for each in (part, spread))
    return most > SHADE * largest


def _cells(marked: Mask, axis: int) -> tuple[int, int]:
    """Return the cells along an axis that show all that is marked, and those beside."""
    index = np.flatnonzero(marked.any(axis=1 - axis))
    if index.size == 0:
        return 0, marked.shape[axis]
    return max(int(index[0]) - 1, 0), int(index[-1]) + 2


def through_centre(
    fields: Sequence[tuple[Grid, Array, Mask]],
    axes: Sequence[int] = (0, 1),
    reach: Sequence[float] = (0.0, 0.0),
    ends: bool = False,
) -> list[Section]:
    """Return sections of fields, each on its grid, and limits around the marked cells of each.

    They run along `axes`: 0 is the sliding direction, and 1 across it. `reach` along both is a
    distance from the centre to be shown as well, in m. Where the bodies end at the window, `ends`,
    and marked cells reach its edge, the axis extends beyond it and the curves do not.
    """
    windows, cores = (
        [
            _hull([limits(m, g, axis, reach[axis], margin, ends) for g, _, m in fields])
            for axis in axes
        ]
        for margin in (MARGIN, 0.0)
    )
    units = axis_units([max(map(abs, window)) for window in windows])
    return [
        Section(axis, window, core, [_curve(g, f, axis) for g, f, _ in fields], unit)
        for axis, window, core, unit in zip(axes, windows, cores, units, strict=True)
    ]


def _curve(grid: Grid, field: Array, axis: int) -> Curve:
    """Return a field through the centre along an axis, up to the edges of the outermost cells."""
    edge, x = 0.5 * grid.size[axis], (grid.x, grid.y)[axis]
    return np.concatenate([[-edge], x, [edge]]), np.pad(profile(field, axis), 1, mode="edge")


def _hull(windows: Sequence[Limits]) -> Limits:
    return min(low for low, _ in windows), max(high for _, high in windows)


def limits(
    marked: Mask,
    grid: Grid,
    axis: int,
    reach: float = 0.0,
    margin: float = MARGIN,
    ends: bool = False,
) -> Limits:
    """Return limits in m that show all marked cells, a margin, and no more.

    They are the limits of the window if nothing is marked. `marked` has shape
    (nx, ny) or (1, ny); `reach` and `ends` are as in `through_centre`.
    """
    edge = 0.5 * grid.size[axis]
    index = np.flatnonzero(np.broadcast_to(marked, grid.cells).any(axis=1 - axis))
    if index.size == 0:
        return -edge, edge
    step = grid.spacing[axis]
    low = min(float(index[0]) * step - edge, -reach)
    high = max(float(index[-1] + 1) * step - edge, reach)
    beside = margin * max(0.5 * (high - low), 2.0 * step)
    beyond = np.inf if ends and (index[0] == 0 or index[-1] == grid.cells[axis] - 1) else edge
    return max(low - beside, -beyond), min(high + beside, beyond)


def bodies_end(result: Result) -> bool:
    """Return whether the bodies of a result end at its window."""
    return bool(result.case_tables["grid"].get("ends_at_window"))


def profiles_picture(
    sections: Sequence[Section],
    looks: Sequence[style.Look],
    labels: Sequence[str],
    title: str,
    shape: float = 0.62,
    room: Limits = (0.1, 0.05),
    what: str = "Height",
    more: Sequence[Panel] = (),
) -> Picture:
    """Return surfaces in one panel for each section, all with one scale of heights.

    A curve without a label is left out of the legend. `shape` is the height of
    the axes over their width, on paper; `room` is left free below and above
    the heights of what is marked, in parts of their range; `what` names the heights; `more` draws
    on each panel besides.
    """
    parts = [line for section in sections for line in section.in_sight()]
    low, high = min(map(np.min, parts)), max(map(np.max, parts))
    span = float(high - low) or 2e-8
    up = float(low) - room[0] * span, float(high) + room[1] * span
    unit = height_unit(max(map(abs, up)))

    def panel(section: Section, axes: Axes) -> list[Line2D]:
        lines = section.draw(axes, size(unit), looks, labels, up)
        axes.set_box_aspect(shape)
        enlarged = shape * (section.window[1] - section.window[0]) / (up[1] - up[0])
        axes.set_title(f"height × {style.times(enlarged)}", loc="right", fontsize="small")
        axes.set_ylabel(f"{what} ({unit})")
        if section is sections[0]:
            axes.set_title(title, loc="left")
        for draw in more:
            draw(axes)
        return [line for line, label in zip(lines, labels, strict=True) if label]

    row = [partial(panel, section) for section in sections]
    two = len(sections) > 1
    height = 20.0 + shape * (52.0 if two else 68.0)
    return Picture([row], height, style.WIDE if two else style.SINGLE_COLUMN, "y")
