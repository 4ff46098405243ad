"""The common contract of wear laws and effects, which read fields and may have states."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import product
from typing import Any, ClassVar

import numpy as np

from tribo.contract import initial, rate_of
from tribo.core.arrays import Array, Mask
from tribo.core.fields import Field, names_of
from tribo.core.material import Material
from tribo.core.rounding import SAME
from tribo.core.units import quantities
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
    values_in,
)
from tribo.testing.rescaling import renewed, units_of

_DECADE, _GROWS, _MUCH = 0.1, 5.0, 20.0
"""A rate that grows as much over the last decade of a run, and in all, grows without end."""
_NUDGE = 1e-3
"""Part of a step by which a state is moved for the mean slope of a step."""
_RUNGS = 33
"""Values of a state between which a jump of the rates is looked for, and then narrowed by
halves."""
_VARIED = 1e-3
"""Part beyond the largest to which a cell is varied: a thousand times `SAME`."""


class LocalChecks(Checks):
    """Checks of what answers at each point, from fields and from a state of its own."""

    _longest_run: ClassVar[float]
    """Length of the longest runs: in m for a law, in s for an effect."""

    def _units(self, component: Any) -> Mapping[str, float]:
        given = samples.required(component)
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
        numbers = {n: of for n, of in self._cls.model_fields.items() if any(quantities(of))}
        idle = {
            ("number", name)
            for name, of in numbers.items()
            if isinstance(value := getattr(model, name), float) and value not in (0, of.default)
        }
        idle |= {("state", field.name) for field in model.state_fields}
        idle |= {("required field", name) for name in names_of(model.requires)}
        idle |= {("property", field.name) for field in model.material_properties}
        apply_if(idle, "it has no number but defaults and 0, no state, and requires nothing")
        for config in self._configs:
            checks = self if config is self._config else type(self)(config)
            component = checks._make()
            for given in checks._samples():
                usual = checks._asked(component, given)
                for what, name in sorted(idle):
                    own = {rate_of(name): None}
                    for pair in _altered(component, given, what, name):
                        if first_difference({**usual, **own}, {**checks._asked(*pair), **own}):
                            idle.discard((what, name))
        listed = ", ".join(f"the {what} {name!r}" for what, name in sorted(idle))
        require(not idle, f"no answer changes with {listed}")

    def _asked(self, component: Any, given: Any) -> Mapping[str, Any]:
        """Return all its answers."""
        return self._call(component, given)

    def rates_jump_at_breaks_alone(self) -> None:
        """Where an answer jumps as a state changes, the field declares a break.

        The depth does not jump as the pressure does: implicit steps have no answer there.
        """
        climbs = [*self._climbs(self._make())]
        apply_if(climbs, "it keeps no state")
        for field, ladder, answers in climbs:
            # A kink of the depth is no jump.
            names = {n for n, value in answers(ladder[0]).items() if np.ndim(value)}
            for name in sorted(names - {"depth_slope"}):

                def answer(value: float, answers: Any = answers, name: str = name) -> Array:
                    return np.asarray(answers(value)[name])

                where, part = largest_jump(answer, ladder)
                known = any(abs(each - where) <= SAME * np.ptp(ladder) for each in field.breaks)
                require(
                    known or part <= SAME,
                    f"as {field.name!r} passes {where:.6g} {field.unit}, {name!r} jumps by "
                    f"{part:.3g} of its size; declare that with its field, as breaks",
                )
                for limit in field.breaks:
                    at, above = (answer(value) for value in (limit, np.nextafter(limit, np.inf)))
                    require(
                        np.allclose(at, above, rtol=SAME, atol=0),
                        f"at its break {limit:.6g}, {field.name!r} has not the {name!r} above it",
                    )

    def _climbs(self, component: Any) -> Iterator[tuple[Field, Array, Callable[[float], Any]]]:
        """Yield what is raised, through which values, and the answers at one of them."""
        for given, field in product(self._samples()[:2], component.state_fields):
            values = given.state[field.name]

            def answers(value: float, given: Any = given, name: str = field.name) -> Any:
                return self._call(component, _at(given, name, value))

            if np.ptp(values):
                yield field, np.linspace(np.min(values), np.max(values), _RUNGS), answers

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

    def slopes_are_derivatives(self) -> None:
        """The slope of an answer, `depth_slope` or NAME_slope, is its derivative in pressure."""
        component, stated = self._make(), False
        for number in self._numbers:
            pressure = self._sample(number).pressure
            step = 1e-5 * pressure
            less, now, more = (
                values_in(self._call(component, self._under(number, pressure + way * step)))
                for way in (-1, 0, 1)
            )
            for where, value in now.items():
                name, dot, body = where.partition(".")
                slope = now.get(f"{name.removesuffix('_rate')}_slope{dot}{body}")
                if slope is None:
                    continue
                stated = True
                forward, backward = more[where] - value, value - less[where]
                # At a kink one side is right. Round-off is 1e-11 of the value.
                changes = np.stack([forward, backward, (forward + backward) / 2])
                error = np.min(np.abs(slope * step - changes), axis=0)
                allowed = 1e-4 * np.maximum(np.abs(slope) * step, 1e-5 * np.abs(value))
                require(
                    np.all(error <= allowed),
                    f"as the pressure rises by 1e-5 of itself, {where} changes by up to "
                    f"{np.max(np.abs(changes)):.6g}, and by its slope by {np.max(error):.3g} else",
                )
        apply_if(stated, "it states no slope")

    def _under(self, number: int, pressure: Array) -> Any:
        """Return the conditions of a number under another pressure."""
        return locked(replace(self._sample(number), pressure=pressure))

    def reach_is_as_declared(self) -> None:
        """No answer follows other points, but as `reach` says; a law follows its point alone."""
        model = self._make()
        declared = getattr(model, "reach", "point")
        apply_if(declared, "it declares no reach")
        whole = declared == "contact"
        for sample in self._samples():
            # Alike at all points: what follows Σ μ p follows Σ p.
            even = mapped(sample.fields, lambda _, values: np.full_like(values, np.mean(values)))
            given = locked(replace(sample, fields=even)) if whole else sample
            usual = values_in(self._call(model, given))
            for what, varied, other in _varied(given, declared):
                for where, values in values_in(self._call(model, locked(other))).items():
                    change = np.abs(values - usual[where])
                    off = np.max(np.where(varied, 0.0, np.broadcast_to(change, varied.shape)))
                    require(
                        off <= SAME * np.max(np.abs(usual[where])),
                        f"{where} at a point follows {what} at others, with reach = {declared!r}",
                    )


def _varied(given: Any, reach: object) -> Iterator[tuple[str, Mask, Any]]:
    """Yield a varied input, where it is varied, and the conditions with it.

    Of a pressure that acts as a whole two points are exchanged, so that sums stay.
    """
    shape = given.pressure.shape
    half = samples.pattern(shape) > 0.5
    numbers = np.arange(half.size).reshape(shape)
    two = np.logical_or(*(numbers == int(part * half.size) for part in (0.4, 0.6)))
    names = {"pressure", "state", "wear_rates", *(() if reach == "contact" else ("fields",))}
    for path, values in values_in(given).items():
        if path.partition(".")[0] not in names or np.shape(values) != shape:
            continue
        varied, other = half, np.where(half, (1 + _VARIED) * np.max(np.abs(values)), values)
        if reach == "contact" and path == "pressure":
            varied, other = two, values.copy()
            other[two] = values[two][::-1]

        def change(at: Any, value: Any, path: str = path, other: Array = other) -> Any:
            return other if ".".join(map(str, at)) == path else value

        yield path, varied, mapped(given, change)


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
