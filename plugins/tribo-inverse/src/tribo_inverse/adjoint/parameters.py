"""The derivative of a step under given pressures in each number of a case."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from pydantic import ValidationError
from tribo import Array, CaseError, Mask, Operator, TriboError
from tribo.kernel_api import Interval, Model, assemble

from tribo_inverse.adjoint.numbers import ANY, changed
from tribo_inverse.adjoint.view import Seeds
from tribo_inverse.increment.breaks import check_breaks, unreached
from tribo_inverse.increment.carriers import Carrier, carriers_of
from tribo_inverse.increment.increment import Before, Increment, States
from tribo_inverse.increment.response import ASIDE
from tribo_inverse.recording.local import OF_CONTACT, OF_MOTION, localised
from tribo_inverse.recording.tape import Pressed

OF_LAW = frozenset({"wear", "layers", "effects", "friction"})
"""Keys of a case whose numbers enter a law or an effect itself."""
MOVES = "it moves the positions of the cycle by whole cells"
TURNS = (
    "has no derivative: the motion turns where it would be taken, at speed 0; "
    "give kinematics.distance, whose derivative exists"
)


@dataclass(frozen=True)
class Stops:
    """Times at which steps of a model always end, in s, and the distance slid by then, in m.

    In between, a model with another number steps at the same parts of each stretch.
    """

    times: Array
    distances: Array

    @staticmethod
    def of(model: Model) -> Stops:
        """Return the stops of a model, including 0."""
        edges = {*model.contact.loads.edges, *model.motion.edges()}
        within = {time for time in edges if 0 < time < model.end_time}
        return Stops.at(model, sorted({0.0, *model.saves, *within}))

    @staticmethod
    def at(model: Model, times: Iterable[float]) -> Stops:
        """Return the stops of a model at these times."""
        found = np.array(list(times))
        return Stops(found, np.array([model.motion.distance_at(float(time)) for time in found]))


@dataclass(frozen=True)
class Variant:
    """A model with a number changed, and its weight in the derivative.

    `carriers` is None where the motion is unchanged.
    """

    model: Model
    weight: float
    stops: Stops
    carriers: Mapping[str, Carrier] | None


@dataclass(frozen=True)
class Chain:
    """The derivatives in the number at a path of a case, by differences of models.

    The weighted sum over `variants` is the derivative; `base` is the model of the case itself, and
    `stops` are its stops. `wears` has what changes the wear of some `bodies` under given contacts:
    keys of the numbers, some `OF_LAW`, or inputs of laws and effects. `spreads` is whether K
    changes its shape too, and not only its size.
    """

    path: str
    value: float
    variants: Sequence[Variant]
    base: Model
    stops: Stops
    wears: Set[str]
    bodies: Collection[str]
    spreads: bool

    def until(self, end: float) -> Chain:
        """Return the chain for a run that ends at a time (s) before the end of the model."""
        before = self.stops.times < end
        own = Stops.at(self.base, [*self.stops.times[before], end])
        variants = [
            replace(each, stops=own)
            if each.stops is self.stops
            else replace(each, stops=Stops.at(each.model, [*each.stops.times[before], end]))
            for each in self.variants
        ]
        return replace(self, stops=own, variants=variants)

    def by_save(self, time: float, seeds: Seeds) -> float:
        """Return the part through the time and distance of a save at `time` (s) of the case."""
        return sum(
            each.weight * (seeds.time * when + seeds.distance * each.model.motion.distance_at(when))
            for each in self.variants
            for when in [self._then(each, time)]
        )

    def by_stop(self, by_depth: float) -> float:
        """Return the part through the depth that ends the run, given the derivative in it."""
        stops = ((each.weight, each.model.case.stop.depth) for each in self.variants)
        return by_depth * sum(weight * depth for weight, depth in stops if depth is not None)

    def by_load(self, record: Pressed, by_load: Array) -> float:
        """Return the part through the loads of a contact, given the derivative in each."""
        total = 0.0
        for each in self.variants:
            loads = getattr(each.model.contact.loads, record.load)
            times = [self._then(each, time) for time in record.times]
            total += each.weight * float(np.sum(by_load * np.array(loads(*times))))
        return total

    def by_spread(self, touching: Mask, seeds: Array, pressure: Array) -> float:
        """Return the part through the displacements K p, given the derivatives in them.

        Both lie on the box of K around the contact, shape (positions, nx, ny). It is 0 for a number
        that only scales K, whose part is in `by_rest`.
        """
        return sum(
            each.weight * float(np.sum(seeds * _operator(each.model, touching).apply(pressure)))
            for each in self.variants
            if self.spreads
        )

    def by_wear(self, part: Increment, before: Before, seen: Set[str]) -> float:
        """Return the part through an increment under given contacts.

        `before` has the derivatives in its inputs, and `seen` the inputs that laws and effects
        read.
        """
        # Rates that the number does not enter need not be evaluated again.
        asks, total = () if self.wears.isdisjoint(OF_LAW | seen) else self.bodies, 0.0
        own, carriers = part.stages.slid.interval, part.stages.carriers
        # Points that slide further wear more, whatever their law looks at.
        for each in self.variants if asks or self.wears & OF_MOTION else ():
            if each.stops is self.stops:
                continue
            begun, ended = (self._then(each, time) for time in (own.time, own.end_time))
            began, end = (
                float(np.interp(place, self.stops.distances, each.stops.distances))
                for place in (own.distance, own.end.distance)
            )
            slides = 0.0 if own.rests else end - began
            then = Interval(begun, began, ended, slides)
            moved = each.carriers or carriers
            total += each.weight * part.through(before, each.model, moved, then, asks=asks)
        return total

    def by_rest(
        self,
        gap: Array,
        stiffness: float,
        cap: float,
        states: States,
    ) -> float:
        """Return the part through shapes, moduli, the hardness and first states."""
        total = 0.0
        for each in self.variants:
            model = each.model
            through = sum(
                float(np.sum(g * shape)) for g, shape in zip(gap, model.contact.gaps, strict=True)
            )
            if not self.spreads:
                through -= stiffness * np.log(softness(model) / softness(self.base))
            if model.contact.system.cap is not None:
                through += cap * model.contact.system.cap
            for (name, key), by in states.items():
                if name is None:
                    effect, field = model.laws.between[key]
                    first = effect.initial_state[field.name]
                else:
                    first = model.laws.wear[name].own_state[key]
                through += first * float(np.sum(by))
            total += each.weight * through
        return total

    def _then(self, each: Variant, time: float) -> float:
        """Return the time in a variant that corresponds to `time` (s) in the case."""
        return float(np.interp(time, self.stops.times, each.stops.times))


def chain(
    base: Model,
    path: str,
    places: Sequence[Sequence[Any]],
    value: float,
    factors: Mapping[str, Array],
) -> Chain:
    """Return the chain of a number; `factors` are the base's factors on wear rates.

    Raises
    ------
    CaseError
        If the case has no derivative in it.
    """
    if value == 0:
        raise CaseError("is 0, of which no part can be taken as a difference", path)
    step, moves = ASIDE * value, places[0][0] == "kinematics"
    error: Exception | None = None
    both, above, below = [(1, 0.5), (-1, -0.5)], [(1, 1.0), (0, -1.0)], [(0, 1.0), (-1, -1.0)]
    # Numbers of the motion may be at any phase of many cycles.
    for scheme in (both, above, below) if moves else (above, below):
        try:
            models = [
                _varied(base, places, value + by * step, factors) if by else base
                for by, _ in scheme
            ]
        except (TriboError, ValidationError) as failed:
            error = error or failed
            continue
        if scheme is both:
            _check_smooth(models[0], base, models[1], path)
        own = Stops.of(base)
        variants = [
            Variant(
                model,
                weight / step,
                own if model is base else Stops.of(model),
                _moved(model, base) if moves else None,
            )
            for model, (_, weight) in zip(models, scheme, strict=True)
        ]
        other = next(model for model in models if model is not base)
        wears, spreads = _wears(base, other, places), _spreads(base, other)
        bodies = set(base.laws.wear)
        if places[0][0] == "bodies" and not base.laws.effects:
            bodies.intersection_update(place[1] for place in places)
        return Chain(path, value, variants, base, own, wears, bodies, spreads)
    why = error.errors()[0]["msg"] if isinstance(error, ValidationError) else str(error)
    for place in (path, *(".".join(map(str, place)) for place in places)):
        why = why.removeprefix(f"{place}: ")
    raise CaseError(f"has no derivative here: {why}", path)


def at_turn(model: Model, times: Iterable[float]) -> set[str]:
    """Return paths of the numbers that move the phase of the motion, which turns at such a time.

    The derivative there is 0, while whole cycles more wear more.
    """
    turning = [time for time in times if _turns(model, time)]
    by_time = getattr(model.case.kinematics, "duration", None) is not None
    names = {"cycles", "duration"} if model.end_time in turning else set[str]()
    if any(by_time or time < model.end_time for time in turning):
        names.add("frequency")
    return {f"kinematics.{name}" for name in names}


def _turns(model: Model, time: float) -> bool:
    """Whether the speed of a motion falls to 0 at `time`, in s."""
    motion, end = model.case.kinematics, model.end_time
    if time <= 0 or math.isinf(motion.lap):
        return False
    # A thousandth of a lap, at the mean speed.
    short = 1e-3 * motion.lap * end / motion.distance_at(end)
    last = motion.distance_at(time)
    near, far = (last - motion.distance_at(time - by * short) for by in (1, 2))
    # At a constant speed it is 2 times as far; where the speed falls to 0, 4 times.
    return far > 3 * near


def _moved(model: Model, base: Model) -> Mapping[str, Carrier] | None:
    """Return the carriers of bodies; None if they and the positions' shares equal the base's."""
    found, own = carriers_of(model), carriers_of(base)
    pairs = [([at.share for at in model.cycle], [at.share for at in base.cycle])]
    for name, carrier in found.items():
        pairs += [*zip(vars(carrier).values(), vars(own[name]).values(), strict=True)]
    return None if all(np.array_equal(now, was) for now, was in pairs) else found


def of_length(model: Model, end: float) -> Chain:
    """Return the chain of the time of the end, `end`, in s."""
    times = Stops.of(model).times
    before = times[times < end]
    step = ASIDE * (end - before[-1])
    variants = [
        Variant(model, 0.5 * by / step, Stops.at(model, [*before, end + by * step]), None)
        for by in (1, -1)
    ]
    own = Stops.at(model, [*before, end])
    return Chain("stop.depth", end, variants, model, own, OF_LAW, model.laws.wear, False)


def _varied(
    base: Model, places: Sequence[Sequence[Any]], number: float, factors: Mapping[str, Array]
) -> Model:
    """Return the model of a case with another number; refuse a change of its structure."""
    case = base.case
    for place in places:
        case = changed(case, place, number)
    model = unreached(localised(assemble(case), factors), base)
    if not base.laws.effects:
        # Effects of the motion too: no law depends on them.
        model = replace(model, laws=replace(model.laws, effects=()))
    check_breaks(model, base)
    ways, others = (
        [(e.rows, [*map(e.first_cell, range(len(each.cycle)))]) for e in each.cycle.maps.values()]
        for each in (base, model)
    )
    if ways != others:
        raise CaseError(MOVES)
    if base.contact.plastic_share != model.contact.plastic_share:
        raise CaseError(
            "both bodies have the same hardness, and either may be the softer; name both, as "
            f"bodies.{ANY}.material.hardness"
        )
    times, other_times = Stops.of(base).times, Stops.of(model).times
    if len(times) != len(other_times):
        at = np.setxor1d(times, other_times)[0]
        raise CaseError(
            f"a change of it separates events that coincide at {at:.4g} s: a save, the end of a "
            "stage of the load or of the motion; move one of them a little"
        )
    return model


def _wears(base: Model, model: Model, places: Sequence[Sequence[Any]]) -> frozenset[str]:
    """Return what changes the wear under given contacts: see `Chain`."""
    one, other, laws = base.case, model.case, model.laws
    same = np.array_equal(Stops.of(base).times, Stops.of(model).times)
    moves = one.kinematics != other.kinematics or not same
    wears = {str(key) for place in places for key in place}
    wears |= {
        name
        for name in OF_CONTACT
        if getattr(base.contact.system, name) != getattr(model.contact.system, name)
    }
    # States follow a load that changes in a step.
    keeps = laws.between or any(law.initial_state for law in laws.wear.values())
    follows = keeps and one.load != other.load and not isinstance(one.load.normal, float)
    if follows or (moves and any(position.reach is not None for position in model.cycle)):
        wears |= OF_LAW
    return frozenset(wears | OF_MOTION if moves else wears)


def _check_smooth(higher: Model, base: Model, lower: Model, path: str) -> None:
    """Refuse a number at which the shares of the positions have a kink."""
    up, at, down = (
        np.array([position.share for position in model.cycle]) for model in (higher, base, lower)
    )
    if np.max(np.abs(up + down - 2 * at)) > 1e-3 * np.max(np.abs(up - down)) + 1e-13:
        raise CaseError(MOVES, path)


def _spreads(base: Model, model: Model) -> bool:
    """Whether K of a model has another shape, as with another elasticity of a layer."""
    ratio = _symbol(model) / _symbol(base)
    return bool(np.ptp(ratio) > 1e-9 * np.max(ratio))


def softness(model: Model) -> float:
    """Return a number to which K is proportional, in m/Pa."""
    return float(np.max(_symbol(model)))


def _symbol(model: Model) -> Array:
    cell = np.zeros(model.grid.cells, dtype=bool)
    cell[model.grid.cells[0] // 2, model.grid.cells[1] // 2] = True
    return _operator(model, cell).symbol()


def _operator(model: Model, touching: Mask) -> Operator:
    found = model.case.contact.operator(model.contact.system, touching)
    assert found is not None
    return found[1]
