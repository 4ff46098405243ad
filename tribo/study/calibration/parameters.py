"""Which numbers of a case are fitted, and within what bounds."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel

from tribo.case import Case
from tribo.config.overrides import path_keys, quantities
from tribo.core.errors import CaseError, located
from tribo.core.units import Quantity
from tribo.core.words import did_you_mean, shown, suggestion
from tribo.study.calibration.measured import Fitted, Measured

WITHIN = 1e-9
"""How far within an open bound a parameter stays, relative."""


@dataclass(frozen=True)
class Parameter:
    """A positive number of a case that is fitted.

    Parameters
    ----------
    path : str
        Where it stands in the case.
    unit : str
        Its SI unit; ``"1"`` for none.
    start, lower, upper : float
        Where the fit begins, and its bounds, in SI; 0 and infinity for none.
    """

    path: str
    unit: str
    start: float
    lower: float
    upper: float


def find_parameters(
    case: Case, fit: Sequence[Fitted], measured: Sequence[Measured]
) -> list[Parameter]:
    """Return the parameters that are asked for, or else the k of each measured body.

    Raises
    ------
    CaseError
        If a path does not lead to a positive number, one is given twice, or
        bounds and start do not fit; the message says where.
    """
    places = [f"fit[{i}]" for i in range(len(fit))]
    if not fit:
        fit = [Fitted(path=path) for path in _coefficients(case, measured)]
        places = ["fit"] * len(fit)
    found: dict[tuple[str, ...], Parameter] = {}
    for place, entry in zip(places, fit, strict=True):
        with located(f"{place}.path"):
            keys = tuple(path_keys(entry.path))
            if keys in found:
                raise CaseError(f"{entry.path!r} is given twice")
            value, mark = _number(case, keys)
        found[keys] = _bounded(place, entry, value, mark)
    return list(found.values())


def _coefficients(case: Case, measured: Sequence[Measured]) -> list[str]:
    bodies = {entry.body for entry in measured}
    paths = [
        f"bodies.{name}.wear.k"
        for name, body in case.bodies.items()
        if name in bodies and getattr(body.wear, "k", None) is not None
    ]
    if not paths:
        raise CaseError(
            "no measured body has a wear coefficient k; say what to fit, as [[fit]] with path = "
            '"bodies.ball.wear.K"',
            "fit",
        )
    return paths


def _number(case: Case, keys: Sequence[str]) -> tuple[float, Quantity]:
    """Return the number that the keys lead to, and what is said of it."""
    value: Any = case
    annotation: Any = None
    for depth, key in enumerate(keys):
        if isinstance(value, BaseModel):
            known: Sequence[str] = list(type(value).model_fields)
        elif isinstance(value, Mapping):
            known = list(value)
        elif isinstance(value, tuple):
            known = [str(i) for i in range(len(value))]
        else:
            raise CaseError(f"{'.'.join(keys[:depth])} is {_kind(value)} in this case, no table")
        if key not in known:
            raise CaseError(
                f"{'.'.join(keys)}: unknown key {key!r}{suggestion(did_you_mean(key, known))} "
                f"Allowed: {', '.join(known) or 'none'}"
            )
        if isinstance(value, BaseModel):
            field = type(value).model_fields[key]
            annotation, value = (field.annotation, *field.metadata), getattr(value, key)
        elif isinstance(value, Mapping):
            value = value[key]
        else:
            value = value[int(key)]
    if not isinstance(value, float):
        raise CaseError(
            f"{'.'.join(keys)} is {_kind(value)} in this case; only a number with decimals can be "
            "fitted"
        )
    return value, next(quantities(annotation), Quantity("1"))


def _kind(value: object) -> str:
    if value is None:
        return "not given"
    return "a table" if isinstance(value, BaseModel) else shown(value)


def _bounded(place: str, entry: Fitted, value: float, mark: Quantity) -> Parameter:
    positive = Quantity(mark.unit, above=0, below=mark.below, at_most=mark.at_most)

    def read(name: str, given: float | str | None, default: float) -> float:
        if given is None:
            return default
        with located(f"{place}.{name}"):
            return positive.read(given)

    start = read("start", entry.start, value)
    if start <= 0:
        raise CaseError(
            f"{entry.path} is {start:g} in this case; parameters are fitted on a logarithmic "
            "scale, so give a start above 0",
            f"{place}.start",
        )
    # A run needs a value within bounds that a field does not take themselves.
    above = None if mark.above is None else mark.above + WITHIN * abs(mark.above)
    below = None if mark.below is None else mark.below - WITHIN * abs(mark.below)
    least = max(b for b in (above, mark.at_least, 0.0) if b is not None)
    most = min(b for b in (below, mark.at_most, math.inf) if b is not None)
    lower, upper = read("lower", entry.lower, least), read("upper", entry.upper, most)
    if not (lower <= start <= upper and lower < upper):
        raise CaseError(
            f"the start, {start:g}, must lie between lower, {lower:g}, and upper, {upper:g}", place
        )
    return Parameter(entry.path, mark.unit, start, lower, upper)
