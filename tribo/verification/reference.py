"""A problem with a known answer, and the rows of the table that compare with it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import Literal

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import TriboError

Verdict = Literal["holds", "fails", "not installed"]

ORDER_MARGIN = 0.2


@dataclass(frozen=True)
class Row:
    """One line of the table.

    A function of a `Reference` gives the first seven; `Reference.run` adds the others.

    Parameters
    ----------
    quantity : str
        What is compared.
    unit : str
        SI unit of its values; "1" for ratios and norms.
    expected, got : float or None
        Exact and computed value. An expected 0 marks an error, such as a norm, that is
        relative already.
    tolerance : float
        Largest error at the finest level.
    theory : float, optional
        Theoretical order of convergence; the observed one must be within 0.2 of it.
    note : str, optional
        What the error consists of, and why there is no order.
    case, source : str
        Those of the reference.
    error : float or None
        Relative; the root mean square over the placements of the grid.
    order : float or None
        Observed order of convergence.
    verdict : {"holds", "fails", "not installed"}
    """

    quantity: str
    unit: str
    expected: float | None
    got: float | None
    tolerance: float
    theory: float | None = None
    note: str = ""
    case: str = ""
    source: str = ""
    error: float | None = None
    order: float | None = None
    verdict: Verdict = "fails"


def norm(
    quantity: str,
    got: Array,
    expected: Array,
    tolerance: float,
    theory: float | None = None,
    note: str = "",
) -> Row:
    """Return the row of Σ|got − expected| / Σ|expected|."""
    error = float(np.sum(np.abs(got - expected)) / np.sum(np.abs(expected)))
    return Row(quantity, "1", 0.0, error, tolerance, theory, note)


@dataclass(frozen=True)
class Reference:
    """A problem with a known answer.

    Parameters
    ----------
    case : str
        What is computed.
    source : str
        Where the answer comes from.
    rows : callable
        From a level and a placement in [0, 1) to rows with `expected` and `got`.
    levels : tuple of int
        Cells, steps or what else is refined, coarse to fine.
    placements : int, optional
        How many placements of the grid are tried; errors are the root mean
        square over them, since the edge of a contact falls anywhere in a cell.
    needs : tuple of str, optional
        Modules of another code, without which nothing is computed.
    """

    case: str
    source: str
    rows: Callable[[int, float], Sequence[Row]]
    levels: tuple[int, ...]
    placements: int = 1
    needs: tuple[str, ...] = ()

    def run(self) -> list[Row]:
        """Compute the rows at all levels and judge them."""
        nothing = Row("everything", "1", None, None, 0.0, case=self.case, source=self.source)
        if any(find_spec(name) is None for name in self.needs):
            return [replace(nothing, verdict="not installed")]
        try:
            found = [
                [self.rows(level, k / self.placements) for k in range(self.placements)]
                for level in self.levels
            ]
        except Exception as error:
            # Another code may have changed, or be broken; tribo itself fails in its own ways only.
            if not self.needs and not isinstance(error, TriboError):
                raise
            return [replace(nothing, note=str(error))]
        return [
            self._judged(row, [_error([rows[i] for rows in placed]) for placed in found])
            for i, row in enumerate(found[-1][0])
        ]

    def _judged(self, row: Row, errors: list[float]) -> Row:
        holds, order = errors[-1] <= row.tolerance, None
        if row.theory is not None:
            order = observed_order(self.levels, errors)
            holds = holds and order is not None and abs(order - row.theory) <= ORDER_MARGIN
        return replace(
            row,
            case=self.case,
            source=self.source,
            error=errors[-1],
            order=order,
            verdict="holds" if holds else "fails",
        )


def reference(
    case: str, source: str, *levels: int, placements: int = 1
) -> Callable[[Callable[[int, float], Sequence[Row]]], Reference]:
    """Make a `Reference` of the function below; parameters as there."""
    return lambda rows: Reference(case, source, rows, levels, placements)


def observed_order(levels: Sequence[int], errors: Sequence[float]) -> float | None:
    """Return the order at which errors fall, fitted to all levels; None for fewer than three."""
    if len(levels) < 3 or min(errors) <= 0:
        return None
    return -float(np.polyfit(np.log(levels), np.log(errors), 1)[0])


def _error(placed: Sequence[Row]) -> float:
    return float(np.sqrt(np.mean(np.square([_relative(row) for row in placed]))))


def _relative(row: Row) -> float:
    assert row.expected is not None
    assert row.got is not None
    return row.got if row.expected == 0 else row.got / row.expected - 1
