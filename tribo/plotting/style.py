"""The house style: print size, readable in grey, safe for the colour-blind."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import matplotlib
import numpy as np
from matplotlib import style
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

SINGLE_COLUMN = 85.0
"""Width of a picture in one column, in mm."""
WIDE = 130.0
"""Width of a picture in one and a half columns, in mm."""
LETTER = 1.25
"""Width of a letter of a legend, in mm."""
HANDLE = 10
"""Room for the line of a legend's entry and the gaps beside it, in letters: matplotlib's 4.8 font
sizes."""
LEGEND_ROWS = 4
"""Most rows of a legend of saves; with more saves only some are named."""

AXIS_LABELS = ("Along sliding, x", "Across sliding, y")

Look = Mapping[str, Any]
"""How a line looks: keywords of `Axes.plot`."""

DASHES = (
    (0.0, (4.0, 1.6)),
    (0.0, ()),
    (0.0, (6.0, 1.4, 1.2, 1.4)),
    (0.0, (1.2, 1.2)),
    (0.0, (8.0, 1.6)),
    (0.0, (5.0, 1.2, 1.2, 1.2, 1.2, 1.2)),
)
"""Dashes and gaps in line widths, which differ in print without colours."""
UNDER: Look = {"color": "#56b4e9", "linewidth": 2.4}
OVER: Look = {"color": "#202020", "linewidth": 1.1, "linestyle": (0.0, (3.0, 1.6))}
"""A wide light line and a narrow dark one; both are seen where they coincide."""

PRESSURES = "viridis"
"""Colours of pressures: higher is lighter."""
DEPTHS = "Blues"
"""Colours of depths: deeper is darker."""


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style inside the context, whatever the user's settings.

    It is the style ``tribo.plotting.house`` of matplotlib, which is not safe in threads.
    """
    with style.context(["default", "tribo.plotting.house"]):
        yield


def new_figure(height: float, width: float = SINGLE_COLUMN) -> Figure:
    """Return an empty figure of a size in mm, tied to no display."""
    return Figure(figsize=(width / 25.4, height / 25.4))


def ticks(most: int) -> MaxNLocator:
    """Return a locator of at most so many round intervals.

    Unlike matplotlib's own it does not depend on the length of the axis, which the
    layout changes to make room for the labels.
    """
    return MaxNLocator(most, steps=[1, 2, 2.5, 5, 10])


def save_looks(count: int) -> list[Look]:
    """Return a look for each save, from dark to light, neighbours dashed differently."""
    # The lightest third of the map would not show on white.
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.7, max(count - 1, 1)))
    return [
        {"color": colour, "linestyle": DASHES[i % len(DASHES)]}
        for i, colour in enumerate(["black", *map(tuple, colours)][:count])
    ]


def legend_below(figure: Figure, curves: Sequence[Artist]) -> None:
    """Put a legend under the axes, where it hides nothing, and make the figure as much higher.

    Where there are too many curves for it, some are left out evenly.
    """
    longest = max((len(str(curve.get_label())) for curve in curves), default=0)
    room = figure.get_figwidth() * 25.4 / (LETTER * (longest + HANDLE))
    columns = max(1, int(room))
    most = min(len(curves), LEGEND_ROWS * columns)
    chosen = np.linspace(0, len(curves) - 1, most).round().astype(int)
    entries = [curves[i] for i in chosen]
    rows = -(-most // columns)
    columns = -(-most // rows)
    figure.set_figheight(figure.get_figheight() + 3.6 * (rows + 1) / 25.4)
    # Matplotlib fills column by column; a reader goes row by row.
    figure.legend(
        handles=[entry for start in range(columns) for entry in entries[start::columns]],
        loc="outside lower center",
        ncols=columns,
    )
