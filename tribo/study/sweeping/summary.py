"""The summary of a sweep: a table of its runs and, where runs form curves, a picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from tribo.core.data_table import DataTable, Heading, TableRow
from tribo.plotting.curves import cell, labelled, sweep_curves
from tribo.plotting.figures import write_figures

MEASURED = (".max_wear_depth_m", ".wear_volume_m3")
"""Ends of the names of the columns of bodies that a terminal shows."""


def measured(runs: pd.DataFrame) -> list[str]:
    """Return the columns that a terminal shows: the largest pressure, depths and volumes."""
    return [name for name in map(str, runs) if name == "max_pressure_Pa" or name.endswith(MEASURED)]


def runs_table(runs: pd.DataFrame, measures: Sequence[str]) -> DataTable:
    """Return what varied and some measures of each run; its status where one is not done."""
    status = ["status"] if (runs["status"] != "done").any() else []
    shown = ["run", *status, *varied_paths(runs), *measures]
    headings = [column_heading(name, runs) for name in shown]
    rows = [TableRow(tuple(cell(name, runs, index) for name in shown)) for index in runs.index]
    return DataTable("Each run at its end", headings, rows, dense=True)


def draw_runs(runs: pd.DataFrame, folder: Path) -> list[Path]:
    """Draw the largest depth of each worn body over what varies most, and return the files."""
    depths = [str(name) for name in runs if str(name).endswith(".max_wear_depth_m")]
    worn = [depth for depth in depths if (runs[depth] > 0).any()]
    pictures = sweep_pictures(runs, varied_paths(runs), worn)
    named = {f"{depth.split('.')[1]}_depth": draw for depth, draw in pictures.items()}
    return write_figures(named, folder) if named else []


def sweep_pictures(
    runs: pd.DataFrame, varied: Sequence[str], measures: Sequence[str]
) -> dict[str, Callable[[], Figure]]:
    """Return how to draw each measure over the number that varies most; none if no number does.

    What else varies parts the runs into curves.
    """
    done = runs[runs["status"] == "done"]
    # Columns that are alike, as of cells along both axes, part the runs no further.
    apart = map(str, done[[*varied]].T.drop_duplicates().index)
    counts = {name: done[name].nunique() for name in apart if done[name].nunique() > 1}
    numbers = [name for name in counts if not is_text(done, name)]
    if not numbers:
        return {}
    x = max(numbers, key=lambda name: counts[name])
    by = [name for name in counts if name != x]
    return {name: partial(sweep_curves, done, x, name, by) for name in measures}


def varied_paths(runs: pd.DataFrame) -> Sequence[str]:
    """Return the columns of settings that vary, which come before the measures."""
    columns = list(map(str, runs))
    return columns[2 : columns.index("time_s")] if "time_s" in columns else []


def is_text(runs: pd.DataFrame, name: str) -> bool:
    """Whether a column holds no numbers."""
    return not pd.api.types.is_numeric_dtype(runs[name])


def column_heading(name: str, runs: pd.DataFrame) -> Heading:
    """Return the heading of a column, its unit in brackets."""
    words, unit, _ = labelled(name, runs)
    return Heading(f"{words} ({unit})" if unit else words)
