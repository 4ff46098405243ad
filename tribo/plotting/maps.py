"""What maps of the window share: size on paper, scale, labels and colour scale."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.plotting.style import AXIS_LABELS, SINGLE_COLUMN, new_figure, ticks, times
from tribo.plotting.units import Unit, length_unit
from tribo.plotting.window import Limits, limits, positions

_LEFT, _RIGHT, _BOTTOM, _TOP = 19.5, 20.0, 10.0, 9.0
"""Room for the labels, in mm."""
_LINE = 3.6
"""Height of a line of text, in mm."""
_LABEL = 32.0
"""Longest label, in mm; a lower map breaks it."""
_WIDEST, _TALLEST = SINGLE_COLUMN - _LEFT - _RIGHT, 64.0
"""Most width and height of a map, in mm."""
_THINNEST = 2.5
"""Length over width up to which a map is true to scale."""
_STRETCHED = 1.4
"""Length over width on paper where it is not."""
_PIECES, _ROOM, _APART = 2, 8.0, 2.5
"""Most pieces of a line of equal value, least width where it is closed, and least distance
between two, in mm."""


@dataclass(frozen=True)
class Frame:
    """The part of the window that a map shows, along x and y."""

    window: tuple[Limits, Limits]
    """In m."""
    size: tuple[float, float]
    """On paper, in mm."""
    units: tuple[Unit, Unit]

    @property
    def enlarged(self) -> tuple[float, float]:
        """How many times larger than the other each axis is drawn, at least 1."""
        x, y = (
            size / (high - low) for size, (low, high) in zip(self.size, self.window, strict=True)
        )
        return max(x / y, 1.0), max(y / x, 1.0)

    def positions(self, grid: Grid) -> tuple[Array, Array]:
        """Return the cells' centres along x and y in the units shown."""
        x, y = (unit.of(positions(grid, axis)) for axis, unit in enumerate(self.units))
        return x, y


def frame(marked: Mask, grid: Grid, reach: Sequence[float] = (0.0, 0.0)) -> Frame:
    """Return a frame around all marked cells, true to scale unless that would be thin.

    `reach` are distances from the origin to be shown as well, in m.
    """
    x, y = (limits(marked, grid, axis, reach[axis]) for axis in (0, 1))
    shape = (y[1] - y[0]) / (x[1] - x[0])
    units = length_unit(max(map(abs, x))), length_unit(max(map(abs, y)))
    if 1 / _THINNEST <= shape <= _THINNEST:
        shown = shape
        units = (max(units, key=lambda unit: -unit.factor),) * 2
    else:
        shown = _STRETCHED if shape > 1 else 1 / _STRETCHED
    width = min(_WIDEST, _TALLEST / shown)
    return Frame((x, y), (width, width * shown), units)


def new_maps(frame: Frame, count: int = 1, below: float = 0.0) -> tuple[Figure, list[Axes]]:
    """Return a figure of `count` maps without fields, with room below them, in mm."""
    width, height = frame.size
    notes = [f"\nenlarged {times(f)} times" if f > 1.005 else "" for f in frame.enlarged]
    bottom = _BOTTOM + (_LINE if notes[0] else 0.0)
    row = bottom + height + _TOP
    total = count * row + below
    figure = new_figure(total)
    # The margins are known, and the layout engine would change the scale.
    figure.set_layout_engine("none")
    panels = []
    for number in reversed(range(count)):
        left, low = _LEFT + 0.5 * (_WIDEST - width), below + number * row + bottom
        axes = figure.add_axes(
            (left / SINGLE_COLUMN, low / total, width / SINGLE_COLUMN, height / total)
        )
        axes.spines[:].set_visible(True)
        axes.set_xlim(*(frame.units[0].factor * end for end in frame.window[0]))
        axes.set_ylim(*(frame.units[1].factor * end for end in frame.window[1]))
        # More steps to choose from, for there may be room for three long labels only.
        axes.xaxis.set_major_locator(MaxNLocator(max(1, int(width / 11.0))))
        axes.yaxis.set_major_locator(ticks(max(2, int(height / 7.0))))
        labels = [
            f"{label} ({unit.name}){note}"
            for label, unit, note in zip(AXIS_LABELS, frame.units, notes, strict=True)
        ]
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1] if height >= _LABEL else labels[1].replace(", ", ",\n"))
        panels.append(axes)
    return figure, panels


def draw_image(
    axes: Axes, grid: Grid, frame: Frame, field: Array, label: str, **look: Any
) -> AxesImage:
    """Draw a field in the units shown, with its colour scale; `look` goes to `Axes.imshow`."""
    x, y = (0.5 * unit.factor * size for unit, size in zip(frame.units, grid.size, strict=True))
    window = axes.get_xlim(), axes.get_ylim()
    image = axes.imshow(
        field.T,
        origin="lower",
        extent=(-x, x, -y, y),
        aspect="auto",
        **look,
    )
    axes.set(xlim=window[0], ylim=window[1])
    width, height = frame.size
    scale = axes.inset_axes((1.0 + 2.0 / width, 0.0, 3.0 / width, 1.0))
    axes.figure.colorbar(image, cax=scale, label=label, ticks=ticks(max(3, int(height / 8))))
    return image


def draw_lines(
    axes: Axes,
    grid: Grid,
    frame: Frame,
    field: Array,
    levels: Iterable[float],
    looks: Iterable[Mapping[str, Any]],
) -> list[QuadContourSet]:
    """Draw lines of equal value, but for those in fragments or without room, and return them.

    The field may be masked; `looks` go to `Axes.contour`, one for each level.
    """
    x, y = frame.positions(grid)
    corners = np.array([(x[0], y[0]), (x[-1], y[-1])])
    per_unit = np.asarray(frame.size) / np.ptp([axes.get_xlim(), axes.get_ylim()], axis=1)
    lines: list[QuadContourSet] = []
    drawn: list[Array] = []
    for level, look in zip(levels, looks, strict=True):
        line = axes.contour(x, y, field.T, levels=[level], linewidths=0.5, **look)
        pieces = [piece for piece in line.allsegs[0] if len(piece)]
        whole = all(_is_whole(piece, corners, per_unit) for piece in pieces)
        points = per_unit * np.concatenate([*pieces, np.empty((0, 2))])
        if 0 < len(pieces) <= _PIECES and whole and all(_apart(points, near) for near in drawn):
            lines.append(line)
            drawn.append(points)
        else:
            line.remove()
    return lines


def _is_whole(piece: Array, corners: Array, per_unit: Array) -> bool:
    """Whether a line is closed, with room in it, or ends at the window's edges."""
    if np.array_equal(piece[0], piece[-1]):
        return bool(np.min(per_unit * np.ptp(piece, axis=0)) > _ROOM)
    return all(bool(np.any(end == corners)) for end in piece[[0, -1]])


def _apart(one: Array, other: Array) -> bool:
    """Whether two lines have room between them."""
    return bool(np.min(np.hypot(*(one[:, None] - other[None]).T)) > _APART)
