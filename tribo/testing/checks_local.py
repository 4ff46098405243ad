"""What wear laws and effects must fulfil alike: they read fields, and may remember."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise, product
from typing import Any, ClassVar

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import Field
from tribo.core.units import quantities
from tribo.guards.answers import initial, rate_of
from tribo.testing import samples
from tribo.testing.ageing import aged
from tribo.testing.checks import Checks
from tribo.testing.compare import apply_if, first_difference, jump, locked, require
from tribo.testing.rescaling import renewed, units_of

_RUNGS = 33
"""Values of a state between which a jump of the rates is looked for."""


class LocalChecks(Checks):
    """Checks of what answers at each point, from fields and from a state of its own."""

    _per: ClassVar[str]
    """What rates of the state are per: m or s."""

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

    def _samples(self, component: Any) -> list[Any]:
        return [locked(self._inputs(component, number)) for number in self._numbers]

    def _each(self) -> list[Any]:
        """Return the checks of every configuration, this one's first."""
        others = [each for each in self._others if each is not self._config]
        return [self, *(type(self)(each, self._fields) for each in others)]

    def configuration_matters(self) -> None:
        """Each number that is given changes an answer, in one configuration at least."""
        idle = {name for name in self._cls.model_fields if _is_given(self._config, name)}
        apply_if(idle, "no number is given but defaults and 0")
        for checks in self._each():
            config = checks._config
            usual = [checks._answers(checks._make(), number) for number in self._numbers]
            for name in [n for n in idle if getattr(config, n)]:
                for times in (0.5, 2.0):
                    other = renewed(config, {name: times * getattr(config, name)})
                    for number, before in zip(self._numbers, usual, strict=True):
                        if first_difference(before, checks._answers(other, number)):
                            idle.discard(name)
        names = ", ".join(sorted(idle))
        require(not idle, f"{names}: half as much, or twice, changes no answer")

    def states_move_and_matter(self) -> None:
        """Each state field changes, and a law's changes the wear or another state."""
        names = [field.name for field in self._make().state_fields]
        apply_if(names, "it keeps no state")
        still, idle = {*names}, {*names} if self._per == "m" else set()
        for checks in self._each():
            component = checks._make()
            for given in checks._samples(component):
                answers = dict(self._call(component, given))
                first = component.initial_state()
                for name in [name for name in names if name in first]:
                    if np.any(answers.get(rate_of(name), 0.0)):
                        still.discard(name)
                    other = _at(given, name, first[name])
                    own = {rate_of(name): None}
                    if first_difference(answers | own, {**self._call(component, other), **own}):
                        idle.discard(name)
        for names_of, fault in ((still, "never moves"), (idle, "alters nothing")):
            require(not names_of, f"the state {', '.join(sorted(names_of))} {fault}")

    def states_keep_their_limits(self) -> None:
        """At a limit of a state field, its rate does not lead beyond."""
        component = self._make()
        limited = [each for each in _sides(component) if each[1] is not None]
        apply_if(limited, "no state field has a limit")
        for given in self._samples(component):
            for field, limit, sign in limited:
                rates = self._rates(component, _at(given, field.name, limit))
                beyond = float(np.max(sign * np.asarray(rates[field.name])))
                require(
                    beyond <= 0,
                    f"{field.name!r} at its limit of {limit:g} {field.unit} changes by "
                    f"{sign * beyond:.3g} per {self._per}",
                )

    def rates_jump_at_breaks_alone(self) -> None:
        """Where an answer jumps as a state changes, the field declares a break."""
        component = self._make()
        apply_if(component.state_fields, "it keeps no state")
        for given, field in product(self._samples(component)[:2], component.state_fields):

            def answers(value: float, given: Any = given, name: str = field.name) -> list[Array]:
                found = self._call(component, _at(given, name, value))
                return [np.asarray(found[key]) for key in sorted(found) if _is_rate(found[key])]

            values = given.state[field.name]
            ladder = np.linspace(float(np.min(values)), float(np.max(values)), _RUNGS).tolist()
            span = ladder[-1] - ladder[0]
            at = [answers(value) for value in ladder] if span > 0 else []
            for number, rungs in enumerate(zip(*at, strict=True)):
                size = max(float(np.max(np.abs(each))) for each in rungs)
                steps = [float(np.max(np.abs(b - a))) for a, b in pairwise(rungs)]
                low, high = ladder[int(np.argmax(steps)) :][:2]
                where, left = jump(partial(_numbered, answers, number), low, high)
                known = any(abs(each - where) <= 1e-6 * span for each in field.breaks)
                require(
                    known or left <= 1e-6 * size,
                    f"as {field.name!r} passes {where:.6g} {field.unit} an answer jumps by "
                    f"{left:.3g}, of up to {size:.3g}; declare that with its field, as breaks",
                )

    def states_do_not_run_away(self) -> None:
        """A state without a limit does not grow the faster the more there is of it."""
        component = self._make()
        free = [(field.name, sign) for field, limit, sign in _sides(component) if limit is None]
        apply_if(free, "each state field has limits, or there is none")
        for given in self._samples(component):
            for name, sign in free:
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
        component = self._make()
        given = locked(self._inputs(component, 0))
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
        idle = {*self._make().requires}
        apply_if(idle, "it requires no field")
        for checks in self._each():
            component = checks._make()
            for given in checks._samples(component):
                answers = self._call(component, given)
                for name in idle & {*given.fields}:
                    more = {**given.fields, name: _more(given.fields[name])}
                    other = locked(replace(given, fields=more))
                    if first_difference(answers, self._call(component, other)):
                        idle = idle - {name}
        require(not idle, f"{', '.join(sorted(idle))}: no answer changes by 1 % more of it")


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


def _numbered(answers: Callable[[float], list[Array]], number: int, value: float) -> Array:
    return answers(value)[number]


def _is_rate(values: Any) -> bool:
    return not isinstance(values, Mapping) and np.ndim(values) > 0


def _more(field: Any) -> Any:
    if isinstance(field, Mapping):
        return {body: _more(values) for body, values in field.items()}
    return 1.01 * field
