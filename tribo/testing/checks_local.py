"""What wear laws and effects must fulfil alike: they read fields, and may remember."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import Field
from tribo.core.units import quantities
from tribo.guards.answers import answers_of, initial, rate_of
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

_RUNGS = 33
"""Values of a state between which a jump of the rates is looked for."""

Altered = Callable[[Any, Any, str], Iterator[tuple[Any, Any]]]
"""Yields components and conditions in which what has a name is another than in those given."""


class LocalChecks(Checks):
    """Checks of what answers at each point, from fields and from a state of its own."""

    def _units(self, component: Any) -> Mapping[str, float]:
        given = [*map(samples.known_field, component.requires), *component.state_fields]
        return {**super()._units(component), **units_of({each.name: each for each in given})}

    @abstractmethod
    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        """Return the rates of the state."""

    def _remembering(self, given: Any, far: Array) -> Any:
        """Return conditions with a state that each point has had as `far` as that."""
        component = self._make()

        def rates(state: Mapping[str, Array]) -> Mapping[str, Array]:
            return self._rates(component, locked(replace(given, state=state)))

        return replace(given, state=aged(component.state_fields, rates, given.state, far))

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
            for given, name in product(checks._samples(), sorted(names)):
                own = {rate_of(name): None}
                before = {**checks._call(component, given), **own}
                for pair in altered(component, given, name):
                    if first_difference(before, {**checks._call(*pair), **own}):
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

    def states_keep_their_limits(self) -> None:
        """At a limit of a state field, its rate does not lead beyond."""
        component = self._make()
        limited = [each for each in _sides(component) if each[1] is not None]
        apply_if(limited, "no state field has a limit")
        for given, (field, limit, sign) in product(self._samples(), limited):
            rates = self._rates(component, _at(given, field.name, limit))
            beyond = float(np.max(sign * np.asarray(rates[field.name])))
            unit = answers_of(component)[rate_of(field.name)].unit
            require(
                beyond <= 0,
                f"{field.name!r} at its limit of {limit:g} {field.unit} changes by "
                f"{sign * beyond:.3g} {unit}",
            )

    def rates_jump_at_breaks_alone(self) -> None:
        """Where an answer jumps as a state changes, the field declares a break."""
        component = self._make()
        apply_if(component.state_fields, "it keeps no state")
        for given, field in product(self._samples()[:2], component.state_fields):
            values = given.state[field.name]
            ladder = np.linspace(np.min(values), np.max(values), _RUNGS)
            for name in _arrays(self._call(component, given)) if np.ptp(ladder) else ():

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

    def states_do_not_run_away(self) -> None:
        """A state without a limit does not grow the faster the more there is of it."""
        component = self._make()
        free = [(field.name, sign) for field, limit, sign in _sides(component) if limit is None]
        apply_if(free, "each state field has limits, or there is none")
        for given, (name, sign) in product(self._samples(), free):
            most = sign * max(float(np.max(np.abs(given.state[name]))), 1e-300)
            with np.errstate(all="ignore"):
                slow, fast = (
                    sign * self._rates(component, _at(given, name, times * most))[name]
                    for times in (1e3, 1e6)
                )
            away = (slow > 0) & (fast > 100 * slow) & np.isfinite(fast)
            require(
                not np.any(away),
                f"{name!r} changes the faster the further it has gone, without end: is the "
                "sign of its rate right? A limit that it keeps is declared with its field",
            )

    def only_declared_fields_are_asked_for(self) -> None:
        """It asks for no field but those in `requires`, and for no state but its own."""
        component, given = self._make(), self._sample()
        fields, state = samples.Asked(given.fields), samples.Asked(given.state)
        missed = {"requires": fields.missed}
        try:
            self._call(component, replace(given, fields=fields, state=state))
        except KeyError:
            if not (fields.missed or state.missed):
                raise
            # Whether it has a state, which its configuration says, it may look.
            missed["state_fields"] = state.missed
        for declared, names in missed.items():
            told = ", ".join(sorted(map(str, names)))
            require(not told, f"it asked for {told}; add that to {declared}")

    def required_fields_matter(self) -> None:
        """Each field that it requires changes an answer, in one configuration at least."""
        names = {*self._make().requires}
        apply_if(names, "it requires no field")

        def altered(component: Any, given: Any, name: str) -> Iterator[tuple[Any, Any]]:
            if name in given.fields:
                more = mapped(given.fields[name], lambda _, values: 1.01 * values)
                yield component, locked(replace(given, fields={**given.fields, name: more}))

        self._expect_all_to_matter(names, altered, "no answer changes by 1 % more of it")


def _sides(component: Any) -> list[tuple[Field, Any, float]]:
    """Return each state field with its lower and its upper limit, and on which side that is."""
    return [
        (field, limit, sign)
        for field in component.state_fields
        for limit, sign in ((field.at_least, -1.0), (field.at_most, 1.0))
    ]


def _at(given: Any, name: str, value: float) -> Any:
    """Return conditions in which one state field has one value."""
    state = {**given.state, name: np.full_like(given.state[name], value)}
    return locked(replace(given, state=state))


def _is_given(config: Any, name: str) -> bool:
    """Whether a field holds a quantity that is neither 0 nor its default."""
    field, value = type(config).model_fields[name], getattr(config, name)
    marked = any(quantities(field))
    return marked and isinstance(value, float) and value not in (0, field.default)


def _arrays(answers: Mapping[str, Any]) -> list[str]:
    """Return the names of the answers that are arrays."""
    return [name for name, values in answers.items() if np.ndim(values) > 0]
