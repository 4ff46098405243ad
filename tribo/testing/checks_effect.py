"""What every effect must fulfil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.core.fields import ContactConditions
from tribo.guards.answers import initial
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
from tribo.wear.archard import Archard

_LONGEST = 60.0
"""Time for which a state has been there at most, in s."""
_FAR = 100.0
_VARIED, _SLIGHT = 1e-3, 1e-6
"""Part by which a cell is varied, and of an answer that beyond `reach` may change: rounding."""


class EffectChecks(LocalChecks):
    """Checks of an effect."""

    _numbers = (0, 1, 2, 3)

    def _inputs(
        self, component: Any, number: int, names: tuple[str, ...] = BODIES
    ) -> ContactConditions:
        """Return conditions by number, with a state of some age at each point; 3: come to rest."""
        given = samples.contact_conditions(component, self._fields, number % 3, names)
        if given.state:
            effect = GuardedEffect(self._make(), names)
            given = self._remembering(effect, given, _LONGEST * samples.pattern(GRID.cells) ** 3)
        return replace(given, speed=0.0) if number == 3 else given

    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        rates: Mapping[str, Array] = component.state_rates(given)
        return rates

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        fields = component.fields(replace(inputs, wear_rates={}))
        provided = {name: dict(values) for name, values in fields.items()}
        rates = component.state_rates(inputs) if inputs.state else {}
        # A state itself is the answer to whoever requires its name.
        return {**provided, **inputs.state, **self._state_answers(component, rates)}

    def answers_fit_a_run(self) -> None:
        """Each declared field comes for each body, finite, within its limits, on the window.

        At rest too, and however far its state has gone.
        """
        effect = GuardedEffect(self._make(), BODIES)
        for given in self._samples():
            for at in (given, _gone_far(effect, given)):
                effect.fields(replace(at, wear_rates={}))
                effect.state_rates(at)

    def bodies_may_have_any_names(self) -> None:
        """Nothing depends on names and order of the bodies, unless its configuration has names."""
        effect, names = self._make(), ("upper", "lower")
        usual = self._call(effect, self._sample())
        try:
            GuardedEffect(effect, names)
            given = samples.contact_conditions(effect, self._fields, names=names)
            effect.check(given.system, given.swept, samples.SOLVER)
        except CaseError as error:
            raise self._refused(error) from error
        given = locked(self._inputs(effect, 0, names))
        turned = replace(
            given,
            system=replace(given.system, materials=_turned(given.materials)),
            wear_rates=_turned(given.wear_rates),
            fields={name: _turned(values) for name, values in given.fields.items()},
        )
        back = dict(zip(names, BODIES, strict=True))
        for asked, how in ((given, f"are called {names}"), (turned, "change places")):
            answers = mapped(self._call(effect, asked), lambda _, value: value, back)
            changed = first_difference(answers, usual)
            require(not changed, f"{changed} changes when the bodies {how}")

    def larger_window_has_the_same_fields(self) -> None:
        """A wider rim round the contact, without pressure, changes nothing within."""
        effect, given = self._make(), self._sample()
        wide = self._call(effect, locked(_widened(given)))
        found = mapped(wide, lambda _, values: samples.inside(values))
        expect_close("in a larger window", found, self._call(effect, given), 1e-9)

    def reach_is_as_declared(self) -> None:
        """Nothing follows pressure, state or wear of points further away than `reach` says."""
        effect = self._make()
        apply_if(effect.reach, "it declares no reach")
        whole = effect.reach == "contact"
        reach = effect.reach if isinstance(effect.reach, tuple) else (0, 0)
        for sample in self._samples():
            given = locked(_even(sample)) if whole else sample
            usual = values_in(self._call(effect, given))
            for what, cells, other in _varied(given, whole):
                near = np.any([_within(reach, cell) for cell in cells], axis=0)
                for where, values in values_in(self._call(effect, locked(other))).items():
                    change = np.abs(values - usual[where])
                    off = np.max(np.where(near, 0.0, np.broadcast_to(change, GRID.cells)))
                    require(
                        off <= _SLIGHT * np.max(np.abs(usual[where])),
                        f"{where} follows {what} further away than reach = {effect.reach!r}",
                    )

    def slopes_are_derivatives(self) -> None:
        """A field called NAME_slope is the derivative of the field NAME in pressure."""
        effect = self._make()
        names = {field.name for field in effect.provides}
        sloped = [name for name in names if f"{name}_slope" in names]
        apply_if(sloped, "it provides no slope")
        for given in self._samples():
            step = 1e-6 * given.pressure
            less, now, more = (
                self._call(effect, locked(replace(given, pressure=given.pressure + way * step)))
                for way in (-1, 0, 1)
            )
            for name in sloped:
                for body in given.materials:
                    found = now[f"{name}_slope"][body] * step
                    needed = 0.5 * (more[name][body] - less[name][body])
                    expect_close(f"change of {name!r} by its slope", found, needed, 1e-4)

    def fields_follow_no_wear(self) -> None:
        """Fields are the same with wear rates and without: wear follows from them."""
        effect = self._make()
        apply_if(effect.provides, "it provides no field")
        for given in self._samples():
            without = effect.fields(replace(given, wear_rates={}))
            where = first_difference(effect.fields(given), without)
            require(
                where is None,
                f"{where} follows contact.wear_rates, which a run does not know yet; let a state "
                "follow them",
            )

    def runs_in_a_case(self) -> None:
        """In a small case a law gets the fields it requires in every step."""
        effect = self._make()

        class Reads(Archard):
            """A law that requires the fields and wears as if they were not there."""

            type = "tribo.testing.reads"
            requires = tuple(field.name for field in effect.provides)

        samples.run(self._fields, law=Reads(k=samples.ARCHARD.k), effects=[effect])


def _varied(
    given: ContactConditions, swapped: bool
) -> Iterator[tuple[str, list[tuple[int, int]], ContactConditions]]:
    """Yield what is varied, at which cells, and the conditions with it.

    The pressure is varied at one cell; or swapped with that of another, so that all sums stay.
    """
    nx, ny = GRID.cells
    here, there = (nx // 2, ny // 2), (nx // 2 + 3, ny // 2 - 1)
    pressure = given.pressure.copy()
    pressure[here] *= 1 + _VARIED
    if swapped:
        pressure[here], pressure[there] = given.pressure[there], given.pressure[here]
    cells = [here, there] if swapped else [here]
    yield "the pressure", cells, replace(given, pressure=pressure)
    for what in ("state", "wear_rates"):
        fields: Mapping[str, Array] = getattr(given, what)
        for name, values in fields.items():
            if values.shape == GRID.cells:
                other = values.copy()
                other[here] += _VARIED * float(np.max(np.abs(values)))
                varied: dict[str, Any] = {what: {**fields, name: other}}
                yield repr(name), [here], replace(given, **varied)


def _within(reach: tuple[int, int], cell: tuple[int, int]) -> Mask:
    """Return where the window is no further from a cell than it is reached."""
    rows, columns = np.indices(GRID.cells)
    return (np.abs(rows - cell[0]) <= reach[0]) & (np.abs(columns - cell[1]) <= reach[1])


def _even(given: ContactConditions) -> ContactConditions:
    """Return conditions with fields that are alike at all points: what follows Σ μ p follows Σp."""
    even = mapped(given.fields, lambda _, values: np.full_like(values, np.mean(values)))
    return replace(given, fields=even)


def _turned(of_bodies: Mapping[str, Any]) -> dict[str, Any]:
    return dict(reversed([*of_bodies.items()]))


def _gone_far(effect: GuardedEffect, given: ContactConditions) -> ContactConditions:
    """Return conditions with a state a hundred times as far from its start, within its limits."""
    state = {}
    for field in effect.state_fields:
        start = effect.initial_state[field.name]
        far = start + _FAR * (given.state[field.name] - start)
        state[field.name] = np.clip(far, *effect.answers[initial(field.name)].range)
    return locked(replace(given, state=state))


def _widened(given: ContactConditions) -> ContactConditions:
    """Return conditions with a rim on each side of the window, without pressure."""

    def widened(_: tuple[Any, ...], value: Any) -> Any:
        is_map = isinstance(value, np.ndarray) and value.shape == GRID.cells
        return np.pad(value, samples.RIM, mode="edge") if is_map else value

    pressure = np.pad(given.pressure, samples.RIM)
    system = replace(given.system, grid=samples.wider(GRID))
    return replace(mapped(given, widened), system=system, pressure=pressure)
