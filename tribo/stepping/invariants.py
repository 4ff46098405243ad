"""Invariants checked after each step.

The load balance, the sign and the cap of a pressure are checked at every solve,
in `tribo.guards.parts`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import NumericalError
from tribo.core.measures import Invariants
from tribo.core.rounding import SAME
from tribo.core.state import State
from tribo.evolution.rates import CycleRates

if TYPE_CHECKING:
    from tribo.model.model import Model

CONDITIONS = 1e-2
"""Largest residual of the contact conditions: looser than any solver's tolerance."""
SMALL = 1e-9
"""Volume of a step over the volume worn so far, below which rounding dominates it."""

_SOLVER = "tighten the tolerance of the contact solver, or choose another (contact.type)"
_MOTION = "that is a fault of the kinematics; 'tribo plugins check' tests it"


def wear_balance(
    model: Model,
    worn: Mapping[str, Array],
    rates: CycleRates,
    increment: float,
    before: State,
) -> Invariants:
    """Compare the volume worn in a step with the volume by the laws.

    The volume that a body loses must be the integral over the contact of the depth per metre times
    the increment, however the body meets the contact. `worn` has its depth by body, in m.
    """
    volumes, regrowths = [0.0], [0.0]
    for name, depth in worn.items():
        exposure = model.cycle.maps[name]
        each = zip(model.cycle, rates, strict=True)
        mean = sum(place.share * float(np.sum(of[name].depth_rate)) for place, of in each)
        asked = increment * model.grid.cell_area * mean
        error = abs(exposure.volume(depth) - asked)
        if not error <= SAME * asked:
            asked = max(asked, SMALL * exposure.volume(before.bodies[name].wear))
        volumes.append(error / asked if asked != 0 else error)
        regrowths.append(0.0 - float(np.min(depth)))
    # Unlike Python's, the maximum of numpy is NaN if a value is.
    return Invariants(volume=float(np.max(volumes)), regrowth=float(np.max(regrowths)))


def hold(before: State | None, after: State) -> State:
    """Return `after` with the pressures before it; `before` is None for the first contact.

    Raises
    ------
    NumericalError
        If an invariant does not hold, with the step, the deviation and a remedy.
    """
    if before is not None:
        after = replace(after, previous=tuple(each.pressure for each in before.contacts))
    when = f"step {after.steps}, at {after.time:.6g} s ({after.distance:.6g} m)"
    for name, body in after.bodies.items():
        for what, values in {"plastic depth": body.plastic, **body.law}.items():
            if not np.isfinite(np.sum(values)):
                raise NumericalError(f"{when}: the {what} of {name} is not finite; check its rate")
    contact, step = [each.residuals for each in after.contacts], after.invariants
    complementarity = max(each.complementarity for each in contact)
    penetration = max(each.penetration for each in contact)
    limits = (
        ("a gap is under pressure, by {:.3g}", complementarity, CONDITIONS, _SOLVER),
        ("bodies overlap out of contact, by {:.3g}", penetration, CONDITIONS, _SOLVER),
        ("a body grows back by {:.3g} m", step.regrowth, 0.0, _MOTION),
        ("the wear volume is off its law's by {:.3g} of it", step.volume, SAME, _MOTION),
    )
    for words, value, most, remedy in limits:
        # Neither is a NaN allowed.
        if not value <= most:
            raise NumericalError(
                f"{when}: {words.format(value)}, and {most:g} is allowed; {remedy}"
            )
    return after
