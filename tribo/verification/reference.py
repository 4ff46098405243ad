"""A problem with a known answer, and the rows of the table that compare with it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from typing import Literal

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import TriboError
from tribo.core.words import said

Verdict = Literal["holds", "fails", "not installed"]

ORDER_MARGIN = 0.2


@dataclass(frozen=True)
class Row:
    """One line of the table; what follows the note is added by `Reference.run`."""

    quantity: str
    unit: str
    """SI unit of the values; "1" for ratios and norms."""
    expected: float | None
    """Exact value; 0 marks an error, such as a norm, that is relative already."""
    got: float | None
    tolerance: float
    """Largest error at the finest level."""
    theory: float | None = None
    """Theoretical order of convergence; the observed one must be within 0.2 of it."""
    note: str = ""
    """What the error consists of, and why there is no order."""
    case: str = ""
    source: str = ""
    error: float | None = None
    """Relative; the root mean square over the placements of the grid."""
    order: float | None = None
    """Observed order of convergence."""
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
    """A problem with a known answer."""

    case: str
    """What is computed."""
    source: str
    """Where the answer comes from."""
    rows: Callable[[int, float], Sequence[Row]]
    """From a level and a placement in [0, 1) to rows."""
    levels: tuple[int, ...]
    """Cells, steps or what else is refined, coarse to fine."""
    placements: int = 1
    """How many placements of the grid are tried; errors are the root mean square over them,
    since the edge of a contact falls anywhere in a cell."""
    needs: tuple[str, ...] = ()
    """Modules of another code, without which nothing is computed."""

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
            # Another code, or the plugin that states the problem, may be broken.
            words = str(error) if isinstance(error, TriboError) else said(error)
            return [replace(nothing, note=words)]
        return [
            self._judged(row, [_error([rows[i] for rows in placed]) for placed in found])
            for i, row in enumerate(found[-1][0])
        ]

    def _judged(self, row: Row, errors: list[float]) -> Row:
        holds, order = errors[-1] <= row.tolerance, None
        if row.theory is not None:
            order = observed_order(self.levels, errors)
            holds = holds and order is not None and abs(order - row.theory) <= ORDER_MARGIN
        verdict: Verdict = "holds" if holds else "fails"
        judged = replace(row, error=errors[-1], order=order, verdict=verdict)
        return replace(judged, case=self.case, source=self.source)


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
