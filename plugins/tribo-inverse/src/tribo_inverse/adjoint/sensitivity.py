"""The numbers of a case with the largest influence, from runs on two coarse grids."""

from __future__ import annotations

from collections.abc import Mapping

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


def of_case(model: Model, half_width_x: float) -> list[Finding]:
    """Return the `MOST` most influential numbers of a case; `half_width_x` of its contact in m.

    They change the largest depth worn, or the time to reach it where a depth ends the run.
    """
    try:
        return _of_case(model, half_width_x)
    except (CaseError, NumericalError) as error:
        return [Finding("sensitivity", f"not known, since {error}")]


def _of_case(model: Model, half_width_x: float) -> list[Finding]:
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


def _of_two(coarse: Model, fine: Model) -> list[Finding]:
    asked: list[tuple[str, bool]] = []

    def answer(view: View) -> tuple[float, Seeds]:
        if not asked:
            asked.append(_asked(view))
        body, ends = asked[0]
        return EndTime()(view) if ends else Deepest(body)(view)

    def volume(view: View) -> tuple[float, Seeds]:
        return Volume(asked[0][0])(view)

    (before, _), (after, volumes) = (gradients(each, [answer, volume]) for each in (coarse, fine))
    if not (before.value > 0 and after.value > 0):
        raise CaseError("no body wears on a coarse grid", "bodies")
    body, ends = asked[0]
    what = f"time until {body} reaches stop.depth" if ends else f"depth of {body}"
    return influences(what, before.relative, after.relative, volumes.relative)


def _asked(view: View) -> tuple[str, bool]:
    """Return the body that is worn deepest, or whose depth ends the run, and whether it does."""
    model = view.model
    deepest = max(model.laws.wear, key=lambda name: float(np.max(view.wear(name))))
    if view.state.time < model.end_time:
        return model.case.stop.body or deepest, True
    return deepest, False


def influences(
    what: str, coarse: Mapping[str, float], fine: Mapping[str, float], volume: Mapping[str, float]
) -> list[Finding]:
    """Return the influence of numbers, by path, on an answer on two grids, and on the volume.

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
            f"+1 %: {what} {fine[path]:+.2f} ± {off[path]:.2f}, volume {volume[path]:+.2f} %",
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
