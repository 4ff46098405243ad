"""All problems with a known answer, and a run through them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tribo.verification import (
    codes,
    contacts,
    formulas,
    plasticity,
    punches,
    strokes,
    waves,
    wear,
)
from tribo.verification.reference import Reference, Row

REFERENCES: tuple[Reference, ...] = (
    *contacts.REFERENCES,
    *waves.REFERENCES,
    *plasticity.REFERENCES,
    *wear.REFERENCES,
    *punches.REFERENCES,
    *strokes.REFERENCES,
    *formulas.REFERENCES,
    *codes.REFERENCES,
)


def run_suite(
    references: Sequence[Reference] = REFERENCES,
    started: Callable[[Reference], None] = lambda _: None,
) -> list[Row]:
    """Compute the rows of `references`; `started` is told of each before it runs."""
    rows = []
    for known in references:
        started(known)
        rows += known.run()
    return rows
