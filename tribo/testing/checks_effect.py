"""What every effect must fulfil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.core.fields import ContactConditions, LocalConditions, WearRate
from tribo.core.grid import Grid
from tribo.guards.parts import GuardedEffect
from tribo.testing import samples
from tribo.testing.checks import BODIES
from tribo.testing.checks_local import LocalChecks
from tribo.testing.compare import (
    apply_if,
    expect_close,
    first_difference,
    locked,
    require,
    values_in,
)
from tribo.testing.samples import GRID
from tribo.wear.law import WearLaw

_LONGEST = 60.0
"""Time for which a state has been there at most, in s."""
_FAR = 100.0
_VARIED, _SLIGHT = 1e-3, 1e-6
"""Part by which a cell is varied, and of an answer that beyond `reach` may change: rounding, and
what changes with the square of the part."""


class EffectChecks(LocalChecks):
    """Checks of an effect."""

    _numbers = (0, 1, 2, 3)
    _per = "s"

    def _inputs(self, component: Any, number: int) -> ContactConditions:
        """Return conditions by number; 3: those of 0, come to rest."""
        given = samples.contact_conditions(component, self._fields, number % 3)
        given = self._lasting(given)
        return replace(given, speed=0.0) if number == 3 else given

    def _lasting(self, given: ContactConditions) -> ContactConditions:
        """Return conditions with a state that each point has had for a time of its own."""
        if not given.state:
            return given
        lasting: ContactConditions = self._remembering(
            given, _LONGEST * samples.pattern(GRID.cells) ** 3
        )
        return lasting

    def _rates(self, component: Any, given: Any) -> Mapping[str, Array]:
        rates: Mapping[str, Array] = component.state_rates(given)
        return rates

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        fields = component.fields(replace(inputs, wear_rates={}))
        provided = {name: dict(values) for name, values in fields.items()}
        rates = component.state_rates(inputs) if inputs.state else {}
        return {**provided, **self._state_answers(component, rates)}

    def answers_fit_a_run(self) -> None:
        """Each declared field comes for each body, finite, within its limits, on the window.

        At rest too, and however far its state has gone.
        """
        effect = GuardedEffect(self._make(), BODIES)
        for given in self._samples(effect.component):
            for at in (given, _gone_far(effect, given)):
                effect.fields(replace(at, wear_rates={}))
                effect.state_rates(at)

    def bodies_may_have_any_names(self) -> None:
        """Nothing depends on names and order of the bodies, unless its configuration has names."""
        effect = self._make()
        usual = self._answers(effect)
        names = ("upper", "lower")
        given = samples.contact_conditions(effect, self._fields, names=names)
        try:
            GuardedEffect(effect, names)
            effect.check(given.materials, given.swept)
        except CaseError as error:
            raise self._refused(error) from error
        given = self._lasting(given)
        turned = replace(
            given,
            materials=_turned(given.materials),
            wear_rates=_turned(given.wear_rates),
            fields={name: _turned(values) for name, values in given.fields.items()},
        )
        back = dict(zip(names, BODIES, strict=True))
        for asked, how in ((given, f"are called {names}"), (turned, "change places")):
            answers = {
                field: {back.get(n, n): v for n, v in of.items()} if isinstance(of, dict) else of
                for field, of in self._call(effect, locked(asked)).items()
            }
            changed = first_difference(answers, usual)
            require(not changed, f"{changed} changes when the bodies {how}")

    def larger_window_has_the_same_fields(self) -> None:
        """A wider rim round the contact, without pressure, changes nothing within."""
        effect = self._make()
        given, usual = self._inputs(effect, 0), dict(values_in(self._answers(effect)))
        (nx, ny), (dx, dy) = GRID.cells, GRID.spacing
        grid = Grid(((nx + 6) * dx, (ny + 4) * dy), (nx + 6, ny + 4))
        wide = _widened(replace(given, grid=grid))
        for where, values in values_in(self._call(effect, locked(wide))):
            inside = np.broadcast_to(np.asarray(values), grid.cells)[3 : nx + 3, 2 : ny + 2]
            needed = np.broadcast_to(np.asarray(usual[where]), GRID.cells)
            expect_close(f"{where} in a larger window", inside, needed, 1e-9)

    def reach_is_as_declared(self) -> None:
        """Nothing follows pressure, state or wear of points further away than `reach` says."""
        effect = self._make()
        apply_if(effect.reach, "it declares no reach")
        whole = effect.reach == "contact"
        for sample in self._samples(effect):
            given = locked(_even(sample)) if whole else sample
            usual = dict(values_in(self._call(effect, given)))
            for what, cells, other in _varied(given, balanced=whole):
                near = _near(cells, effect.reach if isinstance(effect.reach, tuple) else (0, 0))
                for where, values in values_in(self._call(effect, locked(other))):
                    before = np.asarray(usual[where], dtype=float)
                    change = np.abs(np.asarray(values, dtype=float) - before)
                    off = np.max(np.where(near, 0.0, np.broadcast_to(change, GRID.cells)))
                    require(
                        off <= _SLIGHT * np.max(np.abs(before)),
                        f"{where} follows {what} further away than reach = {effect.reach!r}",
                    )

    def slopes_are_derivatives(self) -> None:
        """A field called NAME_slope is the derivative of the field NAME in pressure."""
        effect = self._make()
        names = {field.name for field in effect.provides}
        sloped = [name for name in names if f"{name}_slope" in names]
        apply_if(sloped, "it provides no slope")
        for number in self._numbers:
            given = self._inputs(effect, number)
            step = 1e-6 * given.pressure
            more = self._call(effect, replace(given, pressure=given.pressure + step))
            less = self._call(effect, replace(given, pressure=given.pressure - step))
            now = self._call(effect, given)
            for name in sloped:
                for body in given.materials:
                    found = np.asarray(now[f"{name}_slope"][body]) * step
                    needed = 0.5 * (np.asarray(more[name][body]) - np.asarray(less[name][body]))
                    expect_close(f"change of {name!r} by its slope", found, needed, 1e-4)

    def fields_follow_no_wear(self) -> None:
        """Fields are the same with wear rates and without: wear follows from them."""
        effect = self._make()
        apply_if(effect.provides, "it provides no field")
        for given in self._samples(effect):
            where = first_difference(
                effect.fields(given), effect.fields(replace(given, wear_rates={}))
            )
            require(
                where is None,
                f"{where} follows contact.wear_rates, which a run does not know yet; let a state "
                "follow them",
            )

    def runs_in_a_case(self) -> None:
        """In a small case a law gets the fields it requires in every step."""
        effect = self._make()
        law = _reads([field.name for field in effect.provides])
        samples.run(self._fields, law=law, effects=[effect])


def _varied(
    given: ContactConditions, *, balanced: bool
) -> Iterator[tuple[str, list[tuple[int, int]], ContactConditions]]:
    """Yield what is varied, at which cells, and the conditions with it.

    The pressure is varied at one cell; or, balanced, at three so that Σp and Σp² stay.
    """
    nx, ny = GRID.cells
    cells = [(nx // 2, ny // 2), (nx // 2 + 1, ny // 2 + 1), (nx // 2 + 3, ny // 2 - 1)]
    cells = cells if balanced else cells[:1]
    parts = [1.0]
    if balanced:
        three = np.array([given.pressure[cell] for cell in cells])
        parts = np.cross(np.ones(3), three / three.max()).tolist()
    pressure = given.pressure.copy()
    for cell, part in zip(cells, parts, strict=True):
        pressure[cell] += _VARIED * part * given.pressure[cells[0]]
    yield "the pressure", cells, replace(given, pressure=pressure)
    for what in ("state", "wear_rates"):
        fields: Mapping[str, Array] = getattr(given, what)
        for name, values in fields.items():
            if values.shape == GRID.cells:
                other = values.copy()
                other[cells[0]] += _VARIED * float(np.max(np.abs(values)))
                varied: dict[str, Any] = {what: {**fields, name: other}}
                yield repr(name), cells[:1], replace(given, **varied)


def _even(given: ContactConditions) -> ContactConditions:
    """Return conditions with fields that are alike at all points: what follows Σ μ p follows Σp."""
    fields = {
        name: {body: np.full_like(values, np.mean(values)) for body, values in of_bodies.items()}
        for name, of_bodies in given.fields.items()
    }
    return replace(given, fields=fields)


def _near(cells: Sequence[tuple[int, int]], reach: tuple[int, int]) -> Mask:
    """Return where the window lies no further from any of some cells than it is reached."""
    near = np.zeros(GRID.cells, dtype=bool)
    for along, across in cells:
        rows, columns = (np.arange(n) for n in GRID.cells)
        in_row = np.abs(rows - along) <= reach[0]
        near |= in_row[:, None] & (np.abs(columns - across) <= reach[1])
    return near


def _turned(of_bodies: Mapping[str, Any]) -> dict[str, Any]:
    return dict(reversed([*of_bodies.items()]))


def _gone_far(effect: GuardedEffect, given: ContactConditions) -> ContactConditions:
    """Return conditions with a state a hundred times as far from its start, within its limits."""
    state = {}
    for field in effect.state_fields:
        start = effect.initial_state[field.name]
        far = start + _FAR * (given.state[field.name] - start)
        state[field.name] = np.clip(far, field.at_least, field.at_most)
    return locked(replace(given, state=state))


def _widened(given: ContactConditions) -> ContactConditions:
    """Return conditions with some more rows and columns on each side, without pressure."""

    def widened(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {name: widened(inner) for name, inner in value.items()}
        uniform = value.shape == (1, 1)
        return value if uniform else np.pad(value, [(3, 3), (2, 2)], mode="edge")

    pressure = np.pad(given.pressure, [(3, 3), (2, 2)])
    parts = {name: widened(getattr(given, name)) for name in ("fields", "state", "wear_rates")}
    return replace(given, pressure=pressure, **parts)


def _reads(names: Sequence[str]) -> WearLaw:
    """Return a law that requires some fields and wears as if they were not there."""

    class Reads(WearLaw):
        type = "tribo.testing.reads"
        requires = tuple(names)

        def rate(self, local: LocalConditions) -> WearRate:
            return samples.ARCHARD.rate(local)

    return Reads()
