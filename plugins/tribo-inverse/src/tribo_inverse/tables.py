"""Tables and sentences that `tribo calibrate` prints of fitted parameters."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from rich.markup import escape
from rich.table import Table
from tribo.kernel_api import Console, digits_of, signed, titled

from tribo_inverse.calibration.calibrate import Calibration
from tribo_inverse.calibration.choice import Choice
from tribo_inverse.calibration.plan import Plan
from tribo_inverse.calibration.quantities import in_si, in_words, p_words, percent, row_name
from tribo_inverse.findings import bound

FAR = 10.0
"""Ratio of an interval's end to the value above which no percentage is printed."""
BLIND = 0.2
"""Singular value of the Jacobian below which a combination of parameters is unknown."""
LONGEST_NAME = 30
"""Characters of a name that fit in a table of 80 columns."""


def print_fit(found: Calibration) -> None:
    """Print estimates, residuals, predictions, the goodness of fit and notes."""
    console = Console()
    console.print(estimates_table(found))
    console.print(data_table(found))
    if len(found.predictions):
        console.print(predictions_table(found))
    for line in fit_sentences(found):
        console.print(line, markup=False)
    for note in found.notes:
        console.print(f"[yellow]Note:[/] {escape(note)}")


def print_plan(found: Plan) -> None:
    """Print the number of tests of each kind, and the intervals expected."""
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


def print_choice(found: Choice) -> None:
    """Print the comparison of several cases, and the estimates of each."""
    console, names = Console(), list(found.cases["case"])
    columns = ["criterion", "weight", "left out", "χ²", "d.o.f.", "parameters"]
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
    console.print(
        "criterion: Schwarz's, the lower the better; weight: the probability that follows from it; "
        "left out: ln of the probability of each test predicted from the others, the higher the "
        "better."
    )
    for name in names:
        console.print(f"\n{escape(name)}")
        console.print(estimates_table(found.calibrations[name]))
    console.print(f"In short: {escape(found.verdict)}.")


def _table(title: str, names: list[str], *columns: str) -> Table:
    """Return a table that wraps names and intervals between words, and never wraps values."""
    table = titled(title)
    table.pad_edge, table.collapse_padding = False, True
    longest = max((len(word) for name in names for word in name.split()), default=0)
    whole = longest <= LONGEST_NAME and not any(" " in name for name in names)
    width = None if whole else min(longest, LONGEST_NAME)
    table.add_column("", overflow="fold", no_wrap=whole, min_width=width)
    for column in columns:
        is_interval = column == "relative" or column.endswith("interval")
        table.add_column(column, justify="right", overflow="fold", no_wrap=not is_interval)
    return table


def estimates_table(found: Calibration) -> Table:
    """Return the parameters with their intervals."""
    names, level = list(found.parameters["path"]), f"{100 * found.level:g} % interval"
    columns = ["estimate", level, "relative"]
    table = _table(f"Fitted in {found.runs} runs", names, *columns)
    for each in found.parameters.itertuples():
        digits = digits_of(each.lower, each.upper)
        ends, relative = _interval(each, f"{each.lower:.{digits}g}", f"{each.upper:.{digits}g}")
        if each.held:
            ends = f"held by its {bound(each)} bound"
        value = in_si(each.value, each.unit, digits)
        if each.limited:
            value, ends = f"below {in_si(each.upper, each.unit)}", "upper bound"
        if each.held or each.limited or math.isinf(each.upper):
            relative = ""
        table.add_row(each.path, value, ends, relative)
    return table


def data_table(found: Calibration) -> Table:
    """Return the measured values with their computed values and residuals."""
    data = list(found.brief.itertuples())
    names = [_name(each) for each in data]
    table = _table("Measured", names, "value", "uncertainty", "computed", "residual")
    for name, each in zip(names, data, strict=True):
        values = (each.measured, each.sigma, each.computed)
        shown = [in_words(each.quantity, value) for value in values]
        if each.below:
            shown[0] = f"< {shown[0]}"
        many = each.depths > 1
        residual = f"rms {each.residual:.1f}" if many else signed(each.residual, 1)
        table.add_row(name, *shown, residual)
    return table


def predictions_table(found: Calibration) -> Table:
    """Return the predictions of the fitted case."""
    names = [row_name(each) for each in found.predictions.itertuples()]
    level = f"{100 * found.level:g} % interval"
    table = _table("Not measured, at the end", names, "computed", level, "relative")
    for name, each in zip(names, found.predictions.itertuples(), strict=True):
        value, low, high = (
            in_words(each.quantity, value, digits_of(each.lower, each.upper))
            for value in (each.value, each.lower, each.upper)
        )
        table.add_row(name, value, *_interval(each, low.split()[0], high))
    return table


def fit_sentences(found: Calibration) -> Iterator[str]:
    """Return sentences on the goodness of fit, the repeatability and the correlations."""
    if found.p_value is not None:
        freedom = found.degrees_of_freedom
        yield (
            f"χ² {found.chi_square:.3g} with {freedom} degree{'s' * (freedom != 1)} of freedom, "
            f"{p_words(found.p_value)}."
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
    """Return the standard deviation of a combination of parameters in words."""
    if singular_value < BLIND:
        return "not at all"
    spread = 1 / singular_value
    return f"to {percent(spread)} %" if spread < 1 else f"to a factor {math.exp(spread):.2g}"


def _name(row: Any) -> str:
    """Return the name of a row of the data, with the shift of a map's scar."""
    if row.depths == 1:
        return row_name(row)
    shift = np.nan_to_num([getattr(row, f"shift_{axis}_m", 0.0) for axis in "xy"])
    far = " and ".join(signed(1e6 * each, 1) for each in shift)
    return f"{row_name(row)}, mean{f', off centre by {far} µm' if any(shift) else ''}"


def _interval(row: Any, low: str, high: str) -> tuple[str, str]:
    """Return the interval of a row, and the same relative to the value unless it is open."""
    if row.lower == row.upper:
        return "not fitted", ""
    if math.isinf(row.upper):
        return f"{low} to open" if row.lower else "open", ""
    if row.upper > FAR * row.value:
        return f"{low} to {high}", ""
    below, above = percent(1 - row.lower / row.value), percent(row.upper / row.value - 1)
    return f"{low} to {high}", f"±{above} %" if below == above else f"−{below} +{above} %"
