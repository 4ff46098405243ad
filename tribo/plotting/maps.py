"""What maps of the window share: size on paper, scale, labels and colour scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.plotting.sections import limits
from tribo.plotting.style import AXIS_LABELS, new_figure, ticks, times
from tribo.plotting.units import axis_units, size

_AROUND = 19.0
"""Height of the title and of the labels, in mm."""
_LINE = 3.6
"""Height of a line of text, in mm."""
_LABEL = 32.0
"""Longest label, in mm; a lower map breaks it."""
_WIDEST, _TALLEST = 45.0, 64.0
"""Most width and height of a map, in mm."""
_THINNEST = 2.5
"""Length over width up to which a map is true to scale."""
_STRETCHED = 1.4
"""Length over width on paper where it is not."""


@dataclass(frozen=True)
class Map:
    """Axes that show a part of the window from above."""

    axes: Axes
    grid: Grid
    units: Sequence[str]
    """Along x and y."""
    size: tuple[float, float]
    """On paper, in mm."""

    def positions(self) -> tuple[Array, Array]:
        """Return the cells' centres along x and y in the units shown."""
        return self.grid.x / size(self.units[0]), self.grid.y / size(self.units[1])

    def image(self, field: Array, label: str, **look: Any) -> AxesImage:
        """Draw a field with its colour scale; `look` goes to `Axes.imshow`."""
        axes = self.axes
        x, y = (0.5 * s / size(unit) for unit, s in zip(self.units, self.grid.size, strict=True))
        shown = {"xlim": axes.get_xlim(), "ylim": axes.get_ylim()}
        image = axes.imshow(field.T, origin="lower", extent=(-x, x, -y, y), aspect="auto", **look)
        axes.set(**shown)
        width, height = self.size
        scale = axes.inset_axes((1.0 + 2.0 / width, 0.0, 3.0 / width, 1.0))
        axes.figure.colorbar(image, cax=scale, label=label, ticks=ticks(max(3, int(height / 8))))
        return image


def new_maps(
    marked: Mask, grid: Grid, reach: Sequence[float] = (0.0, 0.0), count: int = 1
) -> tuple[Figure, list[Map]]:
    """Return a figure of maps without fields, true to scale unless that would be thin.

    They show all marked cells, and a distance `reach` from the centre along x
    and y, in m.
    """
    windows = [limits(marked, grid, axis, reach[axis]) for axis in (0, 1)]
    x, y = (high - low for low, high in windows)
    units = axis_units([max(map(abs, window)) for window in windows])
    shape = y / x
    if not 1 / _THINNEST <= shape <= _THINNEST:
        shape = _STRETCHED if shape > 1 else 1 / _STRETCHED
    width = min(_WIDEST, _TALLEST / shape)
    height = width * shape
    per_metre = width / x, height / y
    factors = [scale / min(per_metre) for scale in per_metre]
    labels = [
        f"{label} ({unit})" + (f"\nenlarged {times(factor)} times" if factor > 1.005 else "")
        for label, unit, factor in zip(AXIS_LABELS, units, factors, strict=True)
    ]
    row = height + _AROUND + _LINE * labels[0].count("\n")
    figure = new_figure(count * row)
    maps = []
    for axes in figure.subplots(count, 1, squeeze=False)[:, 0]:
        axes.set_box_aspect(shape)
        axes.spines[:].set_visible(True)
        axes.set_xlim(*(end / size(units[0]) for end in windows[0]))
        axes.set_ylim(*(end / size(units[1]) for end in windows[1]))
        # More steps to choose from, for there may be room for three long labels only.
        axes.xaxis.set_major_locator(MaxNLocator(max(1, int(width / 11.0))))
        axes.yaxis.set_major_locator(ticks(max(2, int(height / 7.0))))
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1] if height >= _LABEL else labels[1].replace(", ", ",\n"))
        maps.append(Map(axes, grid, units, (width, height)))
    return figure, maps
