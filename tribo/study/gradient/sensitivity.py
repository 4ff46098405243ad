"""Which numbers of a case rule its answer, from a run on a coarse grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tribo.core.errors import CaseError, NumericalError, OverTime
from tribo.simulation.coarse import MARGINS, coarsened
from tribo.simulation.model import Model
from tribo.simulation.trial_time import limited
from tribo.study.gradient.gradient import gradient
from tribo.study.gradient.objective import Deepest, EndTime, Seeds, View

CELLS = 24
"""Along the longer edge of the window: percentages, not depths, are asked for."""
LEAST = 0.005
"""Per cent for one per cent, below which a number is left out."""

OFF = {"depth": 0.05, "end_time": 0.2}
"""Per cent for one per cent by which finer grids were seen to differ."""
OFF_IN_LAYERS = 0.25
"""The same where a body wears in layers: rings of cells come to a bottom together."""

Answer = Literal["depth", "end_time"]


@dataclass(frozen=True)
class Sensitivity:
    """How the largest depth worn follows the numbers of a case, or the time until it is reached.

    Parameters
    ----------
    body : str
        The body that is worn deepest, or of which a depth ends the run.
    of : str
        ``"depth"`` of the body, or ``"end_time"`` where a depth ends the run.
    percent : dict of float
        By path, the largest first: by how many per cent that changes for one per cent of the
        number.
    cells : tuple of int
        Cells of the grid of the run that this is of, along x and y.
    off : float
        By how many per cent for one per cent finer grids were seen to differ.
    """

    body: str
    of: Answer
    percent: dict[str, float]
    cells: tuple[int, int]
    off: float

    @property
    def whence(self) -> str:
        """Of which grid it is, and how far off it may be, in words."""
        cells = " × ".join(map(str, self.cells))
        return f"a run on {cells} cells; finer grids differ by up to {self.off:g} %"


def sensitivity(model: Model, half_width_x: float) -> Sensitivity:
    """Return which numbers rule the largest depth of a run, or its end, from a coarse grid.

    Parameters
    ----------
    model : Model
        The composed case.
    half_width_x : float
        Half the extent of its first contact along x, in m.

    Raises
    ------
    CaseError
        If there is no gradient through the case, or nothing wears.
    NumericalError
        If the run on a coarse grid fails, or takes over 30 s.
    """
    if not model.contact.accepts_wear_compliance:
        raise CaseError(
            f"{model.contact.type!r} takes explicit steps only, and a coarse run implicit ones",
            "contact.type",
        )
    if model.case.begin is not None:
        raise CaseError("the wear that a run begins with is left out on a coarse grid", "begin")
    resolved = np.inf if model.contact.periodic else half_width_x
    wide = 1.0 if model.may_reach_edge else MARGINS[0]
    failed: CaseError | NumericalError | None = None
    # The average of the stroke is the cheapest, but has not all surfaces.
    for cells, margin, half_width in (
        (CELLS, wide, np.inf if model.contact.periodic else 0.0),
        (2 * CELLS, 1.0, resolved),
    ):
        try:
            with limited():
                return _of_coarse(coarsened(model.case, cells, margin, half_width))
        except OverTime as error:
            raise NumericalError(str(error)) from None
        except (CaseError, NumericalError) as error:
            failed = failed or error
    assert failed is not None
    raise failed


def _of_coarse(model: Model) -> Sensitivity:
    asked: list[tuple[str, Answer]] = []

    def answer(view: View) -> tuple[float, Seeds]:
        if not asked:
            asked.append(_asked(view))
        body, of = asked[0]
        return EndTime()(view) if of == "end_time" else Deepest(body)(view)

    found = gradient(model, answer)
    if not found.value > 0:
        raise CaseError("no body wears", "bodies")
    ranked = sorted(found.relative.items(), key=lambda item: -abs(item[1]))
    percent = {path: float(value) for path, value in ranked if abs(value) >= LEAST}
    body, of = asked[0]
    layered = any(law.bottoms for law in model.laws.values())
    off = max(OFF[of], OFF_IN_LAYERS) if layered else OFF[of]
    return Sensitivity(body, of, percent, model.grid.cells, off)


def _asked(view: View) -> tuple[str, Answer]:
    model, state = view.model, view.state
    deepest = max(model.laws, key=lambda name: float(np.max(view.wear(name))))
    if state.time < model.end_time:
        return model.case.stop.body or deepest, "end_time"
    return deepest, "depth"
