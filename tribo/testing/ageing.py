"""States as a run makes them: of some age, and different at each point."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import Field
from tribo.testing.compare import require

_NUDGE = 1e-3


def aged(
    fields: Iterable[Field],
    rates: Callable[[Mapping[str, Array]], Mapping[str, Array]],
    state: Mapping[str, Array],
    far: Array,
) -> dict[str, Array]:
    """Return a state after each point has gone as far as `far` at its rates, within its limits.

    Exponential Euler steps that grow; what relaxes does not pass where it tends to.
    """
    limits = {field.name: (field.at_least, field.at_most) for field in fields}
    now = dict(state)
    for share in np.diff(np.geomspace(1e-8, 1.0, 40), prepend=0.0):
        stride = share * far
        at = _of_shapes(rates({name: values.copy() for name, values in now.items()}), now)
        strides = {n: stride if at[n].shape == far.shape else np.mean(stride) for n in now}
        nudged = {n: now[n] + _NUDGE * strides[n] * at[n] for n in now}
        later = _of_shapes(rates(nudged), now)
        for name, (least, most) in limits.items():
            with np.errstate(all="ignore"):
                decay = (1 - later[name] / at[name]) / _NUDGE
                mean = np.where(decay > 1e-9, -np.expm1(-decay) / decay, 1.0)
            moved = now[name] + np.where(at[name] == 0, 0.0, strides[name] * at[name] * mean)
            require(np.all(np.isfinite(moved)), f"the state {name!r} grows beyond all numbers")
            now[name] = moved if least is most is None else np.clip(moved, least, most)
    return now


def _of_shapes(rates: Mapping[str, Array], state: Mapping[str, Array]) -> dict[str, Array]:
    missing = ", ".join({*state} - {*rates})
    require(not missing, f"it gave no rate of its state {missing}")
    return {name: np.broadcast_to(rates[name], now.shape) for name, now in state.items()}
