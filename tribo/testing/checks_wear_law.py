"""What every wear law must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import LocalConditions, WearRate
from tribo.simulation.guards import GuardedLaw
from tribo.testing import samples
from tribo.testing.checks import Checks
from tribo.testing.compare import apply_if, expect_close, locked, require

_SHAPE = (7, 6)
# Not an order of magnitude apart, so that a pressure between two is like both.
_LADDER = np.geomspace(1e5, samples.PEAK, 160)
_APPROACH = 2.2e-6
"""Of the small case, in m."""


class WearLawChecks(Checks):
    """Checks of a wear law."""

    def _inputs(self, component: Any, number: int) -> LocalConditions:
        pressure = np.full(_SHAPE, 1e8)
        if number == 0:
            # Up to the peak, and 0 in every third point.
            pressure = samples.PEAK * (0.02 + 0.98 * samples.pattern(_SHAPE))
            pressure.reshape(-1)[::3] = 0.0
        fields = samples.fields(component.requires, self._fields, pressure)
        return _local(component, pressure, fields)

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        return dict(_parts(component.rate(inputs)))

    def answers_fit_a_run(self) -> None:
        """Rates are finite and not negative, 0 where the pressure is, one for each state field."""
        guarded = GuardedLaw(self._make(), samples.BODIES[0], samples.STEEL)
        law = guarded.component
        for number in (0, 1):
            guarded.rate(locked(self._inputs(law, number)))
        guarded.rate(self._slid(law))
        pressure = _LADDER[:, None].copy()
        guarded.rate(locked(_local(law, pressure, self._fields_at(law, pressure))))

    def derivative_is_that_of_the_depth(self) -> None:
        """The derivative agrees with the differences of the depth in pressure."""
        law = self._make()
        step = 1e-5 * _LADDER
        at, up, down = (self._at(law, _LADDER + s) for s in (0 * step, step, -step))
        apply_if(at.depth_slope is not None, "depth_slope is None: it is found by difference")
        found = np.broadcast_to(at.depth_slope, _LADDER.shape)
        forward = (up.depth_rate - at.depth_rate) / step
        backward = (at.depth_rate - down.depth_rate) / step
        slopes = np.stack([forward, backward, (forward + backward) / 2])
        # At a kink one side is right. Round-off of the depth is 1e-11 of depth/p.
        error = np.min(np.abs(found - slopes), axis=0)
        allowed = 1e-4 * np.maximum(np.abs(found), at.depth_rate / _LADDER)
        worst = int(np.argmax(error - allowed))
        hint = (
            "; if a field that it requires follows the pressure, say how: see 'Fields that follow "
            "the pressure' in docs/plugins.md"
        )
        require(
            error[worst] <= allowed[worst],
            f"at p = {_LADDER[worst]:.3g} Pa the derivative is {found[worst]:.6g} 1/Pa, but the "
            f"depth changes by {slopes[2, worst]:.6g} per Pa{hint if law.requires else ''}",
        )

    def depth_grows_with_pressure(self) -> None:
        """Where the derivative is not negative, more pressure never wears less."""
        rate = self._at(self._make(), _LADDER)
        falls = rate.depth_slope is None or np.any(rate.depth_slope < 0)
        apply_if(not falls, "its derivative is negative somewhere, or not stated")
        depth = rate.depth_rate
        at = int(np.argmin(np.diff(depth)))
        require(
            depth[at + 1] >= depth[at] * (1 - 1e-12),
            f"the depth per metre falls from {depth[at]:.6g} to {depth[at + 1]:.6g} as the "
            f"pressure rises from {_LADDER[at]:.3g} to {_LADDER[at + 1]:.3g} Pa",
        )

    def points_are_independent(self) -> None:
        """A point wears the same wherever it lies and whatever the other points do."""
        law = self._make()
        local = self._slid(law)
        whole = _parts(law.rate(local))
        order = np.argsort(samples.pattern((local.pressure.size,)))
        for what, chosen in (("in another order", order), ("left out by half", order[::2])):

            def choose(values: Array, chosen: Any = chosen) -> Array:
                return np.asarray(values.reshape(-1, 1)[chosen])

            part = replace(
                local,
                pressure=choose(local.pressure),
                fields={name: choose(values) for name, values in local.fields.items()},
                state={name: choose(values) for name, values in local.state.items()},
            )
            for name, found in _parts(law.rate(locked(part))).items():
                needed = choose(np.array(np.broadcast_to(whole[name], _SHAPE)))
                expect_close(f"{name} with points {what}", found, needed, 1e-12)

    def untouched_points_keep_their_state(self) -> None:
        """Where the pressure is 0 no state changes: points beyond the window are not asked."""
        law = self._make()
        apply_if(bool(law.state_fields), "it keeps no state")
        local = self._slid(law)
        for name, values in law.rate(local).state_rates.items():
            changes = np.broadcast_to(values, _SHAPE)[local.pressure == 0]
            worst = float(np.max(np.abs(changes)))
            require(
                worst == 0,
                f"{name!r} changes by {worst:.3g} per metre where the pressure is 0; what a track "
                "has of that would depend on the size of the window",
            )

    def only_declared_fields_are_asked_for(self) -> None:
        """It asks for no local field but those in `requires`, and no state but its own."""
        law = self._make()
        local = locked(self._inputs(law, 0))
        asked = {
            "requires": samples.Asked(local.fields),
            "state_fields": samples.Asked(local.state),
        }
        fields, state = asked.values()
        try:
            law.rate(replace(local, fields=fields, state=state))
        except KeyError:
            if not (fields.missed or state.missed):
                raise
        for declared, mapping in asked.items():
            missed = ", ".join(sorted(map(str, mapping.missed)))
            require(not missed, f"it asked for {missed}; add that to {declared}")

    def runs_under_implicit_stepping(self) -> None:
        """Under implicit steps and stroke averaging each body loses just what the law says."""
        law = self._make()
        depth = float(self._at(law, np.array([samples.PEAK])).depth_rate[0])
        distance = 0.3 * _APPROACH / depth if depth > 0 else 1.0
        motion = samples.sliding(float(np.clip(distance, 1e-3, 1e6)))
        samples.run(self._fields, law=law, kinematics=motion)

    def _at(self, law: Any, pressure: Array) -> WearRate:
        """Return the rate at each of some pressures, with typical fields."""
        p = pressure[:, None].copy()
        rate = law.rate(locked(_local(law, p, self._fields_at(law, p))))
        depth = np.broadcast_to(rate.depth_rate, p.shape)[:, 0]
        slope: Any = rate.depth_slope
        if slope is not None:
            slope = np.broadcast_to(slope, p.shape)[:, 0]
        return WearRate(depth, slope)

    def _fields_at(self, law: Any, p: Array) -> dict[str, Array]:
        return {name: samples.field(name, law.requires, self._fields, p) for name in law.requires}

    def _slid(self, law: Any) -> LocalConditions:
        """Return conditions in which every point has its own state: after sliding 1 m."""
        local = self._inputs(law, 0)
        rates = law.rate(local).state_rates
        state = {name: values + np.asarray(rates[name]) for name, values in local.state.items()}
        return locked(replace(local, state=state))


def _local(law: Any, pressure: Array, fields: Mapping[str, Array]) -> LocalConditions:
    start = law.initial_state()
    state = {name: np.full(pressure.shape, value) for name, value in start.items()}
    return LocalConditions(pressure, samples.SPEED, samples.STEEL, fields, state)


def _parts(rate: WearRate) -> dict[str, Array]:
    """Return the arrays of a rate, by what they are called."""
    parts = {"depth": rate.depth_rate, "derivative": rate.depth_slope}
    parts |= {f"the rate of {name!r}": values for name, values in rate.state_rates.items()}
    return {name: values for name, values in parts.items() if values is not None}
