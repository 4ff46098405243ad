"""`tribo calibrate`."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Iterator
from pathlib import Path

import click
from rich import box
from rich.markup import escape
from rich.table import Table

from tribo.cli.console import Console
from tribo.study.calibration.outcome import Calibration, Datum, Estimate, Expected
from tribo.study.calibration.quantities import PROFILES, in_si, in_words, percent

LONGEST_NAME = 30
"""Characters of a name that a table for 80 columns has room for."""


@click.command()
@click.argument("case", type=click.Path(path_type=Path))
@click.option(
    "--measured",
    required=True,
    type=click.Path(path_type=Path),
    help="What was measured, and what to fit: a TOML file.",
)
@click.option("--set", "overrides", multiple=True, metavar="PATH=VALUE", help="Change a value.")
@click.option(
    "--level", type=float, default=0.95, show_default=True, help="Probability of the intervals."
)
@click.option("--json", "as_json", is_flag=True, help="One JSON object, in SI units.")
def calibrate(
    case: Path, measured: Path, overrides: tuple[str, ...], level: float, as_json: bool
) -> None:
    """Fit CASE's wear coefficients, or other numbers of it, to measured wear.

    Prints estimates with intervals, how each measured value is met, what the data cannot tell, and
    what else the fitted case gives.

    \b
    Example:
      tribo calibrate my.toml --measured weighed.toml
    """
    from tribo.config.load import read_toml
    from tribo.config.overrides import apply_settings
    from tribo.study import calibrate

    found = calibrate(
        apply_settings(read_toml(case), overrides), measured, level=level, on_run=_tell
    )
    if as_json:
        click.echo(json.dumps(found.as_json(), indent=2, allow_nan=False))
        return
    console = Console(highlight=False)
    console.print(_estimates(found))
    console.print(_data(found))
    if found.predictions:
        console.print(_predictions(found))
    for line in _judgement(found):
        console.print(line)
    settings = [*overrides, *(f"{path}={value:.4g}" for path, value in found.settings.items())]
    options = " ".join(f"--set {shlex.quote(setting)}" for setting in settings)
    click.echo(f"Run it: tribo run {shlex.quote(str(case))} {options}")


def _tell(run: int, misfit: float) -> None:
    click.echo(f"run {run}: misfit χ² {misfit:.3g}", err=True)


def _table(title: str, names: list[str], *columns: str) -> Table:
    """Return a table that breaks intervals between words, but no values.

    Names are broken between words, and only very long words within.
    """
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    table.pad_edge, table.collapse_padding = False, True
    longest = max((len(word) for name in names for word in name.split()), default=0)
    one_word = not any(" " in name for name in names)
    table.add_column(
        "",
        overflow="fold",
        no_wrap=one_word and longest <= LONGEST_NAME,
        min_width=None if one_word else min(longest, LONGEST_NAME),
    )
    for column in columns:
        is_interval = column == "" or column.endswith("interval")
        table.add_column(column, justify="right", overflow="fold", no_wrap=not is_interval)
    return table


def _estimates(found: Calibration) -> Table:
    names = [each.path for each in found.parameters]
    table = _table(
        f"Fitted in {found.runs} runs", names, "estimate", _at_level(found), "", "resolution"
    )
    for each in found.parameters:
        table.add_row(
            each.path,
            in_si(each.value, each.unit),
            "held by its bound"
            if each.held
            else _interval(each, f"{each.lower:.3g}", f"{each.upper:.3g}"),
            "" if each.held else _relative(each),
            _resolution(each),
        )
    return table


def _data(found: Calibration) -> Table:
    names = [_name(each) for each in found.data]
    table = _table("Measured", names, "value", "uncertainty", "computed", "residual")
    for each, name in zip(found.data, names, strict=True):
        table.add_row(
            name,
            in_words(each.quantity, each.measured),
            in_words(each.quantity, each.sigma),
            in_words(each.quantity, each.computed),
            f"{round(each.residual, 1) + 0.0:+.1f}",
        )
    return table


def _predictions(found: Calibration) -> Table:
    names = [_name(each) for each in found.predictions]
    table = _table("Not measured, at the end", names, "computed", _at_level(found), "")
    for each, name in zip(found.predictions, names, strict=True):
        low = in_words(each.quantity, each.lower).split()[0]
        table.add_row(
            name,
            in_words(each.quantity, each.value),
            _interval(each, low, in_words(each.quantity, each.upper)),
            _relative(each),
        )
    return table


def _judgement(found: Calibration) -> Iterator[str]:
    if found.p_value is not None:
        yield (
            f"χ² {found.chi_square:.3g} with {found.degrees_of_freedom} to spare, "
            f"p = {found.p_value:.2g}."
        )
    values = ", ".join(f"{value:.3g}" for value in found.singular_values)
    yield f"Standard deviations by which a change by a factor e would show: {values}."
    for i, first in enumerate(found.parameters):
        for j, second in enumerate(found.parameters[:i]):
            yield (
                f"Correlation of {second.path} and {first.path}: "
                f"{round(found.correlation[i, j], 2) + 0.0:+.2f}."
            )
    for note in found.notes:
        yield f"[yellow]Note:[/] {escape(note)}"


def _name(each: Datum | Expected) -> str:
    text = f"{each.body}, {each.quantity}"
    if isinstance(each, Datum) and each.time is not None:
        text += f" at {each.time:g} s"
    if isinstance(each, Datum) and each.quantity in PROFILES and each.position is not None:
        text += f" at {1e3 * each.position:g} mm"
    return text


def _at_level(found: Calibration) -> str:
    return f"{100 * found.level:g} % interval"


def _interval(each: Estimate | Expected, low: str, high: str) -> str:
    if math.isinf(each.upper):
        return f"{low} to open" if each.lower else "open"
    return f"{low} to {high}"


def _resolution(each: Estimate) -> str:
    if not each.resolution_limit or each.held or math.isinf(each.upper):
        return ""
    return f"±{percent(each.resolution_limit)} %"


def _relative(each: Estimate | Expected) -> str:
    if math.isinf(each.upper):
        return ""
    below, above = percent(1 - each.lower / each.value), percent(each.upper / each.value - 1)
    return f"±{above} %" if below == above else f"−{below} +{above} %"
