"""The numbers of a case with the largest influence, from runs on two coarse grids."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from tribo import Case, CaseError, Finding, NumericalError
from tribo.kernel_api import WIDER, Model, coarsened

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import Deepest, EndTime
from tribo_inverse.adjoint.view import Objective, Seeds, View

CELLS = 24
"""Along the longer edge of the coarser window; the finer has twice as many.

An error of first order in the cell size equals, on the finer grid, the difference of the two.
"""
LEAST = 0.005
"""Influence in % for 1 % below which a number is left out."""

MOST = 8
"""Numbers of a case that are reported."""


def of_case(model: Model, half_width_x: float) -> list[Finding]:
    """Return the `MOST` most influential numbers of a case; `half_width_x` of its contact in m.

    They change the largest depth worn, or the time to reach it where a depth ends the run.
    """
    try:
        return _of_case(model, half_width_x)
    except (CaseError, NumericalError) as error:
        return [Finding("sensitivity", f"not known, since {error}")]


def _of_case(model: Model, half_width_x: float) -> list[Finding]:
    if model.case.begin is not None:
        raise CaseError("the wear that a run begins with is left out on a coarse grid", "begin")
    wide = 1.0 if model.contact.may_reach_edge else WIDER
    averaged, resolved = (np.inf,) * 2 if model.case.contact.periodic else (0.0, half_width_x)
    try:
        # The average of the stroke is the cheapest, but has not all surfaces.
        return _of_two(model.case, CELLS, wide, averaged)
    except (CaseError, NumericalError) as error:
        try:
            return _of_two(model.case, 2 * CELLS, 1.0, resolved)
        except (CaseError, NumericalError):
            raise error from None


def _of_two(case: Case, cells: int, margin: float, half_width: float) -> list[Finding]:
    """Return the influences from a window of so many cells, and of twice as many."""
    asked: dict[str, Objective] = {}

    def answer(view: View) -> tuple[float, Seeds]:
        if not asked:
            body = max(view.state.bodies, key=lambda name: float(np.max(view.wear(name))))
            asked[f"depth of {body}"] = Deepest(body)
            if view.state.time < view.model.end_time:
                asked["time until stop.depth"] = EndTime()
        return [*asked.values()][-1](view)

    coarse, fine = (
        gradient(coarsened(case, count, margin, half_width), answer) for count in (cells, 2 * cells)
    )
    if not (coarse.value > 0 and fine.value > 0):
        raise CaseError("no body wears on a coarse grid", "bodies")
    return influences([*asked][-1], coarse.relative, fine.relative)


def influences(what: str, coarse: Mapping[str, float], fine: Mapping[str, float]) -> list[Finding]:
    """Return the influence of numbers, by path, on an answer on two grids.

    Their unit is % for 1 % of a number. Where the two grids differ by more than an influence, the
    number is named alone.
    """
    # A number may have a derivative on one of the grids alone.
    off = {path: abs(value - coarse[path]) for path, value in fine.items() if path in coarse}
    large = [path for path in off if abs(fine[path]) >= LEAST]
    ranked = sorted(large, key=lambda path: -abs(fine[path]))
    known = [path for path in ranked if abs(fine[path]) > off[path]]
    findings = [
        Finding(
            "sensitivity",
            f"+1 %: {what} {fine[path]:+.2f} ± {off[path]:.2f} %",
            value=fine[path],
            uncertainty=off[path],
            place=path,
        )
        for path in known[:MOST]
    ]
    if unknown := [path for path in ranked if path not in known]:
        words = "smaller than the error of the coarse grids, and left out: "
        findings.append(Finding("sensitivity", words + ", ".join(unknown)))
    return findings
