"""What every effect must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np

from tribo.contract import initial
from tribo.core.arrays import Array
from tribo.core.fields import ContactConditions
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.rounding import ROUND_OFF
from tribo.core.state import Snapshot
from tribo.effects.effect import Effect
from tribo.guards.parts import GuardedEffect
from tribo.testing import samples
from tribo.testing.checks import BODIES
from tribo.testing.checks_local import LocalChecks
from tribo.testing.compare import (
    apply_if,
    expect_close,
    first_difference,
    locked,
    mapped,
    require,
    values_in,
)
from tribo.testing.samples import GRID

_LONGEST = 60.0
"""Time for which a state has been there at most, in s."""
_FAR = 100.0
"""Times as far from its start as the state of a sample, where its limits hold it."""
_FINER = 0.1
"""What cells of a third and a fifth may change of a smooth field."""
_FOLLOWED = ("pressure", "state", "wear_rates")
"""What answers follow at each point."""
_NUDGE = 1e-5
"""Part by which all that fields follow is varied."""


class EffectChecks(LocalChecks):
    """Checks of an effect."""

    _numbers = (0, 1, 2, 3)

    _longest_run = 1e6 / samples.SPEED

    def _guarded(self) -> GuardedEffect:
        return GuardedEffect(self._make(), self._bodies)

    def _old(self, given: Any, part: float = 1.0) -> Any:
        # Where points act on each other, each cannot age by itself.
        apart = self._config.reach in ("point", "contact")
        return super()._old(given, part) if apart else given

    def _inputs(self, component: Any, number: int) -> ContactConditions:
        """Return conditions by number, with a state of some age at each point; 3: at rest."""
        fresh = samples.contact_conditions(component, number % 3, self._bodies)
        at: ContactConditions = self._remembering(
            fresh, _LONGEST * samples.pattern(GRID.cells) ** 3
        )
        return replace(at, speed=0.0) if number == 3 else at

    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        rates: Mapping[str, Array] = component.state_rates(given)
        return rates

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        fields = component.fields(replace(inputs, wear_rates={}))
        provided = {name: dict(values) for name, values in fields.items()}
        rates = component.state_rates(inputs) if inputs.state else {}
        # A state itself is the answer to whoever requires its name.
        return {**provided, **inputs.state, **self._state_answers(component, rates)}

    def _asked(self, component: Any, given: Any) -> Mapping[str, Any]:
        answers = self._call(component, given)
        if type(component).load_factor is not Effect.load_factor:
            answers = {**answers, "load_factor": float(component.load_factor(self._last))}
        return answers

    @cached_property
    def _last(self) -> Snapshot:
        return samples.run(lambda: {"effects": [self._make()]})

    def answers_fit_a_run(self) -> None:
        """Each declared field comes for each body, finite, within its limits, on the window.

        At rest too, whichever bodies move, and however far its state has gone.
        """
        effect = self._guarded()
        for given in self._samples():
            moving = ((), BODIES[:1], BODIES)
            turns = [replace(given, swept=frozenset(names)) for names in moving]
            for at in (given, *turns, _gone_far(effect, given), self._old(given)):
                effect.fields(replace(at, wear_rates={}))
                effect.state_rates(at)

    def another_window_changes_little(self) -> None:
        """In a wider window, and on finer cells, the same points follow their conditions alike."""
        effect, inner = self._make(), samples.wider(GRID, -1)
        windows = (
            (samples.wider(GRID), samples.inside, 0.0),
            (samples.finer(GRID, (3, 5)), lambda values: values[1::3, 2::5], _FINER),
        )
        for given, what, (grid, at_same, part) in product(self._samples(), _FOLLOWED, windows):
            usual, less, other, other_less = (
                values_in(self._call(effect, _on(window, given, halved)))
                for window in (GRID, grid)
                for halved in ("", what)
            )
            # How it follows that: to a temperature of the air all is small.
            for where, value in usual.items():
                needed = np.broadcast_to(value - less[where], GRID.cells)
                found = np.broadcast_to(other[where] - other_less[where], grid.cells)
                off = np.max(np.abs(samples.inside(at_same(found) - needed, inner)))
                size = np.max(np.abs(needed))
                require(
                    off <= part * size + ROUND_OFF * np.max(np.abs(value)),
                    f"{where} follows {what} by up to {size:.3g}, and differs by {off:.3g} from "
                    f"that in a window of {grid.size} m with {grid.cells} cells",
                )

    def state_is_all_that_remembers(self) -> None:
        """Fields follow no wear, which follows from them; what keeps a state, no distance slid."""
        effect = self._make()
        for given in self._samples():
            unworn = effect.fields(replace(given, wear_rates={}))
            where = first_difference(effect.fields(given), unworn)
            require(where is None, f"{where} follows contact.wear_rates; let a state follow them")
            later = self._call(effect, replace(given, distance=3 * given.distance))
            where = given.state and first_difference(self._call(effect, given), later)
            require(not where, f"{where} follows contact.distance beside the state")

    def product_is_that_of_differences(self) -> None:
        """What `pull_back` answers are the derivatives of each field in all that it follows."""
        apply_if(self._cls.pull_back is not Effect.pull_back, "it states no product")
        pattern = samples.pattern(GRID.cells)
        for given in self._samples():
            told = mapped(given, lambda _, v: dict(v) if isinstance(v, Material) else v)
            values = values_in(told) | values_in(self._config.model_dump())
            less, more = (self._fields_beside(given, by) for by in (-_NUDGE, _NUDGE))
            # Of all fields at once, in parts of what each of them has at most.
            seeds = mapped(more, lambda _, v: pattern / (np.max(np.abs(v)) or 1.0))
            found = self._make().pull_back(given, locked(seeds))
            parts = (np.sum(by * _beside(values[path], 1.0)) for path, by in found.items())
            ends = zip(*(values_in(each).values() for each in (seeds, less, more)), strict=True)
            changes = (np.sum(seed * (high - low)) for seed, low, high in ends)
            needed = float(sum(changes)) / (2 * _NUDGE)
            expect_close("change of the fields by the product", float(sum(parts)), needed, 1e-3)

    def _fields_beside(self, given: ContactConditions, by: float) -> Mapping[str, Any]:
        """Return the fields where each number that they may follow differs by a part of itself."""

        def other(_: object, value: Any) -> Any:
            if isinstance(value, Material):
                return Material.model_validate(mapped(dict(value), other))
            return value + _beside(value, by) if isinstance(value, float | np.ndarray) else value

        effect = self._cls.model_validate(mapped(self._config.model_dump(), other))
        fields: Mapping[str, Any] = effect.fields(mapped(given, other))
        return fields

    def runs_in_a_case(self) -> None:
        """In a small case it gives its fields in every step."""
        samples.run(lambda: {"effects": [self._make()]})


def _beside(value: Any, by: float) -> Any:
    """Return the variation of a number, or of each cell of an array, as a part of itself."""
    return by * value * (0.5 + samples.pattern(np.shape(value))) if np.ndim(value) else by * value


def _on(grid: Grid, given: ContactConditions, halved: str) -> ContactConditions:
    """Return conditions in another window, smooth there, with half of one of what it follows."""
    x, y = (axis / length for axis, length in zip(grid.mesh, GRID.size, strict=True))
    wave = 0.5 + 0.5 * np.sin(4 * x + 3 * y + 1) * np.cos(3 * y - 2 * x)
    # With an edge without a jump of its slope.
    pressure = np.max(given.pressure) * (samples.hertz_pressure(grid) / samples.PEAK) ** 4

    def smooth(path: tuple[Any, ...], value: Any) -> Any:
        if not isinstance(value, np.ndarray):
            return value
        new = np.min(value) + np.ptp(value) * wave if value.size > 1 else value
        return (0.5 if path[0] == halved else 1.0) * (pressure if path[0] == "pressure" else new)

    system = replace(given.system, grid=grid)
    return locked(replace(mapped(given, smooth), system=system))


def _gone_far(effect: GuardedEffect, given: ContactConditions) -> ContactConditions:
    """Return conditions with a state a hundred times as far from its start, within its limits."""
    start, answers = effect.initial_state, effect.answers
    state = {
        name: np.clip(start[name] + _FAR * (now - start[name]), *answers[initial(name)].range)
        for name, now in given.state.items()
    }
    return locked(replace(given, state=state))
