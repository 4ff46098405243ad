"""`tribo calibrate`."""

from __future__ import annotations

import math
import shlex
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import click
import pandas as pd
from rich.markup import escape
from rich.table import Table

from tribo.cli.console import Console, titled
from tribo.cli.options import JSON, PATH, SET, echo_json
from tribo.core.words import signed
from tribo.study.calibration.calibrate import Calibration
from tribo.study.calibration.choice import Choice
from tribo.study.calibration.measured import Measurements
from tribo.study.calibration.plan import Plan
from tribo.study.calibration.quantities import in_si, in_words, percent

FAR = 10.0
"""Factor of an interval's end from the value above which its part in percent tells nothing."""
BLIND = 0.2
"""Standard deviations by which a change by a factor e shows, below which the data are blind."""
PICTURE = "\0picture"
"""Key of the picture among files by the names of tests."""
PAUSE = 1.0
"""Least time between two lines that tell of samples, in s."""
LONGEST_NAME = 30
"""Characters of a name that a table for 80 columns has room for."""


@click.command()
@click.argument("cases", metavar="CASE...", nargs=-1, required=True, type=PATH)
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
    help="Write the fitted case to a file, of several tests one each, and a picture of the fit.",
)
@click.option("--force", is_flag=True, help="Replace existing files.")
@click.option(
    "--plan",
    type=float,
    metavar="PART",
    help="Instead, say how many of the tests give intervals of ± this part, as 0.1.",
)
@click.option(
    "--sample",
    type=click.IntRange(min=1),
    metavar="COUNT",
    help="Check the intervals by so many runs more, sampled with emcee; as 2000.",
)
@JSON
def calibrate(
    cases: tuple[Path, ...],
    measured: Path,
    overrides: tuple[str, ...],
    level: float,
    output: Path | None,
    force: bool,
    plan: float | None,
    sample: int | None,
    as_json: bool,
) -> None:
    """Fit CASE's wear coefficients, or other numbers of it, to measured wear.

    Takes one test or several that differ from CASE, repeated or not. Prints estimates with
    intervals, how each measured value is met, what the data cannot tell, and what else the fitted
    case gives. Of several cases, with other laws say, it says for which the data speak.

    \b
    Examples:
      tribo calibrate my.toml --measured weighed.toml -o fitted.toml
      tribo calibrate archard.toml power.toml --measured weighed.toml
      tribo calibrate my.toml --measured planned.toml --plan 0.1
    """
    from tribo.config.load import read_toml
    from tribo.config.overrides import apply_settings
    from tribo.config.write import to_toml
    from tribo.core.errors import CaseError
    from tribo.core.files import write_whole
    from tribo.study.calibration.calibrate import calibrate
    from tribo.study.calibration.choice import choose_case
    from tribo.study.calibration.measured import read_measurements
    from tribo.study.calibration.plan import plan_tests

    asked = read_measurements(measured)
    alternatives = {path.stem: apply_settings(read_toml(path), overrides) for path in cases}
    if sample and (len(cases) > 1 or asked.map or plan is not None):
        raise CaseError("--sample is for one case fitted to [[measured]], without --plan")
    if len(cases) > 1:
        if output is not None or plan is not None or len(alternatives) < len(cases):
            raise CaseError(
                "several cases are compared: give files of different names, and --plan or -o with "
                "one case only"
            )
        _choice(
            choose_case(
                alternatives,
                asked,
                level=level,
                on_run=lambda name, *run: _tell(f"{name}, run", *run),
            ),
            as_json,
        )
        return
    case, tables = cases[0], alternatives[cases[0].stem]
    if asked.map:
        _maps(tables, asked, level, output, force, as_json)
        return
    if plan is not None:
        _plan(plan_tests(tables, asked, plan, level=level, on_run=partial(_tell, "run")), as_json)
        return
    files = _files(output, list(dict.fromkeys(test.name for test in asked.tests.values())), force)
    told = _Told(asked, sample or 0)
    found = calibrate(tables, asked, level=level, sample=sample or 0, on_run=told)
    written = [files[name] for name in found.fitted if output is not None]
    for name, path in zip(found.fitted, written, strict=False):
        write_whole(path, to_toml(found.fitted[name]))
    if output is not None:
        from tribo.plotting.curves import fit_picture
        from tribo.plotting.figures import write_figures

        picture = files[PICTURE]
        write_figures({picture.stem: lambda: fit_picture(found.data)}, picture.parent)
    if as_json:
        echo_json(found.as_json())
        return
    console = Console()
    console.print(estimates_table(found))
    console.print(data_table(found))
    if len(found.predictions):
        console.print(predictions_table(found))
    for line in judgement(found):
        console.print(line, markup=False)
    for note in found.notes:
        console.print(f"[yellow]Note:[/] {escape(note)}")
    if output is not None:
        click.echo(f"Wrote {files[PICTURE]}")
        for path in written:
            click.echo(f"Run it: tribo run {shlex.quote(str(path))}")
        return
    settings = [*overrides, *(f"{path}={value:.4g}" for path, value in found.settings.items())]
    options = " ".join(f"--set {shlex.quote(setting)}" for setting in settings)
    click.echo(f"Run it: tribo run {shlex.quote(str(case))} {options}")


def _maps(
    tables: dict[str, Any],
    asked: Measurements,
    level: float,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fit local coefficients to depth maps."""
    from tribo.cli.fitted_maps import check_free, maps_json, print_maps, write_maps
    from tribo.study.calibration.mapped import calibrate_maps

    check_free(output, force)
    mapped = {f"map.{i}": entry for i, entry in enumerate(asked.map)}
    found = calibrate_maps(tables, mapped, on_run=partial(_tell, "run and pass back"))
    if as_json:
        echo_json(maps_json(found, level))
    else:
        print_maps(found, level)
    if output is not None:
        write_maps(found, level, output)


def _files(output: Path | None, names: list[str], force: bool) -> dict[str, Path]:
    """Return the file of each test's fitted case, and that of the picture."""
    from tribo.core.errors import CaseError
    from tribo.core.files import check_folder
    from tribo.study.runs import file_names

    if output is None:
        return {}
    check_folder(output)
    files = {"": output, PICTURE: output.with_name(f"{output.stem}-fit.png")}
    for name, file in zip(names, file_names(names), strict=True):
        if name:
            files[name] = output.with_name(f"{output.stem}-{Path(file).stem}.toml")
    for path in (files[name] for name in [*names, PICTURE]):
        if path.exists() and not force:
            raise CaseError(f"{path} exists; choose another name, or replace it with --force")
    return files


def _plan(found: Plan, as_json: bool) -> None:
    """Print how many tests of each kind there are to be."""
    if as_json:
        echo_json(found.as_json())
        return
    names = [each or "the case as it is" for each in found.tests["test"]]
    count = int(found.tests["count"].sum())
    table = _table("Tests", names, "how many")
    for name, each in zip(names, found.tests.itertuples(), strict=True):
        table.add_row(name, str(each.count))
    parameters = _table(
        "Expected", list(found.parameters["path"]), f"{100 * found.level:g} % interval"
    )
    for each in found.parameters.itertuples():
        parameters.add_row(each.path, f"±{percent(each.half_width)} %")
    console = Console()
    part = f"±{percent(found.within)} %"
    console.print(f"{count} test{'s' * (count != 1)} give intervals within {part}.")
    console.print(table)
    console.print(parameters)


def _choice(found: Choice, as_json: bool) -> None:
    """Print what the data say of several cases."""
    if as_json:
        echo_json(found.as_json())
        return
    console, names = Console(), list(found.cases["case"])
    columns = ["criterion", "weight", "left out", "χ²", "to spare", "parameters"]
    table = _table("Cases", names, *columns)
    for each in found.cases.itertuples():
        own = found.calibrations[each.case]
        left_out = "" if math.isnan(each.left_out) else f"{each.left_out:.1f}"
        table.add_row(
            each.case,
            f"{each.bic:.1f}",
            f"{each.weight:.2g}",
            left_out,
            f"{own.chi_square:.3g}",
            str(own.degrees_of_freedom),
            str(each.parameters),
        )
    console.print(table)
    for name in names:
        console.print(f"\n{escape(name)}")
        console.print(estimates_table(found.calibrations[name]))
    console.print(f"In short: {escape(found.verdict)}.")


def _tell(what: str, run: int, misfit: float = math.nan, left: float = 0.0) -> None:
    told = "" if math.isnan(misfit) else f": misfit χ² {misfit:.3g}"
    more = f", {left:.0f} s left at least" if left >= 1 else ""
    click.echo(f"{what} {run}{told}{more}", err=True)


class _Told:
    """Tell of runs, and how long those that are needed at least will take."""

    def __init__(self, asked: Measurements, sample: int) -> None:
        tests = asked.tests.values()
        measured = {entry.body for test in tests for entry in test.measured}
        self._fewest = len({repr(test.set) for test in tests}) * (
            2 + (len(asked.fit) or len(measured)) + sample
        )
        self._began, self._pause, self._last = time.monotonic(), bool(sample), -math.inf

    def __call__(self, run: int, misfit: float) -> None:
        if self._pause and time.monotonic() - self._last < PAUSE:
            return
        self._last = time.monotonic()
        _tell("run", run, misfit, (self._fewest - run) * (self._last - self._began) / run)


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


def estimates_table(found: Calibration) -> Table:
    """Return the parameters with their intervals."""
    names, level = list(found.parameters["path"]), f"{100 * found.level:g} % interval"
    columns = ["estimate", level, "", "resolution"]
    if is_sampled := "sampled_lower" in found.parameters:
        columns.append("sampled interval")
    table = _table(f"Fitted in {found.runs} runs", names, *columns)
    for each in found.parameters.itertuples():
        ends, relative = _interval(each, f"{each.lower:.3g}", f"{each.upper:.3g}")
        resolution = f"±{percent(each.resolution_limit)} %" if each.resolution_limit else ""
        if each.held:
            ends = "held by its bound"
        value = in_si(each.value, each.unit)
        if each.limited:
            value, ends = f"below {in_si(each.upper, each.unit)}", "upper bound"
        if each.held or each.limited or math.isinf(each.upper):
            relative = resolution = ""
        more = [f"{each.sampled_lower:.3g} to {each.sampled_upper:.3g}"] if is_sampled else []
        table.add_row(each.path, value, ends, relative, resolution, *more)
    return table


def data_table(found: Calibration) -> Table:
    """Return what was measured, and how the fit meets it."""
    names = [_name(each) for each in found.data.itertuples()]
    table = _table("Measured", names, "value", "uncertainty", "computed", "residual")
    for name, each in zip(names, found.data.itertuples(), strict=True):
        values = (each.measured, each.sigma, each.computed)
        shown = [in_words(each.quantity, value) for value in values]
        if each.below:
            shown[0] = f"< {shown[0]}"
        table.add_row(name, *shown, signed(each.residual, 1))
    return table


def predictions_table(found: Calibration) -> Table:
    """Return what else the fitted case gives."""
    names = [_name(each) for each in found.predictions.itertuples()]
    level = f"{100 * found.level:g} % interval"
    table = _table("Not measured, at the end", names, "computed", level, "")
    for name, each in zip(names, found.predictions.itertuples(), strict=True):
        value, low, high = (
            in_words(each.quantity, value) for value in (each.value, each.lower, each.upper)
        )
        table.add_row(name, value, *_interval(each, low.split()[0], high))
    return table


def judgement(found: Calibration) -> Iterator[str]:
    """Say how good the fit is, and how well the data tell the parameters apart."""
    if found.p_value is not None:
        yield (
            f"χ² {found.chi_square:.3g} with {found.degrees_of_freedom} to spare, "
            f"p = {found.p_value:.2g}."
        )
    if found.repeatability or found.repeatability_estimated:
        how = "estimated" if found.repeatability_estimated else "as stated"
        yield f"Repeatability, {how}: ±{percent(found.repeatability)} % from test to test."
    best, worst = (_known(found.singular_values[i]) for i in (0, -1))
    if len(found.parameters) > 1:
        yield (
            f"Of all combinations of these numbers the best known by the data is known {best}, "
            f"the least known {worst} (one standard deviation)."
        )
    paths = list(found.parameters["path"])
    for i, first in enumerate(paths):
        for j, second in enumerate(paths[:i]):
            both = signed(found.correlation[i, j], 2)
            yield f"Correlation of {second} and {first}: {both}."


def _known(singular_value: float) -> str:
    """Say how well the data tell a combination of parameters."""
    if singular_value < BLIND:
        return "not at all"
    spread = 1 / singular_value
    return f"to {percent(spread)} %" if spread < 1 else f"to a factor {math.exp(spread):.2g}"


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
    if row.upper > FAR * row.value:
        return f"{low} to {high}", ""
    below, above = percent(1 - row.lower / row.value), percent(row.upper / row.value - 1)
    return f"{low} to {high}", f"±{above} %" if below == above else f"−{below} +{above} %"
