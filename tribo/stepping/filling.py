"""What fills the gap, held against how fast that opens."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.state import State
from tribo.stepping.contacts import in_stripes
from tribo.stepping.evolution import course
from tribo.stepping.memory import filling, remembered
from tribo.stepping.rates import Moment
from tribo.stepping.step import worn_depths

if TYPE_CHECKING:
    from tribo.simulation.model import Model

FIRST = 1e-6
"""Part of the path over which it is held against it."""
MOST = 10.0
"""Powers of e by which what is uneven may grow over the path."""


def check_filling(model: Model, state: State) -> None:
    """Raise `CaseError` if a gap fills the faster, the harder it is pressed, and opens slower.

    The load then draws together on ever fewer points, on a fine grid without end. Of an unevenness
    δp the gap loses a δp per metre, which adds a δp/C to the pressure, with C the smallest
    compliance: it grows as exp(a s/C).
    """
    compliance = model.solver.smallest_compliance(model.system)
    if not model.filling or compliance is None:
        return
    before, path = remembered(state), model.end_distance
    speed = path / model.end_time
    moment = Moment(state.time + FIRST * model.end_time, state.distance + FIRST * path, speed)
    nudged, stripes = in_stripes(state.contacts)
    lost = []
    for contacts in (state.contacts, nudged):
        slid = course(model, before, contacts, FIRST * path, moment)
        heights = filling(model, slid.memory)
        for name, depth in worn_depths(model, slid.rates, FIRST * path).items():
            for position, height in enumerate(heights):
                height -= model.under(name, depth, position)
        lost.append(heights)
    uneven = np.stack(stripes)
    slope = float(np.sum(uneven * (lost[1] - lost[0]))) / float(np.sum(uneven**2))
    if slope / FIRST <= MOST * compliance:
        return
    keys = ", ".join(repr(key) for _, key in model.filling)
    passing = ", ".join(repr(name) for name in model.bodies if name in model.swept)
    where = f"let it lie on the body that passes ({passing}), " if passing else ""
    raise CaseError(
        f"{keys} fills the gap faster than wear opens it where the pressure is higher, so that the "
        f"load would draw together on ever fewer points; {where}let less of what is worn stay, or "
        "let it not fill the gap (fills = false)",
        "effects",
    )
