"""A result but its fields, as the plain data that ``tribo show --json`` prints."""

from __future__ import annotations

from typing import Any

import numpy as np

from tribo.result.columns import INVARIANTS
from tribo.result.read import Result


def summary(result: Result) -> dict[str, Any]:
    """Return the summary of a result, with the scalars of each save."""
    return {
        "case": result.case_tables,
        "status": result.status,
        "provenance": result.provenance,
        "notices": list(result.warnings),
        "totals": dict(result.totals()),
        "invariants": worst(result),
        "saves": result.saves(),
    }


def worst(result: Result) -> dict[str, float]:
    """Return the worst value, over all steps, of each invariant of a run."""
    steps = result.table("history")
    return {each.label: float(np.max(steps[each.label], initial=0)) for each in INVARIANTS}
