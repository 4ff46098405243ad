"""What an increment wears under given contacts, differentiated backwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.box import whole
from tribo.core.contact import ContactSolution
from tribo.simulation.model import Model
from tribo.stepping.evolution import Course
from tribo.stepping.memory import Memory
from tribo.stepping.rates import Moment, rates_at_each
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.response import Arrays, local
from tribo.study.gradient.tape import Slid


@dataclass(frozen=True)
class Before:
    """The derivatives of an objective in what an increment depends on.

    In the pressures, shape (positions, nx, ny), by the share of each position; in the depths worn
    and what was remembered before; and in a factor, 1 here, on the wear rate of each body.
    """

    pressure: Array
    wear: Mapping[str, Array]
    states: Memory
    factor: Mapping[str, Array]


@dataclass(frozen=True)
class Plain:
    """An increment of a body of which each cell follows its own pressure alone.

    `slope`, `factor` and `worn` are the derivatives of a point's depth in the pressure of each of
    its cells, in a factor on its rate, and in the depth before.
    """

    name: str
    carrier: Carrier
    slope: Array
    factor: Array
    worn: Array | float

    @property
    def bodies(self) -> Sequence[tuple[Carrier, Array]]:
        """Its carrier, and the derivative of a point's depth in the pressures of its cells."""
        return [(self.carrier, self.slope)]

    def back(self, wear: Mapping[str, Array], states: Memory) -> Before:
        """Return derivatives before it from those in the depths after."""
        own = wear[self.name]
        return Before(
            self.slope * self.carrier.seen(own, whole(self.slope.shape[1:])),
            {self.name: own * self.worn},
            Memory({}, {}),
            {self.name: own * self.factor},
        )


def plain(
    model: Model, carrier: Carrier, contacts: Sequence[ContactSolution], slid: Slid, known: Course
) -> Plain:
    """Return an increment, which came to `known`, of a model with one body that wears."""
    (name,) = model.laws
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
        (response,) = local(
            lambda p: stacked(model, pressed(contacts, p), memory, slid.moment), pressure
        )
        steep = response.own
    shares = np.array([position.share for position in model.cycle])
    factor = slid.increment * carrier.mean(depth, shares)
    return Plain(name, carrier, slid.increment * carrier.part * steep, factor, worn)


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
    depths = [[rates.wear[name].depth_rate for rates in found] for name in model.laws]
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
