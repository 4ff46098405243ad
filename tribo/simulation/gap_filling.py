"""The rate of filling of the gap, compared with the rate of its opening."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.errors import CaseError, NumericalError
from tribo.core.state import State, key_of
from tribo.evolution.course import course, in_stripes
from tribo.evolution.interval import interval_from
from tribo.evolution.states import filling, remembered
from tribo.stepping.step import worn_depths

if TYPE_CHECKING:
    from tribo.model.model import Model

PARTS = np.logspace(-6, 0, 7)
"""Parts of the path over which filling and opening are compared."""
MOST = 10.0
"""Powers of e by which an unevenness may grow over the path."""


def check_filling(model: Model, state: State) -> None:
    """Raise `CaseError` if a gap fills the faster, the harder it is pressed, and opens slower.

    The load then draws together on ever fewer points, on a fine grid without end. Of an unevenness
    δp the gap loses a δp s over a path s, which adds a s/C of it to the pressure, with C the
    smallest compliance: it grows as exp(a s/C), up to where what fills the gap is carried away as
    fast as it comes.
    """
    compliance = model.contact.solver.smallest_compliance(model.contact.system)
    if not model.laws.filling or compliance is None:
        return
    nudged, stripes = in_stripes(state.contacts)
    uneven = np.stack(stripes)
    most = MOST * compliance * float(np.sum(uneven**2))
    for part in PARTS:
        try:
            lost = _lost(model, state, nudged, part) - _lost(model, state, state.contacts, part)
        except NumericalError:
            # Over so long a path it cannot be followed at the first pressure.
            return
        if np.sum(uneven * lost) > most:
            break
    else:
        return
    states = ", ".join(key_of(key, body) for body, key in model.laws.filling)
    passing = ", ".join(repr(name) for name in model.case.bodies if name in model.cycle.swept)
    where = f"let it lie on the body that passes ({passing}), " if passing else ""
    raise CaseError(
        f"{states} fills the gap faster than wear opens it where the pressure is higher, so that "
        f"the load would concentrate on ever fewer points; {where}let less of the worn material "
        "stay, or set fills = false",
        "effects",
    )


def _lost(model: Model, state: State, contacts: Sequence[ContactSolution], part: float) -> Array:
    """Return the filling of the gap less its opening over a part of the path, in m."""
    increment, time = part * model.end_distance, part * model.end_time
    interval = interval_from(state, increment, state.time + time)
    slid = course(model, remembered(model, state), contacts, interval)
    heights = filling(model, slid.memory)
    for name, depth in worn_depths(model, slid.rates, increment).items():
        for position, height in enumerate(heights):
            height -= model.cycle.maps[name].see(depth, position)
    return heights
