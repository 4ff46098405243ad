"""What a sweep ends with: a table of its runs and, where curves say it, a picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd
from rich.markup import escape

from tribo.cli.console import Console, titled

ROWS = 20
"""Most runs in the table."""
MEASURED = (
    ("max_pressure_Pa", "p max\nMPa", 1e-6, ".3g"),
    (".max_wear_depth_m", "{}\nµm", 1e6, ".3g"),
    (".wear_volume_m3", "{}\nmm³", 1e9, ".3g"),
)
"""End of a column's name, header, factor to its unit, and format."""


def print_runs(runs: pd.DataFrame, console: Console | None = None) -> None:
    """Print what varied and what came out of each run that is done."""
    console = console or Console()
    done = runs[runs["status"] == "done"]
    if done.empty:
        return
    table = titled("Runs: what varied; largest pressure, depth and volume of each body at the end")
    columns = [list(map(str, done["run"][:ROWS]))]
    table.add_column("run", justify="right")
    for name in varied_paths(runs):
        # The heading has the unit.
        cells = [escape(cell(name, done, index)) for index in done.index[:ROWS]]
        # A long name is broken before a value is.
        widest = max(map(len, cells))
        heading = escape(labelled(name, done)[0])
        table.add_column(heading, justify="right", overflow="fold", min_width=widest)
        columns.append(cells)
    for end, header, factor, digits in MEASURED:
        for name in [column for column in done if _measures(str(column), end)]:
            body = str(name).removeprefix("bodies.").removesuffix(end)
            table.add_column(escape(header.format(body)), justify="right", no_wrap=True)
            columns.append([f"{factor * value:{digits}}" for value in done[name][:ROWS]])
    for row in zip(*columns, strict=True):
        table.add_row(*row)
    console.print(table)
    if len(done) > ROWS:
        console.print(f"and {len(done) - ROWS} more, in runs.csv")


def draw_runs(runs: pd.DataFrame, folder: Path) -> list[Path]:
    """Draw the largest depth of each worn body over what varies most, and return the files."""
    from tribo.plotting.curves import sweep_pictures
    from tribo.plotting.figures import write_figures

    depths = [str(name) for name in runs if str(name).endswith(".max_wear_depth_m")]
    worn = [depth for depth in depths if (runs[depth] > 0).any()]
    pictures = sweep_pictures(runs, varied_paths(runs), worn)
    named = {f"{depth.split('.')[1]}_depth": draw for depth, draw in pictures.items()}
    return write_figures(named, folder) if named else []


def varied_paths(runs: pd.DataFrame) -> Sequence[str]:
    """Return the columns of what varies, which stand before the measures."""
    columns = list(map(str, runs))
    return columns[2 : columns.index("time_s")] if "time_s" in columns else []


def _measures(column: str, end: str) -> bool:
    """Whether a column is the run's own measure, or that of a body, of this name."""
    return column == end or (end.startswith(".") and column.endswith(end))


def is_text(runs: pd.DataFrame, name: str) -> bool:
    """Whether a column holds no numbers."""
    return not pd.api.types.is_numeric_dtype(runs[name])


def labelled(name: str, runs: pd.DataFrame) -> tuple[str, float]:
    """Return what is said of a column, with its unit, and the unit's size."""
    from tribo.plotting.curves import column_label

    if is_text(runs, name):
        return name.replace("_", " ").replace(".", " "), 1.0
    return column_label(name, runs[name].to_numpy(float))


def cell(name: str, runs: pd.DataFrame, index: Any) -> str:
    """Return a value of a run, in the unit of its column, which it leaves out."""
    value, factor = runs.at[index, name], labelled(name, runs)[1]
    if pd.isna(value):
        return "–"
    if factor == 1 and not isinstance(value, float):
        return str(value)
    return f"{value / factor:.4g}"
