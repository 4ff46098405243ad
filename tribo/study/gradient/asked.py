"""The rates of an increment, asked for at other states, pressures and factors than it had."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from tribo.core.arrays import Array
from tribo.core.box import Box, whole
from tribo.core.contact import ContactSolution
from tribo.simulation.model import Model
from tribo.stepping.evolution import layered_bodies, limits_of, loaded, memory_with
from tribo.stepping.layers import in_layers
from tribo.stepping.memory import Memory
from tribo.stepping.rates import Moment
from tribo.stepping.relaxation import Limits
from tribo.study.gradient.course import pressed, stacked
from tribo.study.gradient.linear import Carrier, carriers_between
from tribo.study.gradient.response import ASIDE, Arrays
from tribo.study.gradient.tape import Slid


class Place(NamedTuple):
    """Which part of an increment has passed, and over how much (m) of it means are asked for.

    `shares` are those of the layers over it, by body.
    """

    passed: float
    over: float
    shares: Mapping[str, Mapping[str, Array]] = {}


@dataclass(frozen=True)
class Asked:
    """Whoever is asked for the rates of an increment of the bodies of a model that wear.

    `along` tells whether rates are integrated along the increment, as where any body remembers, and
    `advances` whether laws that know them give means over a part.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    contacts: Sequence[ContactSolution]
    slid: Slid
    along: bool
    advances: bool

    @cached_property
    def own(self) -> Sequence[Carrier]:
        """The carriers of the depths worn."""
        return [self.carriers[name] for name in self.model.laws]

    @cached_property
    def kept(self) -> Sequence[Carrier]:
        """The carriers of what is remembered, and of the depths in layers, which go along with it.

        In the order of `Memory.values`, the depths at the end.
        """
        of_laws = [self.carriers[name] for name, of in self.slid.before.laws.items() for _ in of]
        between = carriers_between(self.model, self.carriers).values()
        return [*of_laws, *between, *(self.carriers[name] for name in self.layered)]

    @cached_property
    def pressure(self) -> Array:
        """The pressures of the increment, shape (positions, nx, ny)."""
        return np.stack([contact.pressure for contact in self.contacts])

    @cached_property
    def layered(self) -> Sequence[str]:
        """The bodies in layers."""
        return layered_bodies(self.model)

    @cached_property
    def begin(self) -> Arrays:
        """What is remembered as the increment begins, and the depths of bodies in layers."""
        before = self.slid.before
        return [*before.values, *(before.worn[name] for name in self.layered)]

    @property
    def of_steps(self) -> bool:
        """Whether rates are means over what follows, as `integrated` has it."""
        return self.advances or bool(self.layered)

    @property
    def follows_length(self) -> bool:
        """Whether rates follow how long the increment is."""
        return self.of_steps or self.told(Place(0.0, 0.0)) is not self.contacts

    @cached_property
    def limits(self) -> list[Limits]:
        """The limits of what is remembered."""
        return limits_of(self.model, self.slid.before)

    def held(self, states: Sequence[Array]) -> Arrays:
        """Return states within their limits."""
        pairs = zip(states, self.limits, strict=True)
        return [np.clip(state, limit.least, limit.most) for state, limit in pairs]

    def nudges(self, states: Sequence[Array], found: Arrays, part: float = ASIDE) -> Arrays:
        """Return by how much each state is varied, within its limits, to find what follows it.

        By a part of the largest value that it has, or comes to.
        """
        nudges = []
        of_states = zip(states, found[len(self.own) :], self.limits, strict=True)
        for state, rate, limit in of_states:
            fastest = self.slid.increment * float(np.max(np.abs(rate)))
            nudge = part * (max(float(np.max(np.abs(state))), fastest) or 1.0)
            nudges.append(np.where(state + nudge > limit.most, -nudge, nudge))
        return nudges

    def means(self, rates: Arrays) -> Arrays:
        """Return the mean rates of the depths and of what is remembered, where these lie."""
        pairs = zip((*self.own, *self.kept), rates, strict=True)
        return [carrier.mean(rate, self.shares) for carrier, rate in pairs]

    def of_states(self, place: Place, values: Sequence[Array], *_: float) -> Arrays:
        """Return the mean rates of what is remembered at other values of it."""
        return self.means(self.rates(values, self.in_layers(values, place)))[len(self.own) :]

    @cached_property
    def shares(self) -> Array:
        """The share of the path of each position."""
        return np.array([position.share for position in self.model.cycle])

    @cached_property
    def window(self) -> Box:
        """All of the window."""
        return whole(self.model.grid.cells)

    def told(self, place: Place, pressure: Array | None = None) -> Sequence[ContactSolution]:
        """Return the contacts as laws are told of them where a part of the increment has passed."""
        contacts = self.contacts if pressure is None else pressed(self.contacts, pressure)
        if not self.along:
            return contacts
        end, half = self.slid.moment, 0.5 * self.slid.increment
        return loaded(self.model, contacts, end.back(half).time, end.time, place.passed)

    def rates(
        self,
        states: Sequence[Array],
        place: Place,
        told: Sequence[ContactSolution] | None = None,
        model: Model | None = None,
    ) -> Arrays:
        """Return the rates at each position where a part of the increment has passed.

        With those of what is remembered come, once more, those of the depths in layers.
        """
        memory = replace(self.memory(states), shares=place.shares)
        found = stacked(model or self.model, told or self.told(place), memory, self._moment(place))
        laws = self.model.laws.values()
        return found + [found[at] for at, law in enumerate(laws) if law.bottoms]

    def memory(self, states: Sequence[Array]) -> Memory:
        """Return these states, and the depths in layers, as laws and effects know them."""
        return memory_with(self.slid.before, self.layered, states)

    def _moment(self, place: Place) -> Moment:
        if not self.along:
            return self.slid.moment
        moment = self.slid.moment.back((1 - place.passed) * self.slid.increment)
        return replace(moment, over=place.over if self.advances else 0.0)

    def in_layers(self, states: Sequence[Array], place: Place) -> Place:
        """Return a place with the shares of the layers."""
        if not self.layered:
            return place
        memory = self.memory(self.held(states))
        told, moment = self.told(place), self._moment(place)
        shared, _ = in_layers(self.model, memory, told, place.over, moment)
        return place._replace(shares=shared.shares)
