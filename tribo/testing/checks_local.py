"""What wear laws and effects must fulfil alike: they read fields, and may remember."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping
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
from tribo.testing import samples
from tribo.testing.ageing import aged
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
_ABOVE = 1e-9
_RUNGS = 33
"""Values of a state between which a jump of the rates is looked for."""

Altered = Callable[[Any, Any, str], Iterator[tuple[Any, Any]]]
"""Yields components and conditions in which what has a name is another than in those given."""


class LocalChecks(Checks):
    """Checks of what answers at each point, from fields and from a state of its own."""

    _longest_run: ClassVar[float]
    """How far a state goes in the longest runs: in m for a law, in s for an effect."""

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
        """Return conditions with a state that each point has had as `far` as that, from there."""
        if not given.state:
            return given
        model = self._guarded()

        def rates(state: Mapping[str, Array]) -> Mapping[str, Array]:
            return self._rates(model, locked(replace(given, state=state)))

        return locked(replace(given, state=aged(model, rates, given.state, far)))

    def _old(self, given: Any, part: float = 1.0) -> Any:
        """Return conditions after a part of the longest runs at each point."""
        return self._remembering(given, np.full(given.pressure.shape, part * self._longest_run))

    def _state_answers(self, component: Any, rates: Mapping[str, Array]) -> dict[str, Any]:
        """Return what a component answers of its state, by what that is called."""
        starts = component.initial_state().items()
        return {rate_of(name): values for name, values in rates.items()} | {
            initial(name): value for name, value in starts
        }

    def _each(self) -> list[Any]:
        """Return the checks of every configuration, this one's first."""
        others = [each for each in self._others if each is not self._config]
        return [self, *(type(self)(each, self._fields) for each in others)]

    def _expect_all_to_matter(self, names: set[str], altered: Altered, fault: str) -> None:
        """Fail if one of the names alters no answer, in one configuration at least.

        The rate of a state is no answer to the state itself.
        """
        for checks in self._each():
            component = checks._make()
            for given in checks._samples():
                before = checks._call(component, given)
                for name in sorted(names):
                    own = {rate_of(name): None}
                    after = (checks._call(*pair) for pair in altered(component, given, name))
                    if any(first_difference({**before, **own}, {**each, **own}) for each in after):
                        names = names - {name}
        require(not names, f"{', '.join(sorted(names))}: {fault}")

    def configuration_matters(self) -> None:
        """Each number that is given changes an answer, in one configuration at least."""
        names = {name for name in self._cls.model_fields if _is_given(self._config, name)}
        apply_if(names, "no number is given but defaults and 0")

        def altered(component: Any, given: Any, name: str) -> Iterator[tuple[Any, Any]]:
            for times in (0.5, 2.0) if getattr(component, name) else ():
                yield renewed(component, {name: times * getattr(component, name)}), given

        self._expect_all_to_matter(names, altered, "half as much, or twice, changes no answer")

    def states_move_and_matter(self) -> None:
        """Each state field moves, and changes the wear, another state or who requires it."""
        names = {field.name for field in self._make().state_fields}
        apply_if(names, "it keeps no state")
        every = [
            each._call(each._make(), given) for each in self._each() for given in each._samples()
        ]
        moved = {
            name for name in names for answers in every if np.any(answers.get(rate_of(name), 0))
        }
        require(moved == names, f"the state {', '.join(sorted(names - moved))} never moves")

        def altered(component: Any, given: Any, name: str) -> Iterator[tuple[Any, Any]]:
            if name in given.state:
                yield component, _at(given, name, component.initial_state()[name])

        self._expect_all_to_matter(names, altered, "the state alters nothing")

    def rates_jump_at_breaks_alone(self) -> None:
        """Where an answer jumps as a state changes, the field declares a break."""
        component = self._make()
        apply_if(component.state_fields, "it keeps no state")
        for given, field in product(self._samples()[:2], component.state_fields):
            values = given.state[field.name]
            ladder = np.linspace(np.min(values), np.max(values), _RUNGS)
            # A kink of the depth is no jump.
            names = _arrays(self._call(component, given)) - {"depth_slope"}
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
        """A rate does not lead beyond a limit of its state; without one it does not run away.

        Nor does the wear: over 1e6 m of sliding no rate grows without end.
        """
        component = self._make()
        apply_if(component.state_fields, "it keeps no state")
        sides = (("at_least", -1.0), ("at_most", 1.0))
        for given, field, (side, sign) in product(self._samples(), component.state_fields, sides):
            name, limit = field.name, getattr(field, side)
            most = sign * max(float(np.max(np.abs(given.state[name]))), 1e-300)
            values = (1e3 * most, 1e6 * most) if limit is None else (limit, limit)
            with np.errstate(all="ignore"):
                rates = (self._rates(component, _at(given, name, value)) for value in values)
                near, far = (sign * np.asarray(of_states[name]) for of_states in rates)
            if limit is not None:
                within = np.max(near) <= 0
                require(within, f"{name!r} leads beyond its limit of {limit:g} {field.unit}")
                continue
            away = (near > 0) & (far > 100 * near) & np.isfinite(far)
            require(
                not np.any(away),
                f"{name!r} changes the faster the further it has gone, without end: is the "
                "sign of its rate right? A limit that it keeps is declared with its field",
            )
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
        asked = samples.Asked(given.fields)
        with suppress(KeyError):
            self._call(self._make(), replace(given, fields=asked))
        missed = ", ".join(sorted(asked.missed))
        require(not missed, f"it asked for {missed}; add that to requires")

    def required_fields_matter(self) -> None:
        """Each field or property of materials that it requires changes an answer at least once."""
        model = self._make()
        properties = {field.name for field in model.material_properties}
        names = {*names_of(model.requires), *properties}
        apply_if(names, "it requires no field")

        def altered(component: Any, given: Any, name: str) -> Iterator[tuple[Any, Any]]:
            if name in given.fields:
                more = mapped(given.fields[name], lambda _, values: 1.01 * values)
                yield component, locked(replace(given, fields={**given.fields, name: more}))
            if name in properties:
                yield component, mapped(given, lambda _, value: _with_more(value, name))

        self._expect_all_to_matter(names, altered, "no answer changes by 1 % more of it")


def _at(given: Any, name: str, value: float) -> Any:
    """Return conditions in which one state field has one value."""
    state = {**given.state, name: np.full_like(given.state[name], value)}
    return locked(replace(given, state=state))


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


def _arrays(answers: Mapping[str, Any]) -> set[str]:
    """Return the names of the answers that are arrays."""
    return {name for name, values in answers.items() if np.ndim(values) > 0}
