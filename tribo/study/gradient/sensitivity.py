"""Which numbers of a case rule its answer, from a run on a coarse grid."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from tribo.core.errors import CaseError, NumericalError
from tribo.simulation.coarse import MARGINS, coarsened
from tribo.simulation.model import Model
from tribo.study.gradient.gradient import gradient
from tribo.study.gradient.objective import Deepest, Seeds, View

CELLS = 24
"""Along the longer edge of the window: percentages, not depths, are asked for."""
LEAST = 0.005
"""Per cent for one per cent, below which a number is left out."""


@dataclass(frozen=True)
class Sensitivity:
    """How the largest depth worn follows the numbers of a case.

    Parameters
    ----------
    body : str
        The body that is worn deepest.
    percent : dict of float
        By path, the largest first: by how many per cent its depth changes for one per cent of the
        number.
    """

    body: str
    percent: dict[str, float]


def sensitivity(model: Model) -> Sensitivity | None:
    """Return which numbers rule the largest depth of a run, from one on a coarse grid.

    None where such a run, or a gradient through it, is not to be had.
    """
    if not model.contact.accepts_wear_compliance or model.case.begin is not None:
        return None
    half_width = np.inf if model.contact.periodic else 0.0
    margin = 1.0 if model.may_reach_edge else MARGINS[0]
    with suppress(CaseError, NumericalError):
        return _of_coarse(coarsened(model.case, CELLS, margin, half_width))
    return None


def _of_coarse(model: Model) -> Sensitivity | None:
    deepest: list[str] = []

    def largest(view: View) -> tuple[float, Seeds]:
        if not deepest:
            deepest.append(max(model.laws, key=lambda name: float(np.max(view.wear(name)))))
        return Deepest(deepest[0])(view)

    found = gradient(model, largest)
    if not found.value > 0:
        return None
    ranked = sorted(found.relative.items(), key=lambda item: -abs(item[1]))
    percent = {path: float(value) for path, value in ranked if abs(value) >= LEAST}
    return Sensitivity(deepest[0], percent)
