"""Views of fields: the axes along which they vary, limits, and sections."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.lab.units import axis_units, height_unit, size
from tribo.plotting.picture import Panel
from tribo.plotting.style import AXIS_LABELS, Look, ticks
from tribo.result.export import profile

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
    curves: Sequence[Curve]
    unit: str
    """In which positions are shown."""

    def in_sight(self) -> list[Array]:
        """Return the part of each curve that is shown."""
        low, high = self.window
        return [values[(low <= x) & (x <= high)] for x, values in self.curves]


More = Callable[[Section, Axes], Sequence[Artist]]
"""Draws on the panel of a section, and returns what the legend names."""


def varying(fields: Sequence[Array], marked: Mask) -> tuple[int, ...]:
    """Return the axes, 0 and 1, along which one of the fields varies around what is marked."""
    return tuple(axis for axis in (0, 1) if any(_varies(f, marked, axis) for f in fields))


def _varies(field: Array, marked: Mask, axis: int) -> bool:
    ends = (_ends(marked, along) for along in (0, 1))
    box = tuple(slice(max(first - 1, 0), last + 2) for first, last in ends)
    part = np.broadcast_to(field, marked.shape)[box]
    spread = np.abs(part - np.mean(part, axis=axis, keepdims=True))
    largest, most = (float(np.percentile(np.abs(each), MOST_CELLS)) for each in (part, spread))
    return most > SHADE * largest


def _ends(marked: Mask, axis: int) -> tuple[int, int]:
    """Return the first and the last marked cell along an axis, of all if none is."""
    index = np.flatnonzero(marked.any(axis=1 - axis))
    return (int(index[0]), int(index[-1])) if index.size else (0, marked.shape[axis] - 1)


def through_centre(
    fields: Sequence[tuple[Grid, Array, Mask]], axes: Sequence[int] = (0, 1)
) -> list[Section]:
    """Return sections of fields, each on its grid, and limits around the marked cells of each.

    They run along `axes`: 0 is the sliding direction, and 1 across it.
    """
    windows = []
    for axis in axes:
        lows, highs = zip(*(limits(m, g, axis) for g, _, m in fields), strict=True)
        windows.append((min(lows), max(highs)))
    units = axis_units([max(map(abs, window)) for window in windows])
    return [
        Section(axis, window, [_curve(g, f, axis) for g, f, _ in fields], unit)
        for axis, window, unit in zip(axes, windows, units, strict=True)
    ]


def _curve(grid: Grid, field: Array, axis: int) -> Curve:
    """Return a field through the centre along an axis, up to the edges of the outermost cells."""
    edge, x = 0.5 * grid.size[axis], (grid.x, grid.y)[axis]
    return np.concatenate([[-edge], x, [edge]]), np.pad(profile(field, axis), 1, mode="edge")


def limits(marked: Mask, grid: Grid, axis: int) -> Limits:
    """Return limits in m that show all marked cells, a margin, and no more.

    They are the limits of the window if nothing is marked. Where the bodies end at the window and
    marked cells reach its edge, they lie beyond it. `marked` has shape (nx, ny) or (1, ny).
    """
    edge = 0.5 * grid.size[axis]
    first, last = _ends(np.broadcast_to(marked, grid.cells), axis)
    step = grid.spacing[axis]
    low, high = first * step - edge, (last + 1) * step - edge
    beside = MARGIN * max(0.5 * (high - low), 2.0 * step)
    at_end = first == 0 or last == grid.cells[axis] - 1
    beyond = np.inf if grid.ends_at_window and at_end else edge
    return max(low - beside, -beyond), min(high + beside, beyond)


def section_row(
    sections: Sequence[Section],
    looks: Sequence[Look],
    labels: Sequence[str],
    scale: tuple[str, float],
    up: Limits,
    title: str = "",
    more: Sequence[More] = (),
) -> list[Panel]:
    """Return a panel for each section, between the limits `up`, in SI units.

    `scale` is the label of the values and the size of their unit. A curve without a label is left
    out of the legend; `more` draws on each panel besides.
    """

    def panel(section: Section, axes: Axes) -> Sequence[Artist]:
        axes.set_xlim(*(end / size(section.unit) for end in section.window))
        axes.set_xlabel(f"{AXIS_LABELS[section.axis]} ({section.unit})")
        axes.xaxis.set_major_locator(ticks(5))
        axes.set_ylim(*(end / scale[1] for end in up))
        axes.yaxis.set_major_locator(ticks(7))
        axes.set_ylabel(scale[0])
        if section is sections[0]:
            axes.set_title(title, loc="left")
        named: list[Artist] = []
        for (position, values), look, label in zip(section.curves, looks, labels, strict=True):
            # Matplotlib leaves labels that begin with an underscore out of the legend.
            shown = position / size(section.unit), values / scale[1]
            lines = axes.plot(*shown, label=label.lstrip("_"), **look)
            named += lines if label else []
        return [*named, *(artist for draw in more for artist in draw(section, axes))]

    return [partial(panel, section) for section in sections]


def heights_row(
    sections: Sequence[Section],
    looks: Sequence[Look],
    labels: Sequence[str],
    title: str,
    what: str = "Height",
    room: Limits = (0.1, 0.05),
    more: Sequence[More] = (),
) -> list[Panel]:
    """Return a `section_row` of surfaces, with one scale of heights.

    `room` is left free below and above, in parts of the range of the heights.
    """
    parts = [line for section in sections for line in section.in_sight()]
    low, high = float(min(map(np.min, parts))), float(max(map(np.max, parts)))
    span = high - low or 2e-8
    up = low - room[0] * span, high + room[1] * span
    unit = height_unit(max(map(abs, up)))
    scale = f"{what} ({unit})", size(unit)
    return section_row(sections, looks, labels, scale, up, title, more)
