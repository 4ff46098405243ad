"""The parameters that are fitted, and their bounds."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from tribo import Case, CaseError, Quantity
from tribo.kernel_api import did_you_mean, leaves, located, path_keys, shown, suggestion

from tribo_inverse.calibration.measured import FitEntry

WITHIN = 1e-9
"""Relative distance that a parameter keeps from an open bound."""


class Parameter(NamedTuple):
    """A positive number of a case that is fitted."""

    path: str
    unit: str
    start: float
    lower: float
    upper: float
    """The bounds are 0 and infinity for none."""


def find_parameters(
    case: Case, fit: Sequence[FitEntry], measured: Collection[str]
) -> list[Parameter]:
    """Return the parameters in `fit`, or by default the k of each body in `measured`."""
    asked = [(f"fit.{i}", entry) for i, entry in enumerate(fit, 1)]
    if not fit:
        of_bodies = [f"bodies.{name}.wear.k" for name in case.bodies if name in measured]
        asked = [("fit", FitEntry(path=path)) for path in of_bodies if is_number(case, path)]
    if not asked:
        raise CaseError(
            "no measured body has a wear coefficient k; say what to fit, as [[fit]] with path "
            '= "bodies.ball.wear.K"',
            "fit",
        )
    found: dict[tuple[str, ...], Parameter] = {}
    for place, entry in asked:
        with located(f"{place}.path"):
            keys = tuple(path_keys(entry.path))
            if keys in found:
                raise CaseError(f"{entry.path!r} is given twice")
            value, mark = _number(case, keys)
        found[keys] = _bounded(place, entry, value, mark)
    return list(found.values())


def check_set(parameters: Sequence[Parameter], paths: Iterable[str], place: str) -> None:
    """Check that no test sets a parameter, or a table around it; CaseError if one does."""
    for path in paths:
        keys = path_keys(path)
        # Another type has other parameters.
        whole = keys[:-1] if keys[-1] == "type" else keys
        for each in parameters:
            if path_keys(each.path)[: len(whole)] == whole:
                raise CaseError(
                    f"{path} is given, and {each.path} is fitted, one value for all tests: leave "
                    "one of them out",
                    place,
                )


def is_number(case: Case, path: str) -> bool:
    """Whether a case has a real number at a path; CaseError if it is no path."""
    value, _ = _leaves(case).get(tuple(path_keys(path)), (None, None))
    return isinstance(value, float)


def _leaves(case: Case) -> dict[tuple[str, ...], tuple[Any, Quantity | None]]:
    """Return the values of a case and their `Quantity` annotations, by their keys."""
    return {tuple(map(str, place)): (value, mark) for place, value, mark in leaves(case)}


def _number(case: Case, keys: tuple[str, ...]) -> tuple[float, Quantity]:
    """Return the number at the keys, and its `Quantity`."""
    known = _leaves(case)
    value, mark = known.get(keys, (None, None))
    if not isinstance(value, float):
        numbers = [".".join(place) for place, (each, _) in known.items() if isinstance(each, float)]
        path, given = ".".join(keys), "not given" if value is None else shown(value)
        if any(place[: len(keys)] == keys for place in known.keys() - {keys}):
            given = "no physical number"
        raise CaseError(
            f"{path} is {given} in this case{suggestion(did_you_mean(path, numbers))} Only a "
            "number with decimals can be fitted"
        )
    return value, mark or Quantity("1")


def _bounded(place: str, entry: FitEntry, value: float, mark: Quantity) -> Parameter:
    """Return a parameter with the bounds given, within the bounds of its field."""
    above = max(mark.above or 0.0, 0.0)
    positive = mark if mark.at_least else replace(mark, above=above)

    def read(name: str, given: float | str | None, default: float) -> float:
        with located(f"{place}.{name}"):
            return default if given is None else positive.read(given)

    start = read("start", entry.start, value)
    if start <= 0:
        raise CaseError(
            f"{entry.path} is {start:g} in this case; parameters are fitted on a logarithmic "
            "scale, so give a start above 0",
            f"{place}.start",
        )
    # An open bound itself is no valid value, so stay inside.
    least = max(above * (1 + WITHIN), mark.at_least or 0.0)
    below = math.inf if mark.below is None else mark.below * (1 - WITHIN)
    most = below if mark.at_most is None else min(below, mark.at_most)
    lower, upper = read("lower", entry.lower, least), read("upper", entry.upper, most)
    if not (lower <= start <= upper and lower < upper):
        raise CaseError(
            f"the start, {start:g}, must lie between lower, {lower:g}, and upper, {upper:g}", place
        )
    return Parameter(entry.path, mark.unit, start, lower, upper)
