"""The numbers of a case with the largest influence, from runs on two coarse grids."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from tribo import CaseError, Finding, NumericalError
from tribo.kernel_api import WIDER, Model, coarsened

from tribo_inverse.adjoint.gradient import gradients
from tribo_inverse.adjoint.objective import Deepest, EndTime, Volume
from tribo_inverse.adjoint.view import Seeds, View

CELLS = 24
"""Along the longer edge of the coarser window; the finer has twice as many.

An error of first order in the cell size equals, on the finer grid, the difference of the two.
"""
LEAST = 0.005
"""Influence in % for 1 % below which a number is left out."""

MOST = 8
"""Numbers of a case that are reported."""

Answer = Literal["depth", "end_time"]


@dataclass(frozen=True)
class Sensitivity:
    """Influence of the numbers of a case on the largest depth worn, or on the time to reach it.

    Parameters
    ----------
    body : str
        The body that is worn deepest, or whose depth ends the run.
    of : str
        ``"depth"`` of the body, or ``"end_time"`` where a depth ends the run.
    percent : dict of float
        By path, the largest first: change of the depth or time in % for 1 % of the number, on the
        finer grid.
    uncertainty : dict of float
        By path: the difference of the two grids, in % for 1 %.
    volume : dict of float
        By path: change of the volume worn off the body in % for 1 %, on the finer grid.
    """

    body: str
    of: Answer
    percent: dict[str, float]
    uncertainty: dict[str, float]
    volume: dict[str, float]


def sensitivity(model: Model, half_width_x: float) -> Sensitivity:
    """Return the influence of numbers on the largest depth of a run, or its end, on coarse grids.

    Parameters
    ----------
    model : Model
        The composed case.
    half_width_x : float
        Half the extent of its first contact along x, in m.

    Raises
    ------
    CaseError
        If the case has no gradient, or nothing wears.
    NumericalError
        If the run on a coarse grid fails.
    """
    if not model.laws.wear:
        raise CaseError("no body has a wear law, so nothing wears", "bodies")
    if not model.case.contact.accepts_wear_compliance:
        raise CaseError(
            f"{model.case.contact.type!r} takes explicit steps only, a coarse run implicit ones",
            "contact.type",
        )
    if model.case.begin is not None:
        raise CaseError("the wear that a run begins with is left out on a coarse grid", "begin")
    resolved = np.inf if model.case.contact.periodic else half_width_x
    wide = 1.0 if model.contact.may_reach_edge else WIDER
    failed: CaseError | NumericalError | None = None
    trials = (
        # The average of the stroke is the cheapest, but has not all surfaces.
        (CELLS, wide, np.inf if model.case.contact.periodic else 0.0),
        (2 * CELLS, 1.0, resolved),
    )
    for cells, margin, half_width in trials:
        try:
            return _of_two(
                *(coarsened(model.case, n, margin, half_width) for n in (cells, 2 * cells))
            )
        except (CaseError, NumericalError) as error:
            failed = failed or error
    assert failed is not None
    raise failed


def _of_two(coarse: Model, fine: Model) -> Sensitivity:
    asked: list[tuple[str, Answer]] = []

    def answer(view: View) -> tuple[float, Seeds]:
        if not asked:
            asked.append(_asked(view))
        body, of = asked[0]
        return EndTime()(view) if of == "end_time" else Deepest(body)(view)

    def volume(view: View) -> tuple[float, Seeds]:
        return Volume(asked[0][0])(view)

    (before, _), (after, volumes) = (gradients(each, [answer, volume]) for each in (coarse, fine))
    if not (before.value > 0 and after.value > 0):
        raise CaseError("no body wears on a coarse grid", "bodies")
    # A number may have a derivative on one of the grids alone.
    both = {p: value for p, value in after.relative.items() if p in before.relative}
    off = {p: abs(value - before.relative[p]) for p, value in both.items()}
    ranked = sorted(both.items(), key=lambda item: -abs(item[1]))
    percent = {p: float(value) for p, value in ranked if abs(value) >= LEAST}
    uncertainty = {path: float(off[path]) for path in percent}
    volume_percent = {path: volumes.relative[path] for path in percent}
    return Sensitivity(*asked[0], percent, uncertainty, volume_percent)


def _asked(view: View) -> tuple[str, Answer]:
    model, state = view.model, view.state
    deepest = max(model.laws.wear, key=lambda name: float(np.max(view.wear(name))))
    if state.time < model.end_time:
        return model.case.stop.body or deepest, "end_time"
    return deepest, "depth"


def of_case(model: Model, half_width_x: float) -> list[Finding]:
    """Return the `MOST` most influential numbers of a case; `half_width_x` of its contact in m.

    Where the two grids differ by more than an influence, the number is named alone.
    """
    try:
        found = sensitivity(model, half_width_x)
    except (CaseError, NumericalError) as error:
        return [Finding("sensitivity", f"not known, since {error}")]
    depth, time = f"depth of {found.body}", f"time until {found.body} reaches stop.depth"
    what = depth if found.of == "depth" else time
    known = [
        path for path, change in found.percent.items() if abs(change) > found.uncertainty[path]
    ]
    unknown = [path for path in found.percent if path not in known]
    words = "smaller than the error of the coarse grids, and left out: "
    return [
        *(_sensitivity(found, what, path) for path in known[:MOST]),
        *([Finding("sensitivity", words + ", ".join(unknown))] if unknown else []),
    ]


def _sensitivity(found: Sensitivity, what: str, path: str) -> Finding:
    """Word the change of an answer, in %, for 1 % more of a number."""
    change, uncertainty, volume = (
        each[path] for each in (found.percent, found.uncertainty, found.volume)
    )
    return Finding(
        "sensitivity",
        f"+1 %: {what} {change:+.2f} ± {uncertainty:.2f}, volume {volume:+.2f} %",
        value=change,
        uncertainty=uncertainty,
        place=path,
    )
