"""A result but its fields, as the plain data that ``tribo show --json`` prints."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from tribo.core.column import labelled
from tribo.result.columns import INVARIANTS
from tribo.result.layout import BETWEEN, EFFECT, STATE
from tribo.result.read import Result


def summary(result: Result) -> dict[str, Any]:
    """Return the summary of a result, with the scalars of each save."""
    rows = result.saves()
    for save, row in enumerate(rows):
        for body in result.body_names:
            for what, kind in (("effects", EFFECT), ("state", STATE)):
                if found := _ranges(result, kind, save, body):
                    row["bodies"][body][what] = found
        if found := _ranges(result, BETWEEN, save):
            row[BETWEEN] = found
    return {
        "case": result.case_tables,
        "status": result.status,
        "provenance": result.provenance,
        "notices": list(result.warnings),
        "totals": dict(result.totals()),
        "invariants": worst(result),
        "saves": rows,
    }


def worst(result: Result) -> dict[str, float]:
    """Return the worst value, over all steps, of each invariant of a run."""
    steps = result.table("history")
    return {each.label: float(np.max(steps[each.label], initial=0)) for each in INVARIANTS}


def _ranges(result: Result, kind: str, save: int, body: str | None = None) -> dict[str, Any]:
    """Return the least and the largest value of fields at a save; None where one failed."""
    ranges = {}
    for key, field in result.fields_of(kind, body).items():
        values = result.field(key, save, body)
        ends = {"min": float(np.min(values)), "max": float(np.max(values))}
        ranges[labelled(field.name, field.unit)] = {
            name: None if math.isnan(end) else end for name, end in ends.items()
        }
    return ranges
