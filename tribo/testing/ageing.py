"""States as a run makes them: of some age, and different at each point."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tribo.core.arrays import Array
from tribo.guards.answers import initial
from tribo.guards.parts import GuardedEffect, GuardedLaw
from tribo.integration.step_to_break import lasting
from tribo.testing.compare import require

_NUDGE = 1e-3


def aged(
    model: GuardedEffect | GuardedLaw,
    rates: Callable[[Mapping[str, Array]], Mapping[str, Array]],
    state: Mapping[str, Array],
    far: Array,
) -> dict[str, Array]:
    """Return a state after each point has gone as far as `far` at its rates, within its limits.

    Exponential Euler steps that grow; what relaxes does not pass where it tends to.
    """
    now = dict(state)
    for share in np.diff(np.geomspace(1e-8, 1.0, 40), prepend=0.0):
        at, step = rates(now), share * far
        steps = {n: step if at[n].shape == far.shape else np.mean(step) for n in now}
        nudges = {name: _NUDGE * steps[name] * at[name] for name in now}
        later = rates({name: now[name] + nudges[name] for name in now})
        for name, nudge in nudges.items():
            change = later[name] - at[name]
            slope = np.divide(change, nudge, out=np.zeros_like(change), where=nudge != 0)
            moved = now[name] + lasting(steps[name], np.minimum(slope, 0.0)) * at[name]
            require(np.all(np.isfinite(moved)), f"the state {name!r} grows beyond all numbers")
            now[name] = np.clip(moved, *model.answers[initial(name)].range)
    return now
