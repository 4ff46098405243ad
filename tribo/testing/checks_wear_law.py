"""What every wear law must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.fields import LocalConditions, WearRate
from tribo.guards.answers import rate_of
from tribo.guards.parts import GuardedLaw
from tribo.testing import samples
from tribo.testing.checks import BODIES
from tribo.testing.checks_local import LocalChecks
from tribo.testing.compare import apply_if, expect_close, jump, locked, require

_SHAPE = (7, 6)
# Not an order of magnitude apart, so that a pressure between two is like both.
_LADDER = np.geomspace(1e5, samples.PEAK, 160)[:, None]
_APPROACH = 2.2e-6
"""Of the small case, in m."""
_FARTHEST = 30.0
"""Distance that the points of the samples have slid at most, in m."""


class WearLawChecks(LocalChecks):
    """Checks of a wear law, at several speeds, fresh and after some metres."""

    _numbers = (0, 1, 2, 3)
    _per = "m"

    def _inputs(self, component: Any, number: int) -> LocalConditions:
        """Return conditions of points that each have slid a distance of their own; 3: none."""
        pressure = samples.PEAK / (1 + number) * (0.02 + 0.98 * samples.pattern(_SHAPE, number))
        fields = self._fields_at(component, pressure, samples.pattern(_SHAPE, number + 7))
        state = {name: np.full(_SHAPE, v) for name, v in component.initial_state().items()}
        speed = samples.SPEEDS[number % len(samples.SPEEDS)]
        local = LocalConditions(pressure, speed, samples.STEEL, fields, state)
        if number < 3 and state:
            if number not in self._aged:
                far = _FARTHEST * samples.pattern(_SHAPE, number) ** 3
                self._aged[number] = self._remembering(deepcopy(local), far).state
            local = replace(local, state={n: v.copy() for n, v in self._aged[number].items()})
        # In every third point there is no pressure any more.
        touching = (np.arange(pressure.size) % 3 > 0).reshape(_SHAPE)
        return replace(local, pressure=np.where(touching, pressure, 0.0))

    @cached_property
    def _aged(self) -> dict[int, dict[str, Array]]:
        return {}

    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        rates: Mapping[str, Array] = component.rate(given).state_rates
        return rates

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        rate = component.rate(inputs)
        return {**_parts(rate), **self._state_answers(component, rate.state_rates)}

    def answers_fit_a_run(self) -> None:
        """Rates are finite and not negative, 0 where the pressure is, one for each state field."""
        for material in (samples.STEEL, samples.BARE):
            try:
                guarded = GuardedLaw(self._make(), BODIES[0], material)
            except CaseError:
                if material is samples.BARE:
                    return
                raise
            for local in self._samples(guarded.component):
                guarded.rate(replace(local, material=material))

    def derivative_is_that_of_the_depth(self) -> None:
        """The derivative agrees with the differences of the depth in pressure."""
        law = self._make()
        hint = (
            "; if a field that it requires follows the pressure, say how: see 'Fields that follow "
            "the pressure' in docs/plugins.md"
        )
        step = 1e-5 * _LADDER
        for number in self._numbers:
            at, up, down = (self._at(law, number, _LADDER + s) for s in (0 * step, step, -step))
            apply_if(at.depth_slope is not None, "depth_slope is None: it is found by difference")
            forward = (up.depth_rate - at.depth_rate) / step
            backward = (at.depth_rate - down.depth_rate) / step
            slopes = np.stack([forward, backward, (forward + backward) / 2])
            # At a kink one side is right. Round-off of the depth is 1e-11 of depth/p.
            error = np.min(np.abs(at.depth_slope - slopes), axis=0)
            allowed = 1e-4 * np.maximum(np.abs(at.depth_slope), at.depth_rate / _LADDER)
            worst = np.unravel_index(int(np.argmax(error - allowed)), error.shape)
            require(
                error[worst] <= allowed[worst],
                f"at p = {_LADDER[worst[0], 0]:.3g} Pa{self._when(number)} the derivative is "
                f"{at.depth_slope[worst]:.6g} 1/Pa, but the depth changes by "
                f"{slopes[2][worst]:.6g} per Pa{hint if law.requires else ''}",
            )

    def depth_does_not_jump(self) -> None:
        """The depth follows the pressure without a jump, at which implicit steps have no answer."""
        law = self._make()
        for number in self._numbers:
            depth = self._at(law, number, _LADDER).depth_rate
            rise = np.abs(np.diff(depth, axis=0)) / np.maximum(depth[1:], 1e-300)
            at, point = np.unravel_index(int(np.argmax(rise)), rise.shape)

            def wears(p: float, number: int = number, point: Any = point) -> Array:
                return np.asarray(self._at(law, number, np.array([[p]])).depth_rate[0, point])

            where, left = jump(wears, *map(float, _LADDER[at : at + 2, 0]))
            size = float(np.max(depth[at : at + 2, point]))
            require(
                left <= 1e-6 * size,
                f"at p = {where:.6g} Pa{self._when(number)} the depth per metre jumps by "
                f"{left:.6g}, of up to {size:.6g}",
            )

    def depth_grows_with_pressure(self) -> None:
        """Where the derivative is not negative, more pressure never wears less."""
        law = self._make()
        for number in self._numbers:
            rate = self._at(law, number, _LADDER)
            falls = rate.depth_slope is None or np.any(rate.depth_slope < 0)
            apply_if(not falls, "its derivative is negative somewhere, or not stated")
            depth = rate.depth_rate
            at, point = np.unravel_index(int(np.argmin(np.diff(depth, axis=0))), depth[1:].shape)
            (low, high), (p, more) = depth[at : at + 2, point], _LADDER[at : at + 2, 0]
            require(
                high >= low * (1 - 1e-12),
                f"the depth per metre falls from {low:.6g} to {high:.6g} as the pressure rises "
                f"from {p:.3g} to {more:.3g} Pa{self._when(number)}",
            )

    def points_are_independent(self) -> None:
        """A point wears the same wherever it lies and whatever the other points do."""
        law = self._make()
        order = np.argsort(samples.pattern((_SHAPE[0] * _SHAPE[1],)))
        for local in self._samples(law):
            whole = _parts(law.rate(local))
            for what, chosen in (("in another order", order), ("left out by half", order[::2])):
                part = locked(_chosen(local, chosen))
                for name, found in _parts(law.rate(part)).items():
                    needed = np.broadcast_to(whole[name], _SHAPE).reshape(-1, 1)[chosen]
                    expect_close(f"{name} with points {what}", found, needed, 1e-12)

    def runs_under_implicit_stepping(self) -> None:
        """Under implicit steps and stroke averaging each body loses just what the law says."""
        law = self._make()
        depth = float(self._at(law, 3, np.array([[samples.PEAK]])).depth_rate[0, 0])
        distance = 0.3 * _APPROACH / depth if depth > 0 else 1.0
        motion = samples.sliding(float(np.clip(distance, 1e-3, 1e6)))
        samples.run(self._fields, law=law, kinematics=motion)

    def _at(self, law: Any, number: int, pressure: Array) -> WearRate:
        """Return the rate at some pressures, each at all points of a sample under pressure."""
        local = self._inputs(law, number)
        at = _chosen(local, np.flatnonzero(local.pressure))
        shape = (len(pressure), at.pressure.size)
        p = np.broadcast_to(pressure, shape).copy()
        spread = samples.pattern(_SHAPE, number + 7).reshape(-1)[np.flatnonzero(local.pressure)]
        state = {n: np.broadcast_to(v.T, shape).copy() for n, v in at.state.items()}
        fields = self._fields_at(law, p, np.broadcast_to(spread, shape))
        rate = law.rate(locked(replace(at, pressure=p, fields=fields, state=state)))
        slope: Any = rate.depth_slope
        if slope is not None:
            slope = np.broadcast_to(slope, shape)
        return WearRate(np.broadcast_to(rate.depth_rate, shape), slope)

    def _fields_at(self, law: Any, p: Array, spread: Array) -> dict[str, Array]:
        return samples.fields(law.requires, self._fields, p, spread)

    def _when(self, number: int) -> str:
        """Return at which speed, and when, a sample is."""
        slid = f", after up to {_FARTHEST:g} m" if self._aged.get(number) else ""
        return f" and {samples.SPEEDS[number % len(samples.SPEEDS)]:g} m/s{slid}"


def _chosen(local: LocalConditions, chosen: Any) -> LocalConditions:
    """Return conditions at some of the points, one below the other."""

    def choose(values: Array) -> Array:
        return np.asarray(values.reshape(-1, 1)[chosen])

    return replace(
        local,
        pressure=choose(local.pressure),
        fields={name: choose(values) for name, values in local.fields.items()},
        state={name: choose(values) for name, values in local.state.items()},
    )


def _parts(rate: WearRate) -> dict[str, Array]:
    """Return the arrays of a rate, by what they are called."""
    parts = {"depth_rate": rate.depth_rate, "depth_slope": rate.depth_slope}
    parts |= {rate_of(name): values for name, values in rate.state_rates.items()}
    return {name: values for name, values in parts.items() if values is not None}
