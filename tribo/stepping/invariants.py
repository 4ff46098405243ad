"""Invariants checked after each step.

The load balance, the sign and the cap of a pressure are checked at every solve,
in `tribo.guards.parts`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, union
from tribo.core.contact import ContactSolution
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
ONE_LOAD = 1e-3
"""Relative change of the load above which the load, not chattering, moves the pressure."""
CHATTERING = 0.5
"""Part of the load: implicit steps were seen to hand back up to 0.012 on smooth and rough balls,
stable explicit ones, as they begin, 0.28; unstable ones between 0.6 and 0.9."""

_SOLVER = "tighten the tolerance of the contact solver, or choose another (contact.type)"
_STEPS = "shorten the steps (stepping.time_step), or use stepping.type = 'implicit'"
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
    """Return `after` with its invariants; `before` is None for the first contact.

    Raises
    ------
    NumericalError
        If one does not hold, with the step, the deviation and a remedy.
    """
    if before is not None:
        after = replace(after, previous=tuple(each.pressure for each in before.contacts))
        if before.previous and _one_load(before.previous, before, after):
            share = max(map(_chattering, before.previous, before.contacts, after.contacts))
            after = replace(after, invariants=replace(after.invariants, chattering=share))
    broken = broken_by(after)
    if broken is not None:
        raise NumericalError(
            f"step {after.steps}, at {after.time:.6g} s ({after.distance:.6g} m): {broken}"
        )
    return after


def broken_by(state: State) -> str | None:
    """Name the broken invariant of `state`, its deviation and a remedy."""
    lost = _not_finite(state)
    if lost is not None:
        return f"the {lost} is not finite; find what diverges: a wear law, or the kinematics"
    contact, step = [each.residuals for each in state.contacts], state.invariants
    force = max(each.force for each in contact)
    complementarity = max(each.complementarity for each in contact)
    penetration = max(each.penetration for each in contact)
    limits = (
        ("the load is missed by {:.3g} of it", force, SAME, _SOLVER),
        ("a gap is under pressure, by {:.3g}", complementarity, CONDITIONS, _SOLVER),
        ("bodies overlap out of contact, by {:.3g}", penetration, CONDITIONS, _SOLVER),
        ("a body grows back by {:.3g} m", step.regrowth, 0.0, _MOTION),
        ("the wear volume is off its law's by {:.3g} of it", step.volume, SAME, _MOTION),
        ("the pressure chatters, by {:.3g} of the load", step.chattering, CHATTERING, _STEPS),
    )
    for words, value, most, remedy in limits:
        # Neither is a NaN allowed.
        if not value <= most:
            return f"{words.format(value)}, and {most:g} is allowed; {remedy}"
    return None


def handed_back(first: Array, second: Array, third: Array) -> float:
    """Return the share of the load that goes to other cells in one step and back in the next.

    The pressures are one step apart, under one load. An unstable mode changes its sign at every
    step; the pressure on fine roughness changes monotonically.
    """
    low, high = np.minimum(first, third), np.maximum(first, third)
    # What `second` lies outside the range of the two others; each share leaves one cell for
    # another, and so is counted twice.
    np.clip(second, low, high, out=low)
    low -= second
    np.abs(low, out=low)
    return 0.5 * float(np.sum(low)) / float(np.sum(second))


def _one_load(previous: Sequence[Array], before: State, after: State) -> bool:
    """Whether each position carries one load in three states that follow one another."""
    for two_ago, between, latest in zip(previous, before.contacts, after.contacts, strict=True):
        carried = float(np.sum(between.pressure))
        others = float(np.sum(two_ago)), float(np.sum(latest.pressure))
        if any(abs(other - carried) > ONE_LOAD * carried for other in others):
            return False
    return True


def _chattering(before: Array, between: ContactSolution, after: ContactSolution) -> float:
    """Return `handed_back` at a position, with the pressure (nx, ny) two steps ago."""
    # Where neither of the last two presses, nothing comes back.
    near = union(between.extent, after.extent)
    return handed_back(before[near], between.pressure[near], after.pressure[near])


def _not_finite(state: State) -> str | None:
    if not isfinite(state.invariants.volume):
        return "wear depth"
    for name, body in state.bodies.items():
        for what, values in (("plastic depth", body.plastic), *body.law.items()):
            if not isfinite(np.sum(values)):
                return f"{what} of {name}"
    return None
