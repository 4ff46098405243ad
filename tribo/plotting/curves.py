"""Curves of a sweep's runs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribo.lab.units import column_label
from tribo.plotting.picture import Picture
from tribo.plotting.style import save_looks

MARKS = "osD^vp"
"""Of its curves; the first is full, and seen inside another that coincides."""


def sweep_curves(runs: pd.DataFrame, x: str, y: str, by: Sequence[str] = ()) -> Figure:
    """Draw a measure `y` of a sweep's runs over a column `x` that varies.

    `runs` has a row for each run, as ``runs.csv``; columns `by` part the runs into curves, one for
    each combination of their values.
    """
    done = runs[runs["status"] == "done"].sort_values(x)
    groups = list(done.groupby(list(by))) if by else [((), done)]
    named = [labelled(name, done)[:2] for name in by]
    below, beside = (labelled(name, done) for name in (x, y))

    def panel(axes: Axes) -> list[Line2D]:
        axes.set_xlabel(_axis(*below[:2]))
        axes.set_ylabel(_axis(*beside[:2], "\n"))
        curves: list[Line2D] = []
        looks = enumerate(zip(save_looks(len(groups)), groups, strict=True))
        for i, (look, (_, rows)) in looks:
            label = ", ".join(cell(name, done, rows.index[0]) for name in by)
            look = {**look, "marker": MARKS[i % len(MARKS)], "label": label}
            look |= {"fillstyle": "none", "markersize": 6.0} if i else {"markersize": 3.0}
            curves += axes.plot(rows[x] / below[2], rows[y] / beside[2], **look)
        return curves if by else []

    figure = Picture([[panel]], 55.0).figure()
    for legend in figure.legends:
        legend.set_title(", ".join(_axis(*each) for each in named))
    return figure


def labelled(name: str, runs: pd.DataFrame) -> tuple[str, str, float]:
    """Return the label of a column, its unit, "" for none, and the unit's size."""
    return column_label(name, pd.to_numeric(runs[name], errors="coerce").to_numpy(float))


def cell(name: str, runs: pd.DataFrame, index: Any) -> str:
    """Return a value of a run, in the unit of its column, which it leaves out."""
    value, (_, _, factor) = runs.at[index, name], labelled(name, runs)
    if pd.isna(value):
        return "–"
    if factor == 1 and not isinstance(value, float):
        return str(value)
    return f"{value / factor:.4g}"


def _axis(words: str, unit: str, gap: str = " ") -> str:
    return f"{words}{gap}({unit})" if unit else words
