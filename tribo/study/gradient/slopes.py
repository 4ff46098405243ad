"""The rates of an increment at one state, and their derivatives in all that they follow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from tribo.contact.projection import CELLS, over
from tribo.core.arrays import Array
from tribo.core.box import Box, whole
from tribo.core.contact import ContactSolution
from tribo.core.errors import CaseError
from tribo.simulation.model import Model
from tribo.stepping.evolution import limits_of, loaded
from tribo.stepping.relaxation import Limits
from tribo.study.gradient.course import pressed, stacked
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.local import localised
from tribo.study.gradient.response import (
    ALONE,
    NUDGE,
    Arrays,
    Offset,
    Response,
    agrees,
    back,
    local,
    near,
    reached,
    shared,
)
from tribo.study.gradient.tape import Slid

FINE = 1e-6
"""Part of the largest value by which what is remembered is varied."""


class Place(NamedTuple):
    """Which part of an increment has passed, and over how much (m) of it means are asked for."""

    passed: float
    over: float = 0.0


class Reach(NamedTuple):
    """How many cells apart points are that follow each other's pressure, and each state."""

    pressure: Offset
    states: Sequence[Offset]


@dataclass(frozen=True)
class Slopes:
    """Rates at one state, of depths and states, with their derivatives in each cell."""

    found: Arrays
    by_pressure: Sequence[Response]
    by_state: Sequence[Sequence[Response]]
    by_factor: Sequence[Sequence[Response]]
    inside: Sequence[Array]


@dataclass(frozen=True)
class Asked:
    """Whoever is asked for the rates of an increment of the bodies of a model that wear.

    `kept` are the carriers of what is remembered, in the order of `Memory.values`. `along` tells
    whether rates are integrated along the increment, as where any body remembers, and `advances`
    whether they are the means that laws know.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    kept: Sequence[Carrier]
    contacts: Sequence[ContactSolution]
    slid: Slid
    along: bool
    advances: bool

    @cached_property
    def own(self) -> Sequence[Carrier]:
        """The carriers of the depths worn."""
        return [self.carriers[name] for name in self.model.laws]

    @cached_property
    def pressure(self) -> Array:
        """The pressures of the increment, shape (positions, nx, ny)."""
        return np.stack([contact.pressure for contact in self.contacts])

    @cached_property
    def limits(self) -> list[Limits]:
        """The limits of what is remembered."""
        return limits_of(self.model, self.slid.before)

    def held(self, states: Sequence[Array]) -> Arrays:
        """Return states within their limits."""
        pairs = zip(states, self.limits, strict=True)
        return [np.clip(state, limit.least, limit.most) for state, limit in pairs]

    def nudges(self, states: Sequence[Array], found: Arrays) -> Arrays:
        """Return by how much each state is varied to find what follows it."""
        nudges = []
        for state, rate in zip(states, found[len(self.own) :], strict=True):
            fastest = self.slid.increment * float(np.max(np.abs(rate)))
            largest = max(float(np.max(np.abs(state))), fastest) or 1.0
            nudges.append(np.full_like(state, FINE * largest))
        return nudges

    def place(self, passed: float, over: float) -> Place:
        """Return a place along the increment."""
        return Place(passed, over if self.advances else 0.0)

    def means(self, rates: Arrays) -> Arrays:
        """Return the mean rates of what is remembered, where it lies."""
        pairs = zip(self.kept, rates[len(self.own) :], strict=True)
        return [kept.mean(rate, self._shares) for kept, rate in pairs]

    def of_states(self, place: Place, values: Sequence[Array], *_: float) -> Arrays:
        """Return the mean rates of what is remembered at other values of it."""
        return self.means(self._asked(values, place))

    @cached_property
    def first(self) -> tuple[Slopes, Reach]:
        """The slopes where the increment begins, and how far points follow each other.

        Effects are refused of which a change in all at once is not the sum of its parts.
        """
        states, share = self.slid.before.values, self.slid.plan.parts[0][0]
        place = self.place(0.0, share * self.slid.increment) if self.along else Place(1.0)
        reach = Reach(ALONE, [ALONE] * len(states))
        slopes = self._sloped(states, place, reach)
        if not self.model.effects or self._agrees(slopes, states, place):
            return slopes, reach
        reach = self._reached(slopes.found, states, place)
        slopes = self._sloped(states, place, reach)
        if self._agrees(slopes, states, place):
            return slopes, reach
        who = ", ".join(repr(effect.component.type) for effect in self.model.effects)
        raise CaseError(
            f"what {who} makes of a point follows points further than a few cells from it, "
            "otherwise than by the load and the area, through which no gradient goes",
            "effects",
        )

    def sloped(self, states: Sequence[Array], place: Place) -> Slopes:
        """Return rates with their derivatives, at a place along the increment."""
        return self._sloped(states, place, self.first[1])

    def behind(self, slopes: Slopes, seeds: Arrays) -> tuple[Arrays, Arrays]:
        """Return derivatives in what rates follow, from those in the rates of depths and states.

        The first are in the pressure of each cell, the load and Σp²/2 of each position, and factors
        on the bodies' rates; the second in the states.
        """
        seen = [
            carrier.part * carrier.seen(seed, self._window)
            for carrier, seed in zip((*self.own, *self.kept), seeds, strict=True)
        ]

        def through(slopes: Sequence[Array | float]) -> Array:
            pairs = zip(seen, slopes, strict=True)
            return over(sum(np.sum(seed * slope, CELLS) for seed, slope in pairs))

        load = through([each.load for each in slopes.by_pressure])
        square = through([each.square for each in slopes.by_pressure])

        def gathered(carrier: Carrier, responses: Sequence[Response]) -> Array:
            return carrier.gathered(over(self._shares) * back(seen, responses), self._window)

        factors = map(gathered, self.own, slopes.by_factor)
        states = [
            inside * gathered(kept, responses)
            for kept, inside, responses in zip(
                self.kept, slopes.inside, slopes.by_state, strict=True
            )
        ]
        return [back(seen, slopes.by_pressure), load, square, *factors], states

    @cached_property
    def _shares(self) -> Array:
        return np.array([position.share for position in self.model.cycle])

    @property
    def _window(self) -> Box:
        return whole(self.model.grid.cells)

    def _told(self, place: Place, pressure: Array | None = None) -> Sequence[ContactSolution]:
        """Return the contacts as laws are told of them where a part of the increment has passed."""
        contacts = self.contacts if pressure is None else pressed(self.contacts, pressure)
        if not self.along:
            return contacts
        end, half = self.slid.moment, 0.5 * self.slid.increment
        return loaded(self.model, contacts, end.back(half).time, end.time, place.passed)

    def _asked(
        self,
        states: Sequence[Array],
        place: Place,
        told: Sequence[ContactSolution] | None = None,
        model: Model | None = None,
    ) -> Arrays:
        """Return the rates at each position where a part of the increment has passed."""
        moment = self.slid.moment
        if self.along:
            moment = moment.back((1 - place.passed) * self.slid.increment)
            moment = replace(moment, over=place.over)
        memory = self.slid.before.with_values(iter(states))
        return stacked(model or self.model, told or self._told(place), memory, moment)

    def _sloped(self, states: Sequence[Array], place: Place, reach: Reach) -> Slopes:
        held = self.held(states)
        found = self._asked(held, place)
        by_state = [
            self._by_state(at, held, nudge, place, reach.states[at])
            for at, nudge in enumerate(self.nudges(held, found))
        ]
        inside = [s == h for s, h in zip(states, held, strict=True)]
        by_pressure = self._by_pressure(held, place, reach.pressure)
        by_factor = self._by_factor(held, place, found, reach.pressure)
        return Slopes(found, by_pressure, by_state, by_factor, inside)

    def _by_pressure(
        self, states: Sequence[Array], place: Place, reach: Offset
    ) -> Sequence[Response]:
        def rates(pressure: Array) -> Arrays:
            return self._asked(states, place, self._told(place, pressure))

        if self.model.effects and reach == ALONE:
            return shared(rates, self.pressure)
        if self.model.effects:
            return local(rates, self.pressure, reach)
        told = self._told(place)
        pressure = np.stack([contact.pressure for contact in told])
        found = local(lambda p: self._asked(states, place, pressed(told, p)), pressure)
        if told is self.contacts:
            return found
        # Along the increment pressures are told in proportion to the load.
        total = over(np.sum(self.pressure, CELLS))
        longer = over(np.sum(pressure, CELLS)) / total
        of_own = [longer * each.own for each in found]
        return [Response(own, -own * self.pressure / total) for own in of_own]

    def _by_state(
        self, at: int, states: Arrays, nudge: Array, place: Place, reach: Offset
    ) -> Sequence[Response]:
        limit = self.limits[at]

        def rates(state: Array) -> Arrays:
            return self._asked([*states[:at], state, *states[at + 1 :]], place)

        def moved(cells: Array) -> tuple[Array, Array]:
            up, down = states[at] + nudge * cells, states[at] - nudge * cells
            return np.clip(up, limit.least, limit.most), np.clip(down, limit.least, limit.most)

        return near(rates, moved, self.kept[at], nudge.shape, reach)

    def _by_factor(
        self, states: Sequence[Array], place: Place, found: Arrays, reach: Offset
    ) -> Sequence[Sequence[Response]]:
        names = list(self.model.laws)
        if not self.slid.before.between:
            return [
                [Response(rate * (at == of)) for of, rate in enumerate(found)]
                for at in range(len(names))
            ]
        of_bodies = []
        for name, carrier in zip(names, self.own, strict=True):

            def rates(factor: Array, name: str = name) -> Arrays:
                return self._asked(states, place, model=localised(self.model, {name: factor}))

            def moved(cells: Array) -> tuple[Array, Array]:
                return 1 + NUDGE * cells, 1 - NUDGE * cells

            shape = (carrier.rows, self.model.grid.cells[1])
            of_bodies.append(near(rates, moved, carrier, shape, reach))
        return of_bodies

    def _reached(self, found: Arrays, states: Sequence[Array], place: Place) -> Reach:
        """Return how far apart points follow each other, about where the pressure is largest."""
        one = np.zeros_like(self.pressure)
        where = [int(at) for at in np.unravel_index(np.argmax(self.pressure), one.shape)]
        one[tuple(where)] = 1.0

        def changes(now: Arrays) -> Arrays:
            return [after - before for after, before in zip(now, found, strict=True)]

        told = self._told(place, self.pressure * (1 + NUDGE * one))
        pressure, of_states = reached(changes(self._asked(states, place, told)), where), []
        for at, (kept, nudge) in enumerate(zip(self.kept, self.nudges(states, found), strict=True)):
            cell = kept.gathered(one, self._window) > 0
            moved = self.held([*states[:at], states[at] + nudge * cell, *states[at + 1 :]])
            far = reached(changes(self._asked(moved, place)), where, kept)
            of_states.append(ALONE if cell.size == 1 else far)
        return Reach(pressure, of_states)

    def _agrees(self, slopes: Slopes, states: Sequence[Array], place: Place) -> bool:
        """Whether a change in all at once is the sum of its parts."""
        random, held = np.random.default_rng(0), self.held(states)
        nudges = [
            by * random.uniform(0.5, 1.5, state.shape)
            for by, state in zip(self.nudges(held, slopes.found), held, strict=True)
        ]
        by = NUDGE * self.pressure * random.uniform(-1, 1, self.pressure.shape)
        ends = [
            self.held([state + sign * nudge for state, nudge in zip(held, nudges, strict=True)])
            for sign in (1, -1)
        ]
        higher, lower = (
            self._asked(end, place, self._told(place, self.pressure + sign * by))
            for end, sign in zip(ends, (1, -1), strict=True)
        )
        expected = [each.change(self.pressure, 2 * by) for each in slopes.by_pressure]
        for kept, responses, up, down in zip(self.kept, slopes.by_state, *ends, strict=True):
            span = kept.seen(up - down, self._window)
            pairs = zip(expected, responses, strict=True)
            expected = [total + each.change(span, span) for total, each in pairs]
        found = [up - down for up, down in zip(higher, lower, strict=True)]
        return agrees(expected, found, slopes.found)
