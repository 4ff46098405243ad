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

from tribo_inverse.adjoint.linear import Carrier
from tribo_inverse.adjoint.passing import by_bottoms, lowered, with_bottoms
from tribo_inverse.adjoint.response import Arrays, local
from tribo_inverse.adjoint.tape import Slid


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

    It came to `known`. `slope`, `factor` and `worn` are the derivatives of a point's depth in the
    pressure of each of its cells, in a factor on its rate, and in the depth before.
    """

    model: Model
    contacts: Sequence[ContactSolution]
    slid: Slid
    known: Course
    carrier: Carrier
    slope: Array
    factor: Array
    worn: Array | float

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
            {self.name: own * self.worn},
            Memory({}, {}),
            {self.name: own * self.factor},
            partial(self._through, own),
        )

    @cached_property
    def _depth(self) -> Array:
        return self._worn(self.model, self.known.rates, self.slid)

    def _worn(self, model: Model, rates: CycleRates, slid: Slid) -> Array:
        own = [{self.name: of[self.name]} for of in rates]
        return worn_depths(model, own, slid.increment)[self.name]

    def _through(self, seed: Array, other: Other) -> float:
        if self.name not in other.wears:
            return 0.0
        rates, slid, total = self.known.rates, other.slid, 0.0
        if self.name in other.asks or self.known.memory.shares:
            laws = with_bottoms(other.model, self.model, [self.name])
            model = other.model.with_laws(laws)
            before = replace(slid.before, laws={self.name: slid.before.laws[self.name]})
            rates = course(
                model, before, self.contacts, slid.increment, slid.moment, slid.plan
            ).rates
            lower = lowered(other.model, self.model, self.name)
            follows = by_bottoms(self.known.memory.shares.get(self.name, {}))
            total = sum(
                float(np.sum(seed * by)) * far for by, far in zip(follows, lower, strict=False)
            )
        return total + float(np.sum(seed * (self._worn(other.model, rates, slid) - self._depth)))


def plain(
    model: Model, carrier: Carrier, contacts: Sequence[ContactSolution], slid: Slid, known: Course
) -> Plain:
    """Return an increment, which came to `known`, of a model with one body that wears."""
    (name,) = model.laws.wear
    laws = {name: known.memory.laws[name]}
    memory, worn = _layers(replace(known.memory, laws=laws), name)
    depth, steep = (
        np.stack([getattr(rates[name], which) for rates in known.rates])
        for which in ("depth_rate", "depth_slope")
    )
    if memory.shares:
        (depth,) = stacked(model, contacts, memory, slid.moment)
    if np.any((steep == 0) & (depth > 0)):
        # What falls with the pressure is told to steps as 0.
        pressure = np.stack([contact.pressure for contact in contacts])
        rates = partial(stacked, model, memory=memory, moment=slid.moment)
        (response,) = local(lambda p: rates(pressed(contacts, p)), rates(contacts), pressure)
        steep = np.asarray(response.own)
    shares = np.array([position.share for position in model.cycle])
    box = whole(model.grid.cells)
    part = slid.increment * carrier.part(box)
    factor, slope = carrier.gathered(over(shares) * part * depth, box), part * steep
    return Plain(model, contacts, slid, known, carrier, slope, factor, worn)


def _layers(memory: Memory, name: str) -> tuple[Memory, Array | float]:
    """Return what a law in layers is told for slopes, and that of the depth in the one before."""
    worn: Array | float = 1.0
    if shares := memory.shares.get(name):
        layers = range(len(shares) // 2)
        spent, counts = ([shares[f"{kind} {j}"] for j in layers] for kind in ("rate", "slope"))
        worn = np.ones_like(spent[0])
        for share, count in zip(reversed(spent), reversed(counts), strict=True):
            np.divide(count, share, out=worn, where=share > 0)
        steep = {f"{kind} {j}": counts[j] for kind in ("rate", "slope") for j in layers}
        memory = replace(memory, shares={name: steep})
    return memory, worn


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
