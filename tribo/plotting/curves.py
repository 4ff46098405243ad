"""Curves of a sweep's runs."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.words import did_you_mean, suggestion
from tribo.lab.units import column_label
from tribo.plotting.picture import Picture
from tribo.plotting.style import SINGLE_COLUMN, WIDE, save_looks

MARKS = "osD^vp"
"""Of its curves; the first is full, and seen inside another that coincides."""


def sweep_curves(
    runs: pd.DataFrame,
    x: str | Sequence[str],
    y: str,
    by: Sequence[str] = (),
    joined: bool = True,
) -> Figure:
    """Draw a measure `y` of a sweep's runs over what varies, a panel for each column in `x`.

    `runs` has a row for each run, as ``runs.csv``; columns `by` part the runs into curves, one for
    each combination of their values, and a line joins the runs of a curve if they are `joined`.

    Raises
    ------
    CaseError
        If there is no such column, or no run is done.
    """
    across = [x] if isinstance(x, str) else list(x)
    for name in (*across, y, *by):
        if name not in runs:
            meant = suggestion(did_you_mean(name, list(runs)))
            raise CaseError(f"the runs have no column {name!r}{meant}")
    done = runs[runs["status"] == "done"].sort_values(across[0])
    if done.empty:
        raise CaseError("no run is done; there is nothing to draw")
    groups = list(done.groupby(list(by))) if by else [((), done)]
    numbers = done[list(by)].apply(pd.to_numeric, errors="coerce").to_numpy(float)
    named = [column_label(name, column) for name, column in zip(by, numbers.T, strict=True)]
    looks = save_looks(len(groups))

    def panel(name: str, axes: Axes) -> list[Line2D]:
        every = done[name].to_numpy(float), done[y].to_numpy(float)
        curves: list[Line2D] = []
        for i, (look, (values, rows)) in enumerate(zip(looks, groups, strict=True)):
            label = ", ".join(
                f"{value / unit:.4g}" if isinstance(value, float) else str(value)
                for value, (_, _, unit) in zip(values, named, strict=True)
            )
            points = rows[name].to_numpy(float), rows[y].to_numpy(float)
            look = {**look, "marker": MARKS[i % len(MARKS)], "label": label}
            look |= {"fillstyle": "none", "markersize": 6.0} if i else {"markersize": 3.0}
            look |= {} if joined else {"linestyle": "none"}
            curves += _draw(axes, *points, name, y, every, **look)
        if len(across) > 1:
            axes.set_xlabel(axes.get_xlabel().replace(" (", "\n(", 1))
        return curves if by else []

    width = WIDE if len(across) > 1 else SINGLE_COLUMN
    figure = Picture([[partial(panel, name) for name in across]], 55.0, width, "y").figure()
    for legend in figure.legends:
        legend.set_title(", ".join(_axis(words, unit) for words, unit, _ in named))
    return figure


def _draw(
    axes: Axes,
    x: Array,
    y: Array,
    across: str,
    up: str,
    every: tuple[Array, Array] | None = None,
    **look: Any,
) -> list[Line2D]:
    """Draw a curve in units that fit `every` value, and label the axes."""
    every = every or (x, y)
    (below, unit, scale), (beside, unit_up, size_up) = (
        column_label(name, values) for name, values in zip((across, up), every, strict=True)
    )
    axes.set_xlabel(_axis(below, unit))
    axes.set_ylabel(_axis(beside, unit_up, "\n"))
    return axes.plot(x / scale, y / size_up, **{"color": "#202020", **look})


def _axis(words: str, unit: str, gap: str = " ") -> str:
    return f"{words}{gap}({unit})" if unit else words
