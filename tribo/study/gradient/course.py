"""What an increment wears and what laws remember of it, differentiated backwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce
from math import inf, prod

import numpy as np

from tribo.contact.projection import over
from tribo.core.arrays import Array
from tribo.core.box import whole
from tribo.core.contact import ContactSolution
from tribo.simulation.model import Model
from tribo.stepping.evolution import Course, loaded
from tribo.stepping.extrapolation import PLAIN, RELAXING, Limits, relaxing
from tribo.stepping.memory import Memory
from tribo.stepping.rates import rates_at_each
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.tape import Slid

NUDGE = 3e-5
"""Part of the pressure by which it is varied to find the derivative of a law, up and down."""
FINE = 1e-6
"""Part of the largest value by which what is remembered is varied."""

States = list[Array]


@dataclass(frozen=True)
class Slopes:
    """Derivatives of an increment, of one body.

    Parameters
    ----------
    pressure : ndarray, shape (positions, nx, ny)
        Of a point's depth in the pressure of each of its cells, by the share of the position, in
        m/Pa.
    factor : ndarray, shape (rows, ny)
        Of a point's depth in a factor, 1 here, on its wear rate.
    worn : ndarray or float
        Of a point's depth in that before.
    state : Mapping[str, ndarray]
        Of a point's depth in what it remembered before.
    given : ndarray, shape (positions, nx, ny)
        Of the objective, through what is remembered after, in pressure, by the share.
    before : Mapping[str, ndarray]
        The same in what was remembered before.
    """

    pressure: Array
    factor: Array
    worn: Array | float
    state: Mapping[str, Array]
    given: Array
    before: Mapping[str, Array]


def slopes(
    model: Model,
    name: str,
    carrier: Carrier,
    contacts: Sequence[ContactSolution],
    slid: Slid,
    known: Course,
    after: Mapping[str, Array],
) -> Slopes:
    """Return the derivatives of an increment of a body, which came to `known`.

    `after` are those of the objective in what is remembered at its end.

    A point's depth depends on the pressures of its own cells and on what it itself remembers, so
    that one way back, from 1 on each point, has the derivatives of all of them.
    """
    slid = replace(slid, before=replace(slid.before, laws={name: slid.before.laws[name]}))
    alone = replace(model, laws={name: model.laws[name]})
    asked = _Asked(alone, model.advances, name, carrier, contacts, slid)
    if any(model.laws[each].initial_state for each in model.laws):
        depth = np.stack([rates[name].depth_rate for rates in known.rates])
        factor = slid.increment * asked.own(depth)
        parts = asked.parts()
        ones, zeros = np.ones_like(factor), np.zeros_like(factor)
        pressure, state = asked.back(parts, ones, [zeros for _ in after])
        given, before = asked.back(parts, zeros, list(after.values()))
        return Slopes(
            pressure,
            factor,
            1.0,
            dict(zip(after, state, strict=True)),
            given,
            dict(zip(after, before, strict=True)),
        )
    memory, worn = _layers(known.memory, name)
    depth, steep = (
        np.stack([getattr(rates[name], which) for rates in known.rates])
        for which in ("depth_rate", "depth_slope")
    )
    if memory is not known.memory:
        (depth,) = asked.rates(memory)
    if np.any((steep == 0) & (depth > 0)):
        # What falls with the pressure is told to steps as 0.
        (steep,) = asked.by_pressure(memory)
    steep = slid.increment * asked.row_weights * steep
    return Slopes(steep, slid.increment * asked.own(depth), worn, {}, np.zeros_like(steep), {})


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


@dataclass(frozen=True)
class _Rates:
    """Rates at one state, of the depth and of each state, with their derivatives in each cell."""

    found: States
    by_pressure: States
    by_state: Sequence[States]
    inside: Sequence[Array]


@dataclass(frozen=True)
class _Part:
    """A part of an increment: its rates along each row of the extrapolation.

    `moved` has the rates at each state moved by a little, and by how much, where it relaxes.
    """

    length: float
    relaxing: Sequence[Array | float]
    rows: Sequence[Sequence[_Rates]]
    moved: Sequence[tuple[_Rates, Array]]


@dataclass(frozen=True)
class _Asked:
    """The law of one body, under given contacts; `advances` as of all of them together."""

    model: Model
    advances: bool
    name: str
    carrier: Carrier
    contacts: Sequence[ContactSolution]
    slid: Slid

    @property
    def row_weights(self) -> Array | float:
        return 1.0 if self.carrier.weights is None else self.carrier.weights

    def own(self, parts: Array) -> Array:
        """Return the mean of what happens in the cells over each point of the body."""
        shares = np.array([position.share for position in self.model.cycle])
        return self.carrier.gathered(
            over(shares) * self.row_weights * parts, whole(self.model.grid.cells)
        )

    def rates(
        self, memory: Memory, passed: float = 1.0, by: float = 1.0, over: float = 0.0
    ) -> States:
        """Return the rates of depth and states at each position, all pressures times `by`.

        They are those where a part of the increment has passed, or a law's means over what follows.
        """
        slid = self.slid
        contacts = loaded(self.model, self.contacts, slid.increment, slid.moment, passed)
        if by != 1:
            contacts = [replace(each, pressure=by * each.pressure) for each in contacts]
        moment = replace(
            slid.moment.back((1 - passed) * slid.increment), over=over if self.advances else 0.0
        )
        found = [
            rates.wear[self.name] for rates in rates_at_each(self.model, contacts, memory, moment)
        ]
        of_states = [
            np.stack([rate.state_rates[key] for rate in found]) for key in memory.laws[self.name]
        ]
        return [np.stack([rate.depth_rate for rate in found]), *of_states]

    def by_pressure(self, memory: Memory, passed: float = 1.0, over: float = 0.0) -> States:
        """Return the derivatives of all rates in the pressure of their own cell."""
        pressure = np.stack([contact.pressure for contact in self.contacts])
        span = np.where(pressure > 0, 2 * NUDGE * pressure, np.inf)
        pairs = zip(
            self.rates(memory, passed, 1 + NUDGE, over),
            self.rates(memory, passed, 1 - NUDGE, over),
            strict=True,
        )
        return [(higher - lower) / span for higher, lower in pairs]

    def memory(self, states: Sequence[Array]) -> Memory:
        keys = self.slid.before.laws[self.name]
        return Memory({self.name: dict(zip(keys, states, strict=True))}, {})

    def limits(self) -> list[Limits]:
        return [
            Limits(
                -inf if field.at_least is None else field.at_least,
                inf if field.at_most is None else field.at_most,
                field.name,
            )
            for key in self.slid.before.laws[self.name]
            for field in self.model.laws[self.name].state_fields
            if field.name == key
        ]

    def local(self, states: Sequence[Array], passed: float, over: float) -> _Rates:
        """Return rates with their derivatives, where a part of the increment has passed."""
        limits = self.limits()
        held = [np.clip(s, each.least, each.most) for s, each in zip(states, limits, strict=True)]
        memory, by_state = self.memory(held), []
        found = self.rates(memory, passed, over=over)
        for at, (state, limit) in enumerate(zip(held, limits, strict=True)):
            nudge = self.nudge(state, found[1 + at])
            ends = [np.clip(state + by, limit.least, limit.most) for by in (nudge, -nudge)]
            span = self.carrier.seen(ends[0] - ends[1], whole(self.model.grid.cells))
            higher, lower = (
                self.rates(self.memory([*held[:at], end, *held[at + 1 :]]), passed, over=over)
                for end in ends
            )
            by_state.append([(up - down) / span for up, down in zip(higher, lower, strict=True)])
        inside = [s == h for s, h in zip(states, held, strict=True)]
        return _Rates(found, self.by_pressure(memory, passed, over), by_state, inside)

    def nudge(self, state: Array, rate: Array) -> float:
        """Return by how much a state is varied to find what follows it."""
        fastest = self.slid.increment * float(np.max(np.abs(rate)))
        return FINE * (max(float(np.max(np.abs(state))), fastest) or 1.0)

    def parts(self) -> list[_Part]:
        """Go through the increment as it was divided, once more."""
        slid, limits, found, passed = self.slid, self.limits(), [], 0.0
        states = list(slid.before.laws[self.name].values())
        for share, relaxes in slid.plan.parts:
            span = share * slid.increment
            start = self.local(states, passed, span)
            of_states: list[Array | float] = [0.0] * len(states)
            moved = []
            if relaxes:
                at_start = partial(self._of_states, passed, span)
                of_states = relaxing(at_start, states, at_start(states), span, limits)
                for at, (state, rate) in enumerate(zip(states, start.found[1:], strict=True)):
                    nudge = self.nudge(state, rate)
                    by = np.where(state + nudge > limits[at].most, -nudge, nudge)
                    other = [*states[:at], state + by, *states[at + 1 :]]
                    moved.append((self.local(other, passed, span), by))
            rows, ends = [], [np.zeros_like(state) for state in states]
            stages = RELAXING if relaxes else PLAIN
            for steps in stages:
                if steps > 1 and self.advances:
                    start = self.local(states, passed, span / steps)
                row, end = self._row(states, start, of_states, passed, share, steps)
                rows.append(row)
                counts = _counts(steps, stages)
                ends = [total + counts * each for total, each in zip(ends, end, strict=True)]
            found.append(_Part(span, of_states, rows, moved))
            states = [
                np.clip(s, each.least, each.most) for s, each in zip(ends, limits, strict=True)
            ]
            passed += share
        return found

    def _of_states(self, passed: float, over: float, values: Sequence[Array], *_: float) -> States:
        return [self.own(rate) for rate in self.rates(self.memory(values), passed, over=over)[1:]]

    def _row(
        self,
        states: States,
        start: _Rates,
        of_states: Sequence[Array | float],
        passed: float,
        share: float,
        steps: int,
    ) -> tuple[list[_Rates], States]:
        """Return the rates along some Euler steps, and the states at their end."""
        row, step = [start], share * self.slid.increment / steps
        for taken in range(1, steps + 1):
            states = [
                state + step * self.own(rate) / (1 - step * slope)
                for state, rate, slope in zip(states, row[-1].found[1:], of_states, strict=True)
            ]
            if taken < steps:
                row.append(self.local(states, passed + share * taken / steps, step))
        return row, states

    def back(self, parts: Sequence[_Part], depth: Array, after: States) -> tuple[Array, States]:
        """Return derivatives in pressure and in the states before, from those in what comes out."""
        pressure = np.zeros((len(self.contacts), *self.model.grid.cells))
        for part in reversed(parts):
            before = [np.zeros_like(seed) for seed in after]
            relaxed = [np.zeros_like(seed) for seed in after]
            stages = [len(row) for row in part.rows]
            for steps, row in zip(stages, part.rows, strict=True):
                counts = _counts(steps, stages)
                seeds = [counts * seed for seed in after]
                step = part.length / steps
                for rates in reversed(row):
                    for at, slope in enumerate(part.relaxing):
                        moved = step / (1 - step * slope)
                        relaxed[at] += seeds[at] * self.own(rates.found[1 + at]) * moved**2
                    each = [
                        seed * step / (1 - step * slope)
                        for seed, slope in zip(seeds, part.relaxing, strict=True)
                    ]
                    found, states = self._behind(rates, [step * counts * depth, *each])
                    pressure += found
                    seeds = [seed + state for seed, state in zip(seeds, states, strict=True)]
                before = [old + seed for old, seed in zip(before, seeds, strict=True)]
            for at, (rates, by) in enumerate(part.moved):
                for where, sign in ((rates, 1.0), (part.rows[0][0], -1.0)):
                    seeds = [np.zeros_like(seed) for seed in (depth, *after)]
                    falls = np.asarray(part.relaxing[at]) < 0
                    seeds[1 + at] = sign * falls * relaxed[at] / by
                    found, states = self._behind(where, seeds)
                    pressure += found
                    before = [old + state for old, state in zip(before, states, strict=True)]
            after = before
        return pressure, after

    def _behind(self, rates: _Rates, seeds: States) -> tuple[Array, States]:
        """Return derivatives in pressure and states from those in the rates of depth and states."""
        window = whole(self.model.grid.cells)
        seen = [self.carrier.seen(seed, window) for seed in seeds]

        def through(slopes: States) -> Array:
            return reduce(np.add, map(np.multiply, seen, slopes))

        pressure: Array = self.row_weights * through(rates.by_pressure)
        states = [
            inside * self.own(through(slopes))
            for inside, slopes in zip(rates.inside, rates.by_state, strict=True)
        ]
        return pressure, states


def _counts(steps: int, stages: Sequence[int]) -> float:
    """Return what a row of the extrapolation counts for in its end."""
    return prod(steps / (steps - other) for other in stages if other != steps)
