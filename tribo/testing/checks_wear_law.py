"""What every wear law must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.fields import WORN_DEPTH, LocalConditions, names_of
from tribo.guards.parts import GuardedLaw
from tribo.testing import samples
from tribo.testing.checks import BODIES
from tribo.testing.checks_local import LocalChecks
from tribo.testing.compare import apply_if, expect_close, largest_jump, locked, mapped, require

_SHAPE = (2, 7, 6)
"""Two positions of a cycle, each with a speed of its own."""
_SQUARE = (9, 9)
# Not an order of magnitude apart, so that a pressure between two is like both.
_LADDER = np.geomspace(1e5, samples.PEAK, 160)
_APPROACH = 2.2e-6
"""Of the small case, in m."""
_FARTHEST = 30.0
"""Distance that the points of the samples have slid at most, in m."""


class WearLawChecks(LocalChecks):
    """Checks of a wear law, at several speeds, fresh and after some metres."""

    _numbers = (0, 1, 2, 3)
    _longest_run = 1e6

    def _guarded(self) -> GuardedLaw:
        return GuardedLaw(self._make(), BODIES[0], samples.for_models(samples.STEEL, self._config))

    def _inputs(self, component: Any, number: int) -> LocalConditions:
        """Return conditions of points that each have slid a distance of their own; 3: none."""
        pressure = samples.PEAK / (1 + number) * (0.02 + 0.98 * samples.pattern(_SHAPE, number))
        fields = self._fields_at(component, pressure, number)
        state = {name: np.full(_SHAPE, v) for name, v in component.initial_state().items()}
        speed = np.array(np.roll(samples.SPEEDS, -number)[:2]).reshape(2, 1, 1)
        material = samples.for_models(samples.STEEL, component)
        local = LocalConditions(pressure, speed, material, fields, state)
        if number < 3:
            local = self._remembering(local, _FARTHEST * samples.pattern(_SHAPE, number) ** 3)
        # In every third point there is no pressure any more.
        touching = (np.arange(pressure.size) % 3 > 0).reshape(_SHAPE)
        return replace(local, pressure=np.where(touching, pressure, 0.0))

    def _fields_at(self, law: Any, pressure: Array, number: int) -> dict[str, Array]:
        spread = samples.pattern(_SHAPE, number + 7)
        return samples.fields(names_of(law.requires), pressure, spread)

    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        rates: Mapping[str, Array] = component.rate(given).state_rates
        return rates

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        rate = component.rate(inputs)
        slope = {} if rate.depth_slope is None else {"depth_slope": rate.depth_slope}
        state = self._state_answers(component, rate.state_rates)
        return {"depth_rate": rate.depth_rate, **slope, **state}

    def _wear(self, law: Any, number: int, pressure: float) -> tuple[Array, Any]:
        """Return depth and slope with one pressure at all points of a sample."""
        p = np.full(_SHAPE, pressure)
        fields = self._fields_at(law, p, number)
        rate = law.rate(locked(replace(self._sample(number), pressure=p, fields=fields)))
        slope = rate.depth_slope
        return (
            np.broadcast_to(rate.depth_rate, _SHAPE),
            None if slope is None else np.broadcast_to(slope, _SHAPE),
        )

    def answers_fit_a_run(self) -> None:
        """Rates are finite and not negative, 0 where the pressure is, one for each state field.

        However far its points have slid.
        """
        for bare in (samples.STEEL, samples.BARE):
            material = samples.for_models(bare, self._config)
            try:
                guarded = GuardedLaw(self._make(), BODIES[0], material)
            except CaseError:
                if bare is samples.BARE:
                    return
                raise
            for local in self._samples():
                for at in (local, self._old(local)):
                    rate = guarded.rate(replace(at, material=material))
                    stated = guarded.component.rate(at).state_rates.get(WORN_DEPTH.name)
                    same = stated is None or np.array_equal(stated, rate.depth_rate)
                    require(same, f"the rate of {WORN_DEPTH.name!r} is not depth_rate")

    def derivative_is_that_of_the_depth(self) -> None:
        """The derivative agrees with the differences of the depth in pressure."""
        law = self._make()
        hint = (
            "; if a field that it requires follows the pressure, say how: see 'Wear laws' on "
            "the page 'Plugin interface'"
        )
        for number, p in product(self._numbers, _LADDER.tolist()):
            depth, slope = self._wear(law, number, p)
            apply_if(slope is not None, "depth_slope is None: it is found by difference")
            step = 1e-5 * p
            forward = (self._wear(law, number, p + step)[0] - depth) / step
            backward = (depth - self._wear(law, number, p - step)[0]) / step
            # At a kink one side is right. Round-off of the depth is 1e-11 of depth/p.
            slopes = np.stack([forward, backward, (forward + backward) / 2])
            error = np.min(np.abs(slope - slopes), axis=0)
            excess = error - 1e-4 * np.maximum(np.abs(slope), depth / p)
            worst = np.unravel_index(int(np.argmax(excess)), _SHAPE)
            require(
                excess[worst] <= 0,
                f"at p = {p:.3g} Pa{self._when(number)} the derivative is {slope[worst]:.6g} 1/Pa, "
                f"but the depth changes by {slopes[2][worst]:.6g} per Pa"
                f"{hint if law.requires else ''}",
            )

    def depth_does_not_jump(self) -> None:
        """The depth follows the pressure without a jump, at which implicit steps have no answer."""
        law = self._make()
        for number in self._numbers:

            def coefficient(pressure: float, number: int = number) -> Array:
                return self._wear(law, number, pressure)[0] / pressure

            where, part = largest_jump(coefficient, _LADDER)
            require(
                part <= 1e-6,
                f"at p = {where:.6g} Pa{self._when(number)} the depth per metre jumps by "
                f"{part:.3g} of its size",
            )

    def points_are_independent(self) -> None:
        """A point wears the same wherever it lies and whatever the other points do."""
        law = self._make()
        order = np.argsort(samples.pattern((int(np.prod(_SHAPE)),)))
        for local in self._samples():
            answers = self._call(law, local)
            whole = {name: np.broadcast_to(values, _SHAPE) for name, values in answers.items()}
            for what, chosen, shape in (
                ("in another order", order, (-1, 1)),
                # Those that have slid least, in the first sample.
                ("left out by half", order[: order.size // 2], (-1, 1)),
                ("in a square", order[: _SQUARE[0] * _SQUARE[1]], _SQUARE),
            ):
                part = self._call(law, locked(_chosen(local, chosen, shape)))
                expect_close(f"with points {what}", part, _chosen(whole, chosen, shape), 1e-12)

    def runs_under_implicit_stepping(self) -> None:
        """Under implicit steps and stroke averaging each body loses just what the law says."""
        law = self._make()
        depth = float(self._wear(law, 3, samples.PEAK)[0].flat[0])
        distance = 0.3 * _APPROACH / depth if depth > 0 else 1.0
        motion = samples.sliding(float(np.clip(distance, 1e-3, 1e6)))
        samples.run(lambda: {"law": self._make(), "kinematics": motion})

    def _when(self, number: int) -> str:
        """Return at which speed, and when, a sample is."""
        slid = f", after up to {_FARTHEST:g} m" if number < 3 and self._sample(number).state else ""
        speeds = " or ".join(f"{speed:g}" for speed in self._sample(number).speed.flat)
        return f" and {speeds} m/s{slid}"


def _chosen(given: Any, chosen: Any, shape: tuple[int, int]) -> Any:
    """Return conditions or answers at some of the points, in another shape."""

    def choose(_: tuple[Any, ...], value: Any) -> Any:
        if not isinstance(value, np.ndarray):
            return value
        return np.broadcast_to(value, _SHAPE).reshape(-1)[chosen].reshape(shape)

    return mapped(given, choose)
