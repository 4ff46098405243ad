"""The common contract of wear laws and effects, which read fields and may have states."""

from __future__ import annotations

from abc import abstractmethod
from collections import UserDict
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import product
from typing import Any, ClassVar

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import Field, names_of
from tribo.core.material import Material
from tribo.core.units import quantities
from tribo.guards.answers import initial, rate_of
from tribo.guards.parts import GuardedEffect, GuardedLaw
from tribo.integration.step_to_break import lasting
from tribo.testing import samples
from tribo.testing.checks import Checks
from tribo.testing.compare import (
    apply_if,
    first_difference,
    largest_jump,
    locked,
    mapped,
    require,
)
from tribo.testing.rescaling import renewed, units_of

_DECADE, _GROWS, _MUCH = 0.1, 5.0, 20.0
"""A rate that grows as much over the last decade of a run, and in all, grows without end."""
_ABOVE, _NUDGE = 1e-9, 1e-3
_RUNGS = 33
"""Values of a state between which a jump of the rates is looked for."""


class LocalChecks(Checks):
    """Checks of what answers at each point, from fields and from a state of its own."""

    _longest_run: ClassVar[float]
    """Length of the longest runs: in m for a law, in s for an effect."""

    def _units(self, component: Any) -> Mapping[str, float]:
        known = {name: samples.declared(name) for name in names_of(component.requires)}
        given = {name: field for name, field in known.items() if field is not None}
        unknown = ", ".join({*known} - {*given})
        apply_if(not unknown, f"the unit of {unknown} is not known: no effect here declares it")
        given |= {field.name: field for field in component.state_fields}
        return {**super()._units(component), **units_of(given)}

    @abstractmethod
    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        """Return the rates of the state."""

    @abstractmethod
    def _guarded(self) -> GuardedEffect | GuardedLaw:
        """Return a new component, held to its contract."""

    def _remembering(self, given: Any, far: Array) -> Any:
        """Return conditions after each point has gone as far as `far` from there, within limits.

        Exponential Euler steps that grow; what relaxes does not pass where it tends to.
        """
        model, now = self._guarded(), dict(given.state)

        def rates(state: Mapping[str, Array]) -> Mapping[str, Array]:
            return self._rates(model, locked(replace(given, state=state)))

        for share in np.diff(np.geomspace(1e-8, 1.0, 40), prepend=0.0) if now else ():
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
        return locked(replace(given, state=now))

    def _old(self, given: Any, part: float = 1.0) -> Any:
        """Return conditions after a part of the longest runs at each point."""
        return self._remembering(given, np.full(given.pressure.shape, part * self._longest_run))

    def _state_answers(self, component: Any, rates: Mapping[str, Array]) -> dict[str, Any]:
        """Return the answers of a component on its state, by name."""
        starts = component.initial_state().items()
        return {rate_of(name): values for name, values in rates.items()} | {
            initial(name): value for name, value in starts
        }

    def what_is_declared_matters(self) -> None:
        """Each number given, state, required field and property alters an answer.

        In one configuration at least. The rate of a state is no answer to the state itself, and a
        state that never moves alters nothing.
        """
        model = self._make()
        idle = {("number", name) for name in self._cls.model_fields if _is_given(model, name)}
        idle |= {("state", field.name) for field in model.state_fields}
        idle |= {("required field", name) for name in names_of(model.requires)}
        idle |= {("property", field.name) for field in model.material_properties}
        apply_if(idle, "it has no number but defaults and 0, no state, and requires nothing")
        for config in self._configs:
            checks = self if config is self._config else type(self)(config)
            component = checks._make()
            for given in checks._samples():
                usual = checks._call(component, given)
                for what, name in sorted(idle):
                    own = {rate_of(name): None}
                    for pair in _altered(component, given, what, name):
                        if first_difference({**usual, **own}, {**checks._call(*pair), **own}):
                            idle.discard((what, name))
        listed = ", ".join(f"the {what} {name!r}" for what, name in sorted(idle))
        require(not idle, f"no answer changes with {listed}")

    def rates_jump_at_breaks_alone(self) -> None:
        """Where an answer jumps as a state changes, the field declares a break."""
        component = self._make()
        apply_if(component.state_fields, "it keeps no state")
        for given, field in product(self._samples()[:2], component.state_fields):
            values = given.state[field.name]
            ladder = np.linspace(np.min(values), np.max(values), _RUNGS)
            # A kink of the depth is no jump.
            answers = self._call(component, given)
            names = {name for name in answers if np.ndim(answers[name])} - {"depth_slope"}
            for name in sorted(names) if np.ptp(ladder) else ():

                def answer(
                    value: float, given: Any = given, field: Field = field, name: str = name
                ) -> Array:
                    found = self._call(component, _at(given, field.name, value))
                    return np.asarray(found[name])

                where, part = largest_jump(answer, ladder)
                known = any(abs(each - where) <= 1e-6 * np.ptp(ladder) for each in field.breaks)
                require(
                    known or part <= 1e-6,
                    f"as {field.name!r} passes {where:.6g} {field.unit}, {name!r} jumps by "
                    f"{part:.3g} of its size; declare that with its field, as breaks",
                )
                for limit in field.breaks:
                    at, above = (answer(value) for value in (limit, limit * (1 + _ABOVE)))
                    require(
                        np.allclose(at, above, rtol=1e-6, atol=0),
                        f"at its break {limit:.6g}, {field.name!r} has not the {name!r} above it",
                    )

    def states_can_last(self) -> None:
        """A rate does not lead beyond a limit of its state, nor grow without end over 1e6 m."""
        component = self._make()
        apply_if(component.state_fields, "it keeps no state")
        for given, field in product(self._samples(), component.state_fields):
            for limit, sign in ((field.at_least, -1.0), (field.at_most, 1.0)):
                if limit is None:
                    continue
                with np.errstate(all="ignore"):
                    rates = self._rates(component, _at(given, field.name, limit))[field.name]
                within = np.max(sign * np.asarray(rates)) <= 0
                require(within, f"{field.name!r} leads beyond its limit of {limit:g} {field.unit}")
        for given in self._samples():
            ages = given, self._old(given, _DECADE), self._old(given)
            answers = [self._call(component, at) for at in ages]
            names = {"depth_rate", *(rate_of(field.name) for field in component.state_fields)}
            for name in names & {*answers[0]}:
                first, later, last = (np.abs(each[name]) for each in answers)
                grows = (last > _GROWS * later) & (last > _MUCH * first)
                require(
                    np.count_nonzero(grows) <= 0.5 * np.count_nonzero(last),
                    f"{name!r} is up to {np.max(first):.3g} after some metres, {np.max(later):.3g} "
                    f"and {np.max(last):.3g} after a tenth and all of the longest runs: it has no "
                    "end",
                )

    def only_declared_fields_are_asked_for(self) -> None:
        """It asks for no field but those in `requires`."""
        given = self._sample()
        asked = Asked(given.fields)
        with suppress(KeyError):
            self._call(self._make(), replace(given, fields=asked))
        missed = ", ".join(sorted(asked.missed))
        require(not missed, f"it asked for {missed}; add that to requires")


class Asked(UserDict[str, Any]):
    """A mapping that records the names of failed look-ups."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        super().__init__(values)
        self.missed: set[str] = set()

    def __missing__(self, name: str) -> Any:
        self.missed.add(name)
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        if name not in self.data:
            self.missed.add(str(name))
        return name in self.data


def _at(given: Any, name: str, value: float) -> Any:
    """Return conditions in which one state field has one value."""
    state = {**given.state, name: np.full_like(given.state[name], value)}
    return locked(replace(given, state=state))


def _altered(component: Any, given: Any, what: str, name: str) -> Iterator[tuple[Any, Any]]:
    """Yield the component and its conditions with another value of what has a name."""
    if what == "number" and (value := getattr(component, name)):
        yield from ((renewed(component, {name: times * value}), given) for times in (0.5, 2.0))
    if what == "state" and name in given.state:
        yield component, _at(given, name, component.initial_state()[name])
    if what == "required field" and name in given.fields:
        more = mapped(given.fields[name], lambda _, values: 1.01 * values)
        yield component, locked(replace(given, fields={**given.fields, name: more}))
    if what == "property":
        yield component, mapped(given, lambda _, value: _with_more(value, name))


def _with_more(value: Any, name: str) -> Any:
    """Return a material with 1 % more of a property, and anything else as it is."""
    if not isinstance(value, Material):
        return value
    more = {name: 1.01 * value.property(name)}
    return value.model_copy(update={**more, "properties": {**(value.properties or {}), **more}})


def _is_given(config: Any, name: str) -> bool:
    """Whether a field holds a quantity that is neither 0 nor its default."""
    field, value = type(config).model_fields[name], getattr(config, name)
    marked = any(quantities(field))
    return marked and isinstance(value, float) and value not in (0, field.default)
