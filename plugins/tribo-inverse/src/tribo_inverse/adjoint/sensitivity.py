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
MOST = 8
"""Numbers of a case that are reported."""


def of_case(model: Model, half_width_x: float) -> list[Finding]:
    """Return the `MOST` most influential numbers of a case; `half_width_x` of its contact in m.

    They change the largest depth worn, or the time to reach it where a depth ends the run.
    """
    case, refused = model.case, None
    if case.begin is not None:
        return [Finding("sensitivity", "not known for a run that begins with another's wear")]
    wide = 1.0 if model.contact.may_reach_edge else WIDER
    averaged, resolved = (np.inf, np.inf) if case.contact.periodic else (0.0, half_width_x)
    # The average of the stroke is the cheapest, but has not all surfaces.
    for cells, margin, half_width in ((CELLS, wide, averaged), (2 * CELLS, 1.0, resolved)):
        try:
            return _of_two(case, cells, margin, half_width)
        except (CaseError, NumericalError) as error:
            refused = refused or error
    return [Finding("sensitivity", f"not known, since {refused}")]


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
    number is left out.
    """
    # A number may have a derivative on one of the grids alone.
    off = {path: abs(value - coarse[path]) for path, value in fine.items() if path in coarse}
    known = [path for path in off if abs(fine[path]) > off[path]]
    return [
        Finding(
            "sensitivity",
            f"+1 %: {what} {fine[path]:+.2f} ± {off[path]:.2f} %",
            value=fine[path],
            uncertainty=off[path],
            place=path,
        )
        for path in sorted(known, key=lambda path: -abs(fine[path]))[:MOST]
    ]
