"""What an increment wears under given contacts, differentiated backwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from tribo import Array, ContactSolution
from tribo.kernel_api import (
    Course,
    CycleRates,
    Memory,
    Model,
    Moment,
    course,
    over,
    rates_at_each,
    readonly,
    whole,
    worn_depths,
)

from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.increment.response import Arrays, local
from tribo_inverse.recording.tape import Slid


@dataclass(frozen=True)
class Before:
    """The derivatives of an objective in what an increment depends on.

    In the pressures, shape (positions, nx, ny), by the share of each position; in the depths worn
    and what was remembered before; and in a factor, 1 here, on the wear rate of each body.
    `through` tells what an increment of another model adds to it.
    """

    pressure: Array
    wear: Mapping[str, Array]
    states: Memory
    factor: Mapping[str, Array]
    through: Callable[[Other], float]


@dataclass(frozen=True)
class Other:
    """An increment under the same contacts, of a model with another number.

    `wears` are the bodies whose wear may differ, and `asks` those of them whose rates may.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    slid: Slid
    wears: Set[str]
    asks: Set[str]


@dataclass(frozen=True)
class Plain:
    """An increment of the one body of a model, of which each cell follows its own pressure alone.

    It came to `known`. `slope` and `factor` are the derivatives of a point's depth in the pressure
    of each of its cells, and in a factor on its rate.
    """

    model: Model
    contacts: Sequence[ContactSolution]
    slid: Slid
    known: Course
    carrier: Carrier
    slope: Array
    factor: Array

    @property
    def name(self) -> str:
        """The body's name."""
        return next(iter(self.model.laws.wear))

    @property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Its carrier, and the derivative of a point's depth in the pressures of its cells."""
        return [(self.carrier, self.slope)]

    def back(self, wear: Mapping[str, Array]) -> Before:
        """Return derivatives before it from those in the depths after."""
        own = wear[self.name]
        return Before(
            self.slope * self.carrier.seen(own, whole(self.slope.shape[1:])),
            {self.name: own},
            Memory({}, {}),
            {self.name: own * self.factor},
            partial(self._through, own),
        )

    @cached_property
    def _depth(self) -> Array:
        return self._worn(self.model, self.known.rates, self.slid)

    def _worn(self, model: Model, rates: CycleRates, slid: Slid) -> Array:
        own = [{self.name: of[self.name]} for of in rates]
        return worn_depths(model, own, slid.interval.slides)[self.name]

    def _through(self, seed: Array, other: Other) -> float:
        if self.name not in other.wears:
            return 0.0
        rates, slid = self.known.rates, other.slid
        if self.name in other.asks:
            before = replace(slid.before, laws={self.name: slid.before.laws[self.name]})
            found = course(other.model, before, self.contacts, slid.interval, slid.plan)
            rates = found.rates
        return float(np.sum(seed * (self._worn(other.model, rates, slid) - self._depth)))


def plain(
    model: Model, carrier: Carrier, contacts: Sequence[ContactSolution], slid: Slid, known: Course
) -> Plain:
    """Return an increment, which came to `known`, of a model with one body that wears."""
    (name,) = model.laws.wear
    laws = {name: known.memory.laws[name]}
    memory = replace(known.memory, laws=laws)
    depth, steep = (
        np.stack([getattr(rates[name], which) for rates in known.rates])
        for which in ("depth_rate", "depth_slope")
    )
    if np.any((steep == 0) & (depth > 0)):
        # What falls with the pressure is told to steps as 0.
        pressure = np.stack([contact.pressure for contact in contacts])
        rates = partial(stacked, model, memory=memory, moment=slid.interval.end)
        (response,) = local(lambda p: rates(pressed(contacts, p)), rates(contacts), pressure)
        steep = np.asarray(response.own)
    shares = np.array([position.share for position in model.cycle])
    box = whole(model.grid.cells)
    part = slid.interval.slides * carrier.part(box)
    factor, slope = carrier.gathered(over(shares) * part * depth, box), part * steep
    return Plain(model, contacts, slid, known, carrier, slope, factor)


def stacked(
    model: Model, contacts: Sequence[ContactSolution], memory: Memory, moment: Moment
) -> Arrays:
    """Return the rates of all depths, and of all that is remembered, at each position."""
    found = rates_at_each(model, contacts, memory, moment)
    depths = [[rates.wear[name].depth_rate for rates in found] for name in model.laws.wear]
    of_laws = [
        [rates.wear[name].state_rates[key] for rates in found]
        for name, of_law in memory.laws.items()
        for key in of_law
    ]
    cells = model.grid.cells
    between = [
        [np.broadcast_to(rates.between[key], cells) for rates in found] for key in memory.between
    ]
    return [np.stack(each) for each in (*depths, *of_laws, *between)]


def pressed(contacts: Sequence[ContactSolution], pressure: Array) -> list[ContactSolution]:
    """Return contacts with other pressures."""
    return [
        replace(contact, pressure=readonly(each))
        for contact, each in zip(contacts, pressure, strict=True)
    ]
