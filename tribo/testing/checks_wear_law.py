"""What every wear law must fulfil."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.fields import WORN_DEPTH, Field, LocalConditions
from tribo.guards.parts import GuardedLaw
from tribo.testing import samples
from tribo.testing.checks import BODIES
from tribo.testing.checks_local import LocalChecks
from tribo.testing.compare import locked, require

_SHAPES = ((2, 7, 6), (2, 7, 7), (2, 7, 6), (2, 7, 6))
"""Of the samples: two positions of a cycle, each with a speed of its own."""
_PRESSURE = Field("pressure", "Pa", "Contact pressure.")
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
        shape = _SHAPES[number]
        spread = samples.pattern(shape, number)
        # The third over four decades.
        parts = 1e-4**spread if number == 2 else 0.02 + 0.98 * spread
        pressure = samples.PEAK / (1 + number) * parts
        fields = self._fields_at(component, pressure, number)
        state = {name: np.full(shape, v) for name, v in component.initial_state().items()}
        speed = np.array(np.roll(samples.SPEEDS, -number)[:2]).reshape(2, 1, 1)
        material = samples.for_models(samples.STEEL, component)
        local = LocalConditions(pressure, speed, material, fields, state)
        if number < 3:
            local = self._remembering(local, _FARTHEST * spread**3)
        # In a third of the points there is no pressure any more.
        touching = samples.pattern(shape, number + 3) > 0.3
        return replace(local, pressure=np.where(touching, pressure, 0.0))

    def _fields_at(self, law: Any, pressure: Array, number: int) -> dict[str, Array]:
        spread = samples.pattern(pressure.shape, number + 7)
        return samples.fields(samples.required(law), pressure, spread)

    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        rates: Mapping[str, Array] = component.rate(given).state_rates
        return rates

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        rate = component.rate(inputs)
        slope = {} if rate.depth_slope is None else {"depth_slope": rate.depth_slope}
        state = self._state_answers(component, rate.state_rates)
        return {"depth_rate": rate.depth_rate, **slope, **state}

    def _under(self, number: int, pressure: Array) -> LocalConditions:
        fields = self._fields_at(self._config, pressure, number)
        given: LocalConditions = replace(self._sample(number), pressure=pressure, fields=fields)
        return locked(given)

    def _depth(self, number: int, pressure: float) -> Array:
        """Return the depth with one pressure at all points of a sample."""
        under = self._under(number, np.full(_SHAPES[number], pressure))
        return np.broadcast_to(self._make().rate(under).depth_rate, _SHAPES[number])

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

    def _climbs(self, component: Any) -> Iterator[tuple[Field, Array, Callable[[float], Any]]]:
        yield from super()._climbs(component)
        for number in self._numbers:

            def answers(pressure: float, number: int = number) -> Any:
                return {"depth_rate": self._depth(number, pressure) / pressure}

            yield _PRESSURE, _LADDER, answers

    def runs_under_implicit_stepping(self) -> None:
        """Under implicit steps and stroke averaging each body loses just what the law says."""
        depth = float(self._depth(3, samples.PEAK).flat[0])
        distance = 0.3 * _APPROACH / depth if depth > 0 else 1.0
        motion = samples.sliding(float(np.clip(distance, 1e-3, 1e6)))
        samples.run(lambda: {"law": self._make(), "kinematics": motion})
