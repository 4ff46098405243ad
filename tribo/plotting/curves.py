"""Curves of what a person asks for: columns of a history, runs of a sweep, a fit and its data."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
from tribo.plotting.style import SINGLE_COLUMN, WIDE, house_style, new_figure, save_looks
from tribo.result.read import Result

MOST_CURVES = 6
"""In a picture of a sweep."""
MARKS = "osD^vp"
"""Of its curves; the first is full, and seen inside another that coincides."""


def history_curves(result: Result, columns: Sequence[str], against: str = "distance_m") -> Figure:
    """Draw columns of the history against another, a panel for each.

    Parameters
    ----------
    result : Result
        What to draw.
    columns : sequence of str
        Names as in ``result.table("history")``: ``"max_pressure_Pa"``.
    against : str, optional
        The column along the horizontal axis: ``"distance_m"``, ``"time_s"`` or any other.

    Raises
    ------
    CaseError
        If there is no such column, or no save.
    """
    history = result.table("history")
    for name in (*columns, against):
        if name not in history:
            known = ", ".join(history)
            meant = suggestion(did_you_mean(name, history))
            raise CaseError(f"the history has no column {name!r}{meant} It has {known}")
    with house_style():
        figure = new_figure(15.0 + 36.0 * len(columns))
        panels = figure.subplots(len(columns), 1, sharex=True, squeeze=False)[:, 0]
        for axes, name in zip(panels, columns, strict=True):
            _draw(axes, history[against], history[name], against, name)
            axes.label_outer()
    return figure


def sweep_pictures(
    runs: pd.DataFrame, varied: Sequence[str], measures: Sequence[str]
) -> dict[str, Callable[[], Figure]]:
    """Return how to draw each measure over the number that varies most; none if no number does.

    Where the runs do not part into curves it is drawn over every number that varies.
    """
    done = runs[runs["status"] == "done"]
    numbers = [name for name in varied if pd.api.types.is_numeric_dtype(done[name])]
    numbers = [name for name in numbers if done[name].nunique() > 1]
    if not numbers:
        return {}
    most = max(numbers, key=lambda name: done[name].nunique())
    by, joined = curves_by(done, [name for name in varied if name != most])
    x = [most] if joined else numbers
    return {name: partial(sweep_curves, done, x, name, by, joined) for name in measures}


def curves_by(done: pd.DataFrame, others: Sequence[str]) -> tuple[list[str], bool]:
    """Return the columns that part runs into curves, and whether a line joins those of a curve.

    Where other quantities vary along, as in a random sample, none does; only text tells the runs
    apart then.
    """
    others = [name for name in others if done[name].nunique() > 1]
    texts = [name for name in others if not pd.api.types.is_numeric_dtype(done[name])]
    for names, joined in ((others, True), (texts, False)):
        count = done.groupby(names).ngroups if names else 1
        if count <= MOST_CURVES and len(done) >= (2 * count if joined else 1):
            return names, joined
    return [], False


def sweep_curves(
    runs: pd.DataFrame,
    x: str | Sequence[str],
    y: str,
    by: Sequence[str] = (),
    joined: bool = True,
) -> Figure:
    """Draw a measure of a sweep's runs over what varies, a panel for each quantity.

    Parameters
    ----------
    runs : DataFrame
        A row for each run, as ``runs.csv`` has them.
    x, y : str
        Its columns along both axes; several along x.
    by : sequence of str, optional
        Columns that part the runs into curves, one for each combination of their values.
    joined : bool, optional
        Whether a line joins the runs of a curve.

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
