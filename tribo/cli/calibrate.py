"""`tribo calibrate`."""

from __future__ import annotations

import math
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import pandas as pd
from rich.markup import escape
from rich.table import Table

from tribo.cli.console import Console, titled
from tribo.cli.options import CASE, JSON, PATH, SET, echo_json
from tribo.study.calibration.outcome import Calibration
from tribo.study.calibration.quantities import in_si, in_words, percent

LONGEST_NAME = 30
"""Characters of a name that a table for 80 columns has room for."""


@click.command()
@CASE
@click.option(
    "--measured",
    required=True,
    type=PATH,
    help="What was measured, and what to fit: a TOML file.",
)
@SET
@click.option(
    "--level", type=float, default=0.95, show_default=True, help="Probability of the intervals."
)
@click.option(
    "-o",
    "--output",
    type=PATH,
    help="Write the fitted case to a file; of several tests, one each, named after the test.",
)
@click.option("--force", is_flag=True, help="Replace existing files.")
@JSON
def calibrate(
    case: Path,
    measured: Path,
    overrides: tuple[str, ...],
    level: float,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fit CASE's wear coefficients, or other numbers of it, to measured wear.

    Takes one test or several that differ from CASE, repeated or not. Prints estimates with
    intervals, how each measured value is met, what the data cannot tell, and what else the fitted
    case gives.

    \b
    Example:
      tribo calibrate my.toml --measured weighed.toml -o fitted.toml
    """
    from tribo.config.load import read_toml
    from tribo.config.overrides import apply_settings
    from tribo.config.write import to_toml
    from tribo.core.files import write_whole
    from tribo.study.calibration.calibrate import calibrate
    from tribo.study.calibration.measured import read_measurements

    asked = read_measurements(measured)
    files = _files(output, list(dict.fromkeys(test.name for test in asked.tests.values())), force)
    found = calibrate(apply_settings(read_toml(case), overrides), asked, level=level, on_run=_tell)
    for name, tables in found.fitted.items():
        if name in files:
            write_whole(files[name], to_toml(tables))
    if as_json:
        echo_json(found.as_json())
        return
    console = Console()
    console.print(_estimates(found))
    console.print(_data(found))
    if len(found.predictions):
        console.print(_predictions(found))
    for line in _judgement(found):
        console.print(line)
    if output is not None:
        for name in found.fitted:
            click.echo(f"Run it: tribo run {shlex.quote(str(files[name]))}")
        return
    settings = [*overrides, *(f"{path}={value:.4g}" for path, value in found.settings.items())]
    options = " ".join(f"--set {shlex.quote(setting)}" for setting in settings)
    click.echo(f"Run it: tribo run {shlex.quote(str(case))} {options}")


def _files(output: Path | None, names: list[str], force: bool) -> dict[str, Path]:
    """Return the file of each test's fitted case."""
    from tribo.core.errors import CaseError
    from tribo.study.runs import file_names

    if output is None:
        return {}
    files = {"": output}
    for name, file in zip(names, file_names(names), strict=True):
        if name:
            files[name] = output.with_name(f"{output.stem}-{Path(file).stem}.toml")
    for path in (files[name] for name in names):
        if path.exists() and not force:
            raise CaseError(f"{path} exists; choose another name, or replace it with --force")
    return files


def _tell(run: int, misfit: float) -> None:
    click.echo(f"run {run}: misfit χ² {misfit:.3g}", err=True)


def _table(title: str, names: list[str], *columns: str) -> Table:
    """Return a table that breaks names and intervals between words, but no values."""
    table = titled(title)
    table.pad_edge, table.collapse_padding = False, True
    longest = max((len(word) for name in names for word in name.split()), default=0)
    whole = longest <= LONGEST_NAME and not any(" " in name for name in names)
    width = None if whole else min(longest, LONGEST_NAME)
    table.add_column("", overflow="fold", no_wrap=whole, min_width=width)
    for column in columns:
        is_interval = column == "" or column.endswith("interval")
        table.add_column(column, justify="right", overflow="fold", no_wrap=not is_interval)
    return table


def _estimates(found: Calibration) -> Table:
    names, level = list(found.parameters["path"]), f"{100 * found.level:g} % interval"
    table = _table(f"Fitted in {found.runs} runs", names, "estimate", level, "", "resolution")
    for each in found.parameters.itertuples():
        ends, relative = _interval(each, f"{each.lower:.3g}", f"{each.upper:.3g}")
        resolution = f"±{percent(each.resolution_limit)} %" if each.resolution_limit else ""
        if each.held:
            ends = "held by its bound"
        if each.held or math.isinf(each.upper):
            relative = resolution = ""
        table.add_row(each.path, in_si(each.value, each.unit), ends, relative, resolution)
    return table


def _data(found: Calibration) -> Table:
    names = [_name(each) for each in found.data.itertuples()]
    table = _table("Measured", names, "value", "uncertainty", "computed", "residual")
    for name, each in zip(names, found.data.itertuples(), strict=True):
        values = (each.measured, each.sigma, each.computed)
        shown = [in_words(each.quantity, value) for value in values]
        if each.below:
            shown[0] = f"< {shown[0]}"
        table.add_row(name, *shown, f"{round(each.residual, 1) + 0.0:+.1f}")
    return table


def _predictions(found: Calibration) -> Table:
    names = [_name(each) for each in found.predictions.itertuples()]
    level = f"{100 * found.level:g} % interval"
    table = _table("Not measured, at the end", names, "computed", level, "")
    for name, each in zip(names, found.predictions.itertuples(), strict=True):
        value, low, high = (
            in_words(each.quantity, value) for value in (each.value, each.lower, each.upper)
        )
        table.add_row(name, value, *_interval(each, low.split()[0], high))
    return table


def _judgement(found: Calibration) -> Iterator[str]:
    if found.p_value is not None:
        yield (
            f"χ² {found.chi_square:.3g} with {found.degrees_of_freedom} to spare, "
            f"p = {found.p_value:.2g}."
        )
    if found.repeatability or found.repeatability_estimated:
        how = "estimated" if found.repeatability_estimated else "as stated"
        yield f"Repeatability, {how}: ±{percent(found.repeatability)} % from test to test."
    values = ", ".join(f"{value:.3g}" for value in found.singular_values)
    yield f"Standard deviations by which a change by a factor e would show: {values}."
    paths = list(found.parameters["path"])
    for i, first in enumerate(paths):
        for j, second in enumerate(paths[:i]):
            both = round(found.correlation[i, j], 2) + 0.0
            yield f"Correlation of {second} and {first}: {both:+.2f}."
    for note in found.notes:
        yield f"[yellow]Note:[/] {escape(note)}"


def _name(row: Any) -> str:
    """Return the name of a row of the data or of the predictions."""
    text = f"{row.body}, {row.quantity}"
    if getattr(row, "test", ""):
        text = f"{row.test}: {text}"
    if pd.notna(getattr(row, "time_s", None)):
        text += f" at {row.time_s:g} s"
    if pd.notna(getattr(row, "position_m", None)):
        text += f" at {1e3 * row.position_m:g} mm"
    return text


def _interval(row: Any, low: str, high: str) -> tuple[str, str]:
    """Return the interval of a row, and the same relative to the value, if it is not open."""
    if math.isinf(row.upper):
        return f"{low} to open" if row.lower else "open", ""
    below, above = percent(1 - row.lower / row.value), percent(row.upper / row.value - 1)
    return f"{low} to {high}", f"±{above} %" if below == above else f"−{below} +{above} %"
