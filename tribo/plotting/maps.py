"""A field seen from above: its map, or its profile where it varies along one axis only."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.lab.units import axis_units, fitting, height_unit, size
from tribo.plotting.picture import NothingToDraw, Picture
from tribo.plotting.sections import MOST_CELLS, Limits, limits, section_row, through_centre, varying
from tribo.plotting.style import AXIS_LABELS, DEPTHS, PRESSURES, ticks

_AROUND = 19.0
"""Height of the title and of the labels, in mm."""
_WIDEST, _TALLEST = 41.0, 60.0
"""Most width and height of a map, in mm."""
_THINNEST = 2.5
"""Length over width up to which a map is true to scale: beyond, three in a row are strips."""
_STRETCHED = 1.4
"""Length over width on paper where it is not, as of a sheet: √2."""


class Layout(NamedTuple):
    """What maps of a window show, and how large they are on paper."""

    grid: Grid
    windows: Sequence[Limits]
    units: Sequence[str]
    size: tuple[float, float]
    """Of a map, in mm."""

    @classmethod
    def of(cls, marked: Mask, grid: Grid) -> Layout:
        """Return the layout of maps of all marked cells, true to scale unless they are thin."""
        windows = [limits(marked, grid, axis) for axis in (0, 1)]
        x, y = (high - low for low, high in windows)
        units = axis_units([max(map(abs, window)) for window in windows])
        shape = y / x
        if not 1 / _THINNEST <= shape <= _THINNEST:
            shape = _STRETCHED if shape > 1 else 1 / _STRETCHED
        width = min(_WIDEST, _TALLEST / shape)
        return cls(grid, windows, units, (width, width * shape))

    @property
    def height(self) -> float:
        """Of a map with its labels, in mm."""
        return self.size[1] + _AROUND

    def positions(self) -> tuple[Array, Array]:
        """Return the cells' centres along x and y in the units shown."""
        return self.grid.x / size(self.units[0]), self.grid.y / size(self.units[1])

    def prepare(self, axes: Axes) -> None:
        """Let axes show the window."""
        width, height = self.size
        axes.set_box_aspect(height / width)
        axes.spines[:].set_visible(True)
        axes.set_xlim(*(end / size(self.units[0]) for end in self.windows[0]))
        axes.set_ylim(*(end / size(self.units[1]) for end in self.windows[1]))
        # More steps to choose from, for there may be room for three long labels only.
        axes.xaxis.set_major_locator(MaxNLocator(max(1, int(width / 11.0))))
        axes.yaxis.set_major_locator(ticks(max(2, int(height / 7.0))))
        along, across = (f"{a} ({unit})" for a, unit in zip(AXIS_LABELS, self.units, strict=True))
        axes.set_xlabel(along)
        axes.set_ylabel(across.replace(", ", ",\n"))


class Scale(NamedTuple):
    """How values of a field are shown: what they are, unit and its size, and the colours."""

    what: str
    unit: str
    factor: float
    colours: str = PRESSURES
    least: float | None = 0.0
    """Where the colours begin; at a percentile of the cells if None."""
    most: float | None = None
    """Where the colours end; at a percentile of the cells if None."""

    @classmethod
    def of(cls, body: str, largest: float) -> Scale:
        """Return the scale of a body's depths up to `largest`, or of pressures for ""."""
        if body:
            unit = height_unit(largest)
            return cls(f"Depth of {body}", unit, size(unit), DEPTHS)
        unit = fitting("Pa", largest)
        return cls("Pressure", unit, size(unit))

    @property
    def label(self) -> str:
        """What is shown, and its unit."""
        return f"{self.what} ({self.unit})" if self.unit else self.what

    def draw(self, axes: Axes, shown: Layout, field: Array, marked: Mask) -> None:
        """Draw a field with its colour scale, white where it is not marked."""
        shown.prepare(axes)
        cells = field[marked] / self.factor if marked.any() else np.zeros(1)
        ends = np.percentile(cells, (100.0 - MOST_CELLS, MOST_CELLS))
        given = zip((self.least, self.most), ends, strict=True)
        low, high = (end if at is None else at / self.factor for at, end in given)
        lengths, (width, height) = shown.grid.size, shown.size
        x, y = (0.5 * s / size(unit) for unit, s in zip(shown.units, lengths, strict=True))
        window = {"xlim": axes.get_xlim(), "ylim": axes.get_ylim()}
        image = axes.imshow(
            np.where(marked, field / self.factor, np.nan).T,
            self.colours,
            origin="lower",
            extent=(-x, x, -y, y),
            aspect="auto",
            interpolation="nearest",
            vmin=low,
            vmax=high if high > low else low + 1.0,
        )
        axes.set(**window)
        end = f"{high:.3g}" if self.most else f"{MOST_CELLS:g} % of cells"
        largest = cells[np.argmax(np.abs(cells))]
        label = f"{self.label}\nto {end}; largest {largest:.4g}"
        bar = axes.inset_axes((1.0 + 2.0 / width, 0.0, 3.0 / width, 1.0))
        axes.figure.colorbar(image, cax=bar, label=label, ticks=ticks(max(3, int(height / 8))))


def field_picture(
    field: Array,
    marked: Mask,
    grid: Grid,
    scale: Scale,
    title: str,
    more: Callable[[Axes, Layout], Sequence[Artist]] = lambda axes, shown: (),
    vary: Sequence[int] | None = None,
) -> Picture:
    """Return a field from above; what varies along one axis only as its profile along it.

    `more` draws on the map; `vary` are the axes, 0 and 1, along which the field varies, if known.

    Raises
    ------
    NothingToDraw
        If it is uniform.
    """
    vary = varying([field], marked) if vary is None else vary
    if not vary:
        value = f"{np.mean(field[marked]) / scale.factor:.4g} {scale.unit}"
        raise NothingToDraw(f"{title}: {scale.what.lower()} is uniform, {value}")
    if len(vary) == 1:
        sections = through_centre([(grid, field, marked)], vary)
        up = min(0.0, float(np.min(field))), 1.05 * (scale.most or float(np.max(field)))
        labelled = scale.label, scale.factor
        row = section_row(sections, [{"color": "black"}], [""], labelled, up, title)
        return Picture([row], 55.0, share="")
    shown = Layout.of(marked, grid)

    def panel(axes: Axes) -> Sequence[Artist]:
        scale.draw(axes, shown, field, marked)
        axes.set_title(title, loc="left")
        return more(axes, shown)

    return Picture([[panel]], shown.height, share="")
