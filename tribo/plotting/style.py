"""The house style: print size, readable in grey, safe for the colour-blind."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, Literal

import matplotlib
import numpy as np
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.colors import Colormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array

SINGLE_COLUMN = 85.0
"""Width of a picture in one column, in mm."""
WIDE = 130.0
"""Width of a picture in one and a half columns, in mm."""
LEGEND_ROWS = 4
"""Most rows of a legend of saves; with more saves only some are named."""

AXIS_LABELS = ("Along sliding, x", "Across sliding, y")

_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "dejavusans",
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.limits": (-3, 5),
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "lines.linewidth": 1.2,
    "lines.scale_dashes": False,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "legend.handlelength": 2.8,
    "legend.columnspacing": 1.4,
    "figure.constrained_layout.use": True,
    "figure.dpi": 200.0,
    "savefig.dpi": "figure",
    "pdf.fonttype": 42,
    "svg.hashsalt": "tribo",
}

Dashes = tuple[float, tuple[float, ...]]
DASHES: tuple[Dashes, ...] = (
    (0.0, (4.0, 1.6)),
    (0.0, ()),
    (0.0, (6.0, 1.4, 1.2, 1.4)),
    (0.0, (1.2, 1.2)),
    (0.0, (8.0, 1.6)),
    (0.0, (5.0, 1.2, 1.2, 1.2, 1.2, 1.2)),
)

# Matplotlib keeps its settings in one place for all threads.
_lock = threading.RLock()


@dataclass(frozen=True)
class Stroke:
    """How a line looks: its lightness, its dashes and its marker."""

    colour: str | tuple[float, float, float]
    dashes: Dashes | Literal["none"] = (0.0, ())
    marker: str = ""
    width: float = 1.2
    size: float = 4.0

    def draw(self, axes: Axes, x: Array, y: Array, label: str = "", **more: Any) -> Line2D:
        """Draw `y` over `x`, and return the line; `more` goes to `Axes.plot`."""
        (line,) = axes.plot(
            x,
            y,
            color=self.colour,
            linestyle=self.dashes,
            marker=self.marker,
            linewidth=self.width,
            markersize=self.size,
            label=label.lstrip("_") or None,
            **more,
        )
        return line


OVER = Stroke("#202020", dashes=(0.0, (3.0, 1.6)), width=1.1)
"""A narrow dark line: it and a wide light one below it both show where they coincide."""
BODY_STROKES = (
    Stroke("#56b4e9", marker="o", width=2.4, size=7.0),
    replace(OVER, marker="s", size=3.0),
)


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style inside the context, whatever the user's settings.

    Threads take turns.
    """
    with _lock, style.context(["default", _STYLE]):
        yield


def new_figure(height: float, width: float = SINGLE_COLUMN) -> Figure:
    """Return an empty figure of a size in mm, tied to no display.

    Parameters
    ----------
    height, width : float
        In mm.
    """
    return Figure(figsize=(width / 25.4, height / 25.4))


def ticks(most: int) -> MaxNLocator:
    """Return a locator of at most so many round intervals.

    Unlike matplotlib's own it does not depend on the axis' length, so that the
    layout, which depends on how long the labels are, has an end.
    """
    return MaxNLocator(most, steps=[1, 2, 2.5, 5, 10])


def times(factor: float) -> str:
    """Return two digits of a factor."""
    digits, power = f"{factor:.1e}".split("e")
    if int(power) >= 5:
        return rf"${digits} \times 10^{{{int(power)}}}$"
    return f"{float(f'{factor:.1e}'):g}"


def pressure_colours() -> Colormap:
    """Return the map of pressures: lighter is higher, and white is no contact."""
    return matplotlib.colormaps["viridis"].with_extremes(bad="white")


def save_strokes(count: int) -> list[Stroke]:
    """Return a stroke for each save, from dark to light, neighbours dashed differently."""
    # The lightest third of the map would not show on white.
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.7, max(count - 1, 1)))
    strokes = [Stroke("black", DASHES[0])]
    for i, (red, green, blue, _) in enumerate(colours[: count - 1], start=1):
        strokes.append(Stroke((float(red), float(green), float(blue)), DASHES[i % len(DASHES)]))
    return strokes[:count]


def overlay_strokes(count: int) -> list[Stroke]:
    """Return a stroke for each of several results; the first shows below one that coincides."""
    return [Stroke("#a8a8a8", width=3.0), *save_strokes(count - 1)][:count]


def difference_colours() -> Colormap:
    """Return the map of differences: white is none, and both ends are dark."""
    return matplotlib.colormaps["PuOr"]


def legend_below(figure: Figure, lines: Sequence[Line2D], columns: int = 3) -> None:
    """Put a legend under the axes, where it hides nothing.

    Parameters
    ----------
    figure : Figure
        The figure.
    lines : sequence of Line2D
        What it explains; if too many, some are left out evenly.
    columns : int, optional
        Most columns.
    """
    most = LEGEND_ROWS * columns
    if len(lines) > most:
        chosen = np.unique(np.linspace(0, len(lines) - 1, most).round().astype(int))
        lines = [lines[i] for i in chosen]
    rows = -(-len(lines) // columns)
    columns = -(-len(lines) // rows)
    # Matplotlib fills column by column; a reader goes row by row.
    figure.legend(
        handles=[line for start in range(columns) for line in lines[start::columns]],
        loc="outside lower center",
        ncols=columns,
    )


def legend_height(count: int, columns: int = 3) -> float:
    """Return how high a legend is with its surroundings, in mm."""
    rows = min(-(-count // columns), LEGEND_ROWS)
    return 3.6 * (rows + 1)
