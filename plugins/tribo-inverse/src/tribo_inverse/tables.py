"""Tables that `tribo calibrate` prints for fitted parameters."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from rich.markup import escape
from tribo import Finding
from tribo.kernel_api import Console, DataTable, Heading, TableRow, digits_of, signed

from tribo_inverse.calibration.quantities import in_si, in_words, p_words, percent, row_name
from tribo_inverse.findings import bound

if TYPE_CHECKING:
    from tribo_inverse.calibration.calibrate import Calibration
    from tribo_inverse.calibration.choice import Choice
    from tribo_inverse.calibration.plan import Plan

LONGEST_NAME = 30
"""Characters of a name that fit in a table of 80 columns."""
PER_NM = "mm³/(N·m)"
BROKEN = "interval"
"""End of the headings of columns of intervals."""


def print_all(
    tables: Iterable[DataTable], findings: Iterable[Finding] = (), console: Console | None = None
) -> None:
    """Print tables, and findings as warnings."""
    console = console or Console()
    for table in tables:
        console.table(table)
    for each in findings:
        console.print(f"[yellow]Warning:[/] {escape(each.words)}")


def fit_tables(found: Calibration) -> list[DataTable]:
    """Return the estimates, residuals, predictions and the goodness of fit."""
    tables = estimates_table(found), data_table(found), predictions_table(found)
    return [table for table in (*tables, quality_table(found)) if table.rows]


def plan_tables(found: Plan) -> list[DataTable]:
    """Return the number of tests of each kind, the intervals expected, and what a test measures."""
    names = [each or "the case as it is" for each in found.tests["test"]]
    counts = list(map(int, found.tests["count"]))
    level = f"{100 * found.level:g} % interval"
    paths = list(found.parameters["path"])
    ends = [f"±{percent(each)} %" for each in found.parameters["half_width"]]
    count, part = sum(counts), f"±{percent(found.within)} %"
    note = f"{count} test{'s' * (count != 1)} give intervals within {part}."
    computed = (
        (row_name(each), in_words(each.quantity, each.computed))
        for each in found.readings.itertuples()
    )
    return [
        _table("Tests to make", ["number"], zip(names, counts, strict=True), note),
        _table("Expected intervals", [level], zip(paths, ends, strict=True)),
        _table("One test measures, by the case", ["computed"], computed),
    ]


def choice_tables(found: Choice) -> list[DataTable]:
    """Return the comparison of several cases, and the estimates of each."""
    rows = []
    columns = ["criterion", "weight", "χ²", "d.o.f.", "parameters"]
    for each in found.cases.itertuples():
        own = found.calibrations[each.case]
        fit = f"{own.chi_square:.3g}", own.degrees_of_freedom
        odds = f"{each.bic:.1f}", f"{each.weight:.2g}"
        rows.append((each.case, *odds, *fit, each.parameters))
    note = (
        "criterion: Schwarz's, the lower the better; weight: the probability that follows from it."
    )
    estimates = (
        replace(table, title=f"{name}: {table.title}")
        for name in found.cases["case"]
        for table in [estimates_table(found.calibrations[name])]
    )
    verdict = f"In short: {found.verdict}."
    return [_table("Cases", columns, rows, note, verdict), *estimates]


def _table(
    title: str, columns: Sequence[str], rows: Iterable[tuple[Any, ...]], *notes: str
) -> DataTable:
    """Return a table that breaks long names and intervals between words, and no other values."""
    lines = list(map(TableRow, rows))
    names = [str(line.values[0]) for line in lines]
    whole = not any(" " in name or len(name) > LONGEST_NAME for name in names)
    headings = [Heading(column, whole=not column.endswith(BROKEN)) for column in columns]
    return DataTable(title, (Heading("", whole=whole), *headings), lines, notes, dense=True)


def estimates_table(found: Calibration) -> DataTable:
    """Return the parameters with their intervals."""
    rows, columns = [], _columns("estimate", found)
    for each in found.parameters.itertuples():
        digits = digits_of(each.lower, each.upper)
        ends, relative = _interval(each, f"{each.lower:.{digits}g}", f"{each.upper:.{digits}g}")
        if each.held:
            ends = f"held by its {bound(each)} bound"
        value = in_si(each.value, each.unit, digits)
        if each.held or math.isinf(each.upper):
            relative = ""
        rows.append((each.path, value, ends, relative))
        if each.unit == "1/Pa":
            rows.append(_per_newton_metre(each, digits))
    return _table(f"Fitted numbers, by {found.runs} runs", columns, rows)


def _per_newton_metre(each: Any, digits: int) -> tuple[str, str, str, str]:
    """Return a specific wear rate with its interval in the unit of laboratories' tables."""
    lower, value, upper = (f"{1e9 * x:.{digits}g}" for x in (each.lower, each.value, each.upper))
    ends = "" if each.held else _interval(each, lower, upper)[0]
    return "", f"{value} {PER_NM}", ends, ""


def data_table(found: Calibration) -> DataTable:
    """Return the measured values with their computed values and residuals."""
    rows = []
    for each in found.data.itertuples():
        values = (each.measured, each.sigma, each.computed)
        shown = [in_words(each.quantity, value) for value in values]
        rows.append((row_name(each), *shown, signed(each.residual, 1)))
    columns = ["value", "uncertainty", "computed", "residual, σ"]
    return _table("Measured values, with standard uncertainties", columns, rows)


def predictions_table(found: Calibration) -> DataTable:
    """Return the predictions of the fitted case."""
    rows, columns = [], _columns("computed", found)
    for each in found.predictions.itertuples():
        value, low, high = (
            in_words(each.quantity, value, digits_of(each.lower, each.upper))
            for value in (each.value, each.lower, each.upper)
        )
        rows.append((row_name(each), value, *_interval(each, low.split()[0], high)))
    return _table("Predictions for the end of the test", columns, rows)


def quality_table(found: Calibration) -> DataTable:
    """Return the goodness of fit, the repeatability, and what the data know of the numbers."""
    rows: list[tuple[str, str]] = []
    if found.p_value is not None:
        rows.append(("χ²", f"{found.chi_square:.3g}"))
        rows.append(("degrees of freedom", str(found.degrees_of_freedom)))
        rows.append(("probability of a larger χ²", p_words(found.p_value)[2:].removeprefix("= ")))
    if found.repeatability or found.repeatability_estimated:
        how = "estimated" if found.repeatability_estimated else "stated"
        spread = f"{percent(found.repeatability)} %"
        rows.append((f"standard deviation from test to test, {how}", spread))
    paths = list(found.parameters["path"])
    for i, first in enumerate(paths):
        for j, second in enumerate(paths[:i]):
            both = signed(found.correlation[i, j], 2)
            rows.append((f"correlation of {second} and {first}", both))
    return _table("Quality of the fit", ["value"], rows)


def _columns(value: str, found: Calibration) -> list[str]:
    return [value, f"{100 * found.level:g} % interval", "relative"]


def _interval(row: Any, low: str, high: str) -> tuple[str, str]:
    """Return the interval of a row, and the interval relative to the value unless it is open."""
    if row.lower == row.upper:
        return "not fitted", ""
    if math.isinf(row.upper):
        return f"{low} to open" if row.lower else "open", ""
    below, above = percent(1 - row.lower / row.value), percent(row.upper / row.value - 1)
    return f"{low} to {high}", f"±{above} %" if below == above else f"−{below} +{above} %"
