"""The rates of an increment at its stages, at given states, pressures and numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np
from tribo import Array, Box, CaseError, ContactSolution, Residuals
from tribo.kernel_api import (
    Kept,
    Model,
    Rates,
    Sum,
    kept_in,
    over,
    place,
    rates_of_cycles,
    readonly,
    with_loads,
)

from tribo_inverse.increment.across import EffectFields, held, held_effects
from tribo_inverse.increment.carriers import Carrier, carriers_between
from tribo_inverse.increment.response import ASIDE, Arrays
from tribo_inverse.recording.tape import Slid


@dataclass(frozen=True)
class RateStage:
    """Rates after a part of an increment has `passed`, at states clipped to their limits.

    `rates` hold at each cell of each position, and `means` at each point of the depths and states.
    `inside` has, by state, where it was within its limits before. After the rates in `rates` come
    the inputs of effects for their `answers`. `slopes` are the derivatives of the depth rates in
    pressure, as the laws state them.
    """

    passed: float
    states: Arrays
    inside: Sequence[Array]
    rates: Arrays
    means: Arrays
    slopes: Arrays
    answers: Sequence[Sequence[EffectFields]]


@dataclass(frozen=True)
class Stages:
    """The rates of an increment of the wearing bodies of a model.

    Parameters
    ----------
    model, carriers : Model, Mapping of Carrier by body
        The model, and the carriers of its bodies.
    box : Box
        The part of the window for the rates: all of it where effects reach beyond a point; else
        the contact, in this increment or any, as no pressure depends on cells beyond it.
    pressure : ndarray, shape (positions, nx, ny)
        The pressures, on the box.
    slid : Slid
        The increment.
    along : bool
        Whether rates are integrated along it, as with states of any body.
    """

    model: Model
    carriers: Mapping[str, Carrier]
    box: Box
    pressure: Array
    slid: Slid
    along: bool

    @cached_property
    def own(self) -> Sequence[Carrier]:
        """The carriers of the depths worn."""
        return [self.carriers[name] for name in self.model.laws.wear]

    @cached_property
    def kept(self) -> Sequence[Carrier]:
        """The carriers of the states, in the order of `Memory.values`."""
        of_laws = [self.carriers[name] for name, of in self.slid.before.laws.items() for _ in of]
        between = carriers_between(self.model, self.carriers).values()
        return [*of_laws, *between]

    @cached_property
    def loads_change(self) -> bool:
        """Whether laws get pressures in proportion to loads that may change along it.

        Loads that are equal at both ends in the case may differ with another number.
        """
        return self.along and not isinstance(self.model.case.load.normal, float)

    @cached_property
    def limits(self) -> list[Kept]:
        """The limits and breaks of the states."""
        return kept_in(self.model, self.slid.before)

    def of_bodies(self, model: Model, names: Iterable[str]) -> Model:
        """Return a model with the laws of some bodies, or all laws where effects see them."""
        wear = model.laws.wear
        return model if model.laws.effects else model.with_laws({n: wear[n] for n in names})

    @cached_property
    def shares_load(self) -> bool:
        """Whether effects declare that points depend on the load and the area of the contact."""
        across = held_effects(self.model)
        if across and len(self.model.cycle) > 1:
            raise CaseError(
                f"{across[0]} reaches across the contact, which has no gradient at several "
                'positions; set kinematics.positions = "average"',
                "kinematics.positions",
            )
        # Of effects with a `pull_back` only the rates of their states are asked for.
        asked = (e for e in self.model.laws.effects if e not in across or e.state_fields)
        effects = [effect.component for effect in asked]
        if silent := [repr(e.type) for e in effects if e.reach not in ("point", "contact")]:
            raise CaseError(
                f"{', '.join(silent)} does not declare its reach, which a gradient needs; let its "
                'class say reach = "point" or reach = "contact", or let it state pull_back',
                "effects",
            )
        return any(effect.reach == "contact" for effect in effects)

    @property
    def sums(self) -> list[Sum]:
        """The depths worn, as sums of the integrator, where they lie."""
        return [Sum(place(self.model, name)) for name in self.model.laws.wear]

    @cached_property
    def shares(self) -> Array:
        """The share of the path of each position."""
        return np.array([position.share for position in self.model.cycle])

    def held(self, states: Sequence[Array]) -> Arrays:
        """Return states within their limits."""
        return [of.hold(state) for state, of in zip(states, self.limits, strict=True)]

    def nudge(self, stage: RateStage, at: int) -> Array:
        """Return the variation of a state for derivatives in it, past no limit or break.

        It is a part of the largest value of the state, now or at these rates after its part of the
        increment; over a whole increment of many parts that value may be far too large.
        """
        state, rate = stage.states[at], stage.rates[len(self.own) + at]
        later = self.part_after(stage.passed) * float(np.max(np.abs(rate)))
        most = max(float(np.max(np.abs(state))), later)
        return self.limits[at].aside(state, ASIDE * (most if most > 0 else 1.0)) - state

    def part_after(self, passed: float) -> float:
        """Return the length (m) of the part of the increment around the share `passed`."""
        shares = [share for share in self.slid.plan if share.start <= passed]
        return self.slid.interval.length * shares[-1].size

    @cached_property
    def counts(self) -> Sequence[tuple[Carrier, Array]]:
        """The carriers of all rates, and the weight of each cell of the box in their means."""
        shares = over(self.shares)
        return [(each, shares * each.part(self.box)) for each in (*self.own, *self.kept)]

    def means(self, rates: Arrays) -> Arrays:
        """Return the mean rates of the depths and states, where these lie."""
        pairs = zip(self.counts, rates, strict=False)
        return [carrier.gathered(counts * rate, self.box) for (carrier, counts), rate in pairs]

    def at(self, states: Sequence[Array], passed: float) -> RateStage:
        """Return the stage at some states after a part of the increment."""
        within = self.held(states)
        inside = [given == kept for given, kept in zip(states, within, strict=True)]
        (found,) = self._rates_of(self.model, [(within, passed, self.told(passed))])
        answers = [[*effect.noted] for effect in held_effects(self.model)]
        rates = self._arrays(found, answers)
        laws = self.model.laws.wear
        slopes = [self._on_box(of.wear[name].depth_slope for of in found) for name in laws]
        means = self.means(rates)
        return RateStage(passed, within, inside, rates, means, slopes, answers)

    @cached_property
    def contacts(self) -> Sequence[ContactSolution]:
        """The contacts of the increment."""
        return self.contacts_of(self.pressure)

    def contacts_of(self, pressure: Array) -> list[ContactSolution]:
        """Return contacts in the window, as inputs of laws, from pressures on the box."""
        shown = readonly(pressure if self.box.is_window else self.box.embed(pressure))
        nothing = np.zeros(shown.shape[1:]), 0, Residuals(0.0, 0.0, 0.0)
        return [ContactSolution(each, 0.0, *nothing) for each in shown]

    def told(self, passed: float, pressure: Array | None = None) -> Array:
        """Return the pressures for laws at a stage, (positions, nx, ny).

        They are in proportion to a load that changes along the increment. `pressure` replaces the
        pressures of the increment.
        """
        if pressure is None:
            pressure = self.pressure
        if not self.loads_change:
            return pressure
        contacts = self.contacts_of(pressure)
        loaded = with_loads(self.model, contacts, self.slid.interval, passed)
        return self._on_box(contact.pressure for contact in loaded)

    def rates(
        self,
        stages: Sequence[RateStage],
        states: Iterable[Sequence[Array]] | None = None,
        told: Iterable[Array] | None = None,
        model: Model | None = None,
    ) -> list[Arrays]:
        """Return the rates of stages with something else, each of shape (positions, nx, ny).

        After them come the inputs of effects with a `pull_back`, which are held at their answers of
        the stages. Rates of laws that the model lacks are the arrays of the stage itself.

        Parameters
        ----------
        stages : sequence of RateStage
            The stages.
        states : iterable of sequence of ndarray, shape (rows, ny), optional
            The states of each; its own if left out.
        told : iterable of ndarray, shape (positions, nx, ny), optional
            The pressures of each; the results of `told` if left out.
        model : Model, optional
            A model with another number, or with some of the laws.
        """
        model, states = model or self.model, states or (stage.states for stage in stages)
        passed = [stage.passed for stage in stages]
        asked = [*zip(states, passed, told or map(self.told, passed), strict=True)]
        if not stages[0].answers:
            pairs = zip(stages, self._rates_of(model, asked), strict=True)
            return [self._arrays(found, (), stage.rates) for stage, found in pairs]
        rates = []
        for stage, each in zip(stages, asked, strict=True):
            holding = held(model, stage.answers)
            (found,) = self._rates_of(holding, [each])
            answers = [effect.noted for effect in held_effects(holding)]
            rates.append(self._arrays(found, answers, stage.rates))
        return rates

    def _rates_of(
        self, model: Model, asked: Iterable[tuple[Sequence[Array], float, Array]]
    ) -> list[list[Rates]]:
        """Return the rates of laws and effects by position, with the whole window as input.

        They are `asked` for at states, a share of the increment, and pressures.
        """
        for effect in held_effects(model):
            effect.noted.clear()
        cycles = []
        for states, passed, told in asked:
            contacts = self.contacts if told is self.pressure else self.contacts_of(told)
            memory = self.slid.before.with_values(iter(states))
            cycles.append((contacts, memory, self.slid.interval.at(passed)))
        return rates_of_cycles(model, cycles)

    def _arrays(
        self,
        found: Sequence[Rates],
        answers: Iterable[Sequence[EffectFields]],
        known: Sequence[Array] = (),
    ) -> Arrays:
        """Return the rates of a model on the box, and the inputs of the answers of its effects.

        The rates of laws that it lacks are `known`.
        """
        memory = self.slid.before
        asked = [(name, "") for name in self.model.laws.wear]
        asked += [(name, key) for name, of_law in memory.laws.items() for key in of_law]
        rates = [
            self._on_box(
                of.wear[name].state_rates[key] if key else of.wear[name].depth_rate for of in found
            )
            if name in found[0].wear
            else known[at]
            for at, (name, key) in enumerate(asked)
        ]
        rates += [
            self._on_box(np.broadcast_to(of.between[key], self.box.window) for of in found)
            for key in memory.between
        ]
        told = (value for answer in chain(*answers) for value in answer.told.values())
        return rates + [self._on_box([value]) for value in told]

    def _on_box(self, fields: Iterable[Array]) -> Array:
        """Return fields on the box or the window, on the box."""
        shape = self.box.shape
        return np.stack([of if of.shape == shape else of[self.box.slices] for of in fields])
