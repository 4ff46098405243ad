"""All checks, and a run through them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain

from tribo.verification import (
    codes,
    contacts,
    coupling,
    formulas,
    laws,
    plasticity,
    punches,
    strokes,
    waves,
    wear,
)
from tribo.verification.check import Check, Row, run_check

CHECKS: tuple[Check, ...] = (
    *contacts.CHECKS,
    *waves.CHECKS,
    *plasticity.CHECKS,
    *wear.CHECKS,
    *laws.CHECKS,
    *punches.CHECKS,
    *strokes.CHECKS,
    *coupling.CHECKS,
    *formulas.CHECKS,
    *codes.CHECKS,
)


def run_suite(
    checks: Sequence[Check] = CHECKS, started: Callable[[Check], None] = lambda _: None
) -> list[Row]:
    """Run checks in their order.

    Parameters
    ----------
    checks : sequence of Check, optional
        All of them if left out.
    started : callable, optional
        Told of each check before it runs.

    Returns
    -------
    list of Row
    """

    def rows(check: Check) -> list[Row]:
        started(check)
        return run_check(check)

    return list(chain.from_iterable(rows(check) for check in checks))
