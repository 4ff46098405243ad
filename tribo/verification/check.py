"""A check: quantities with a known answer, computed at several levels of refinement."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Literal

import numpy as np

from tribo.core.errors import TriboError

Verdict = Literal["holds", "fails", "not installed"]
Found = Mapping[str, tuple[float, float]]

ORDER_MARGIN = 0.2


@dataclass(frozen=True)
class Quantity:
    """Something a check compares.

    Parameters
    ----------
    name : str
        As `Check.measure` calls it.
    unit : str
        SI unit of its values; "1" for ratios and norms.
    tolerance : float
        Largest error at the finest level.
    order : float, optional
        Theoretical order of convergence; it must be met within 0.2.
    note : str, optional
        What the error consists of, and why there is no order.
    """

    name: str
    unit: str
    tolerance: float
    order: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Check:
    """A case with a known answer.

    Parameters
    ----------
    case : str
        What is computed.
    source : str
        Where the answer comes from.
    measure : callable
        From a level and a placement in [0, 1) to (expected, got) by quantity.
        An expected 0 marks a norm of errors that is relative already.
    quantities : tuple of Quantity
        What is compared.
    levels : tuple of int
        Cells, steps or what else is refined, coarse to fine.
    placements : int, optional
        How many placements of the grid are tried; errors are the root mean
        square over them, since the edge of a contact falls anywhere in a cell.
    needs : tuple of str, optional
        Modules without which the check is left out.
    cost : float, optional
        About how long it takes, in s; for the time to go.
    """

    case: str
    source: str
    measure: Callable[[int, float], Found]
    quantities: tuple[Quantity, ...]
    levels: tuple[int, ...]
    placements: int = 1
    needs: tuple[str, ...] = ()
    cost: float = 1.0


@dataclass(frozen=True)
class Row:
    """One line of the table; `expected` and `got` in the SI unit `unit`.

    Errors are relative, except where 0 is expected.
    """

    case: str
    quantity: str
    unit: str
    expected: float | None
    got: float | None
    error: float | None
    tolerance: float
    order: float | None
    theory: float | None
    source: str
    verdict: Verdict
    note: str


def run_check(check: Check) -> list[Row]:
    """Compute a check at all its levels and judge its quantities."""
    if any(find_spec(name) is None for name in check.needs):
        return [_without_value(check, quantity, "not installed") for quantity in check.quantities]
    try:
        found = [
            [check.measure(level, k / check.placements) for k in range(check.placements)]
            for level in check.levels
        ]
    except Exception as error:
        # Another code may have changed, or be broken; tribo itself fails in its own ways only.
        if not check.needs and not isinstance(error, TriboError):
            raise
        return [_without_value(check, q, "fails", str(error)) for q in check.quantities]
    return [_judged(check, quantity, found) for quantity in check.quantities]


def observed_order(levels: tuple[int, ...], errors: list[float]) -> float | None:
    """Return the order at which errors fall, fitted to all levels; None for fewer than three."""
    if len(levels) < 3 or min(errors) <= 0:
        return None
    return -float(np.polyfit(np.log(levels), np.log(errors), 1)[0])


def _judged(check: Check, quantity: Quantity, found: list[list[Found]]) -> Row:
    errors = [_error([placed[quantity.name] for placed in level]) for level in found]
    expected, got = found[-1][0][quantity.name]
    holds, order = errors[-1] <= quantity.tolerance, None
    if quantity.order is not None:
        order = observed_order(check.levels, errors)
        holds = holds and order is not None and abs(order - quantity.order) <= ORDER_MARGIN
    return Row(
        case=check.case,
        quantity=quantity.name,
        unit=quantity.unit,
        expected=expected,
        got=got,
        error=errors[-1],
        tolerance=quantity.tolerance,
        order=order,
        theory=quantity.order,
        source=check.source,
        verdict="holds" if holds else "fails",
        note=quantity.note,
    )


def _error(pairs: list[tuple[float, float]]) -> float:
    relative = [got if expected == 0 else got / expected - 1 for expected, got in pairs]
    return float(np.sqrt(np.mean(np.square(relative))))


def _without_value(check: Check, quantity: Quantity, verdict: Verdict, note: str = "") -> Row:
    return Row(
        case=check.case,
        quantity=quantity.name,
        unit=quantity.unit,
        expected=None,
        got=None,
        error=None,
        tolerance=quantity.tolerance,
        order=None,
        theory=quantity.order,
        source=check.source,
        verdict=verdict,
        note=note or quantity.note,
    )
