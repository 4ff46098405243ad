"""The rates of an increment at its stages: at the states, pressures and numbers asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby

import numpy as np
from tribo import Array, ContactSolution, LocalConditions
from tribo.kernel_api import (
    CELLS,
    Box,
    Limits,
    Memory,
    Model,
    Moment,
    at_surface,
    by_reach,
    in_layers,
    layered_bodies,
    limits_of,
    local_fields,
    memory_with,
    over,
    readonly,
    with_loads,
)

from tribo_inverse.adjoint.course import pressed, stacked
from tribo_inverse.adjoint.linear import Carrier, carriers_between
from tribo_inverse.adjoint.rate_stage import RatePlace, RateStage
from tribo_inverse.adjoint.response import ASIDE, Arrays, Field
from tribo_inverse.adjoint.tape import Slid

AT_ONCE = 1 << 18
"""Cells of which laws are asked at once, so that what they compute does not grow with a step."""


@dataclass(frozen=True)
class Stages:
    """The rates of an increment of the bodies of a model that wear.

    Parameters
    ----------
    model, carriers : Model, Mapping of Carrier by body
        Whose bodies, and how their surfaces meet the window.
    box : Box
        The part of the window that is looked at: all of it where effects reach beyond a point or
        layers are; else what touches, in this increment or any, beyond which nothing that presses
        follows what there is.
    contacts : sequence of ContactSolution
        The contacts, on the box.
    slid : Slid
        The increment.
    along : bool
        Whether rates are integrated along it, as where any body remembers.
    advances : bool
        Whether laws that know their means over a part give these.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    box: Box
    contacts: Sequence[ContactSolution]
    slid: Slid
    along: bool
    advances: bool

    @cached_property
    def own(self) -> Sequence[Carrier]:
        """The carriers of the depths worn."""
        return [self.carriers[name] for name in self.model.laws.wear]

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
        return self.of_steps or self.loads_change

    @cached_property
    def loads_change(self) -> bool:
        """Whether laws are told pressures in proportion to loads that may change along it.

        Loads that are alike at both ends in the case need not be so with another number.
        """
        return self.along and not isinstance(self.model.case.load.normal, float)

    @cached_property
    def limits(self) -> list[Limits]:
        """The limits of what is remembered."""
        return limits_of(self.model, self.slid.before)

    @cached_property
    def shares(self) -> Array:
        """The share of the path of each position."""
        return np.array([position.share for position in self.model.cycle])

    def held(self, states: Sequence[Array]) -> Arrays:
        """Return states within their limits."""
        pairs = zip(states, self.limits, strict=True)
        return [np.clip(state, limit.least, limit.most) for state, limit in pairs]

    def nudges(
        self, states: Sequence[Array], rates: Arrays, lengths: Field, part: float = ASIDE
    ) -> Arrays:
        """Return by how much each state is varied, within its limits, to find what follows it.

        By a part of the largest value that it has, or comes to at these rates over lengths (m):
        those of the stages, since over all of an increment in many parts that may be far beyond
        what it is.
        """
        nudges = []
        for state, rate, limit in zip(states, rates[len(self.own) :], self.limits, strict=True):
            largest = np.max(np.abs(state), CELLS, keepdims=True)
            fastest = over(np.max(np.abs(rate), (-3, *CELLS)))
            most = np.maximum(largest, lengths * fastest)
            nudge = part * np.where(most > 0, most, 1.0)
            nudges.append(np.where(state + nudge > limit.most, -nudge, nudge))
        return nudges

    @cached_property
    def counts(self) -> Sequence[tuple[Carrier, Array]]:
        """The carriers of all rates, and what each cell of the box counts for in their means."""
        shares = over(self.shares)
        return [(each, shares * each.part(self.box)) for each in (*self.own, *self.kept)]

    def means(self, rates: Arrays) -> Arrays:
        """Return the mean rates of the depths and of what is remembered, where these lie."""
        pairs = zip(self.counts, rates, strict=True)
        return [carrier.gathered(counts * rate, self.box) for (carrier, counts), rate in pairs]

    def embedded(self, values: Array) -> Array:
        """Return values on the box, by position, in a window of zeros."""
        full = np.zeros((len(values), *self.box.window))
        full[(slice(None), *self.box.slices)] = values
        return full

    def at(self, states: Sequence[Sequence[Array]], places: Sequence[RatePlace]) -> list[RateStage]:
        """Return the stages at some states, each at a place of its own."""
        divided = [self.with_shares(*each) for each in zip(states, places, strict=True)]
        return self.at_shares(states, divided)

    def at_shares(
        self, states: Sequence[Sequence[Array]], places: Sequence[RatePlace]
    ) -> list[RateStage]:
        """Return the same where the places have the shares of the layers already."""
        held = [self.held(each) for each in states]
        rates = self.rates(together(held), places)
        stages = []
        for i, place in enumerate(places):
            inside = [given == kept for given, kept in zip(states[i], held[i], strict=True)]
            here = [each[i] for each in rates]
            stages.append(RateStage(place, held[i], inside, here, self.means(here)))
        return stages

    def told(self, places: Sequence[RatePlace], pressure: Array | None = None) -> Array:
        """Return the pressures that laws are told at some places, (places, positions, nx, ny).

        They are in proportion to a load that changes along the increment. Others may be given
        instead of those of the increment, in the same shape.
        """
        if pressure is None:
            pressure = np.broadcast_to(self.pressure, (len(places), *self.pressure.shape))
        if not self.loads_change:
            return pressure
        return np.stack(
            [
                [contact.pressure for contact in self._loaded(pressed(self.contacts, own), passed)]
                for own, (passed, *_) in zip(pressure, places, strict=True)
            ]
        )

    def rates(
        self,
        states: Sequence[Array],
        places: Sequence[RatePlace],
        told: Array | None = None,
        model: Model | None = None,
    ) -> Arrays:
        """Return the rates at each position at some places, (places, positions, nx, ny).

        With those of what is remembered come, once more, those of the depths in layers. Laws are
        pointwise: where there are no effects they are asked of all places at once.

        Parameters
        ----------
        states : sequence of ndarray, shape (places, rows, ny)
            What is remembered, and the depths in layers.
        places : sequence of RatePlace
            Where along the increment.
        told : ndarray, shape (places, positions, nx, ny), optional
            The pressures; those of `told` if left out.
        model : Model, optional
            One with another number.
        """
        model = model or self.model
        if told is None:
            told = self.told(places)
        groups = [slice(i, i + 1) for i in range(len(places))]
        if not model.laws.effects:
            groups = list(self._alike(places, max(1, AT_ONCE // told[0].size)))
        ask, found = self._in_window if model.laws.effects else self._of_laws, list[Arrays]()
        for group in groups:
            own = [state[group] for state in states]
            found.append(ask(model, own, places[group], told[group]))
        rates = [
            each[0] if len(each) == 1 else np.concatenate(each) for each in zip(*found, strict=True)
        ]
        return rates + [rates[at] for at, law in enumerate(model.laws.wear.values()) if law.bottoms]

    def memory(self, states: Sequence[Array]) -> Memory:
        """Return these states, and the depths in layers, as laws and effects know them."""
        return memory_with(self.slid.before, self.layered, states)

    def with_shares(self, states: Sequence[Array], place: RatePlace) -> RatePlace:
        """Return a place with the shares of the layers."""
        if not self.layered:
            return place
        memory = self.memory(self.held(states))
        told = pressed(self.contacts, self.told([place])[0])
        moment = replace(self._moment(place), over=self._over(place))
        shared, _ = in_layers(self.model, memory, told, place.over, moment)
        return place._replace(shares=shared.shares)

    def _alike(self, places: Sequence[RatePlace], most: int) -> Iterator[slice]:
        """Yield runs of places, of so many at most, over which means are of one length."""
        first = 0
        for _, group in groupby(places, self._over):
            end = first + len(list(group))
            for start in range(first, end, most):
                yield slice(start, min(start + most, end))
            first = end

    def _over(self, place: RatePlace) -> float:
        """Return the length (m) over which rates are means there; 0 where they are of one place."""
        return place.over if self.advances else 0.0

    def _moment(self, place: RatePlace) -> Moment:
        if not self.along:
            return self.slid.moment
        return self.slid.moment.back((1 - place.passed) * self.slid.increment)

    def _loaded(
        self, contacts: Sequence[ContactSolution], passed: float
    ) -> Sequence[ContactSolution]:
        end, half = self.slid.moment, 0.5 * self.slid.increment
        return with_loads(self.model, contacts, end.back(half).time, end.time, passed)

    def _in_window(
        self, model: Model, states: Arrays, places: Sequence[RatePlace], told: Array
    ) -> Arrays:
        """Return the rates at one place, of laws and of effects, which see the whole window."""
        (place,) = places
        memory = replace(self.memory([state[0] for state in states]), shares=place.shares)
        moment = replace(self._moment(place), over=self._over(place))
        shown = told[0] if self.box.is_window else self.embedded(told[0])
        rates = stacked(model, pressed(self.contacts, shown), memory, moment)
        return [each[(None, slice(None), *self.box.slices)] for each in rates]

    def _of_laws(
        self, model: Model, states: Arrays, places: Sequence[RatePlace], told: Array
    ) -> Arrays:
        """Return the rates of the laws at some places, means over the same length (m) each."""
        depths, changes = Arrays(), Arrays()
        each = iter(states)
        laws = {n: {key: next(each) for key in of} for n, of in self.slid.before.laws.items()}
        worn = dict(zip(self.layered, each, strict=True))
        for name, law in model.laws.wear.items():
            own = {**laws.get(name, {}), **_shares_told(law.bottoms, name, worn, places)}
            seen = {key: self.carriers[name].seen(of, self.box) for key, of in own.items()}
            found = [
                self._pointwise(
                    model,
                    name,
                    position,
                    told[:, position],
                    {key: of[:, position] for key, of in seen.items()},
                    0.0 if name in model.cycle.swept else self._over(places[0]),
                )
                for position in range(len(model.cycle))
            ]
            depth, *of_states = (
                np.stack(rates, axis=1) if len(found) > 1 else rates[0][:, None]
                for rates in zip(*found, strict=True)
            )
            depths.append(depth)
            changes += of_states
        return depths + changes

    def _pointwise(
        self,
        model: Model,
        name: str,
        position: int,
        pressure: Array,
        state: Mapping[str, Array],
        over: float,
    ) -> Arrays:
        """Return the rates of a law at a position: its depth's and its states'."""
        law, place, mean = model.laws.wear[name], model.cycle[position], self.slid.moment.speed
        keys = list(self.slid.before.laws.get(name, {}))
        if mean == 0:
            return [np.zeros(pressure.shape)] * (1 + len(keys))

        def tall(values: Array) -> Array:
            if values.shape != pressure.shape:
                values = np.broadcast_to(values, pressure.shape)
            return readonly(values.reshape(-1, self.box.shape[1]))

        given: Mapping[str, Mapping[str, Array]] = {}
        if law.requires:
            window = np.broadcast_to(0.0, self.box.window)
            given = local_fields(model, window, self.slid.moment, position, Memory({}, {}))
        told = LocalConditions(
            pressure=tall(pressure),
            speed=mean,
            material=law.material,
            fields={
                key: tall(given[key][name][self.box.slices] if key in given else state[key])
                for key in law.requires
            },
            state={key: tall(values) for key, values in state.items()},
        )
        total = Arrays()
        for speed, part, _ in by_reach(place.speeds or [(mean, 1.0)], place.reach):
            rate = law.rate(replace(told, speed=speed), over)
            counts = part[self.box.slices] if isinstance(part, np.ndarray) else part
            each = (rate.depth_rate, *(rate.state_rates[key] for key in keys))
            rates = [counts * values.reshape(pressure.shape) for values in each]
            total = [a + b for a, b in zip(total, rates, strict=True)] if total else rates
        return total


def together(states: Sequence[Sequence[Array]]) -> Arrays:
    """Return the states of several stages one below the other, shape (stages, rows, ny)."""
    return [np.stack(each) for each in zip(*states, strict=True)]


def _shares_told(
    bottoms: Sequence[float], name: str, worn: Mapping[str, Array], places: Sequence[RatePlace]
) -> dict[str, Array]:
    """Return what the law of a body in layers is told of them, shape (places, rows, ny)."""
    if not bottoms:
        return {}
    each = [
        place.shares.get(name) or at_surface(bottoms, depth)
        for place, depth in zip(places, worn[name], strict=True)
    ]
    none = np.zeros_like(worn[name][0])
    keys = [f"{kind} {layer}" for layer in range(1 + len(bottoms)) for kind in ("rate", "slope")]
    return {key: np.stack([shares.get(key, none) for shares in each]) for key in keys}
