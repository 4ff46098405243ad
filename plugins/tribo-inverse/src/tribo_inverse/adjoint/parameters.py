"""The change of a step under given pressures with each number of a case."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any

import numpy as np
from tribo import Array, CaseError, Mask, Operator, TriboError
from tribo.kernel_api import Interval, Model, assemble

from tribo_inverse.adjoint.numbers import changed
from tribo_inverse.adjoint.view import Seeds
from tribo_inverse.increment.breaks import other_breaks
from tribo_inverse.increment.carriers import Carrier, carriers_of
from tribo_inverse.increment.increment import Before, Increment, Place, States
from tribo_inverse.increment.response import ASIDE
from tribo_inverse.recording.local import OF_CONTACT, OF_MOTION, localised
from tribo_inverse.recording.tape import Pressed

OF_LAW = frozenset({"wear", "layers", "effects", "friction"})
"""Keys of a case whose numbers enter the rates of laws and effects themselves."""
SAME = 1e-9
"""Relative difference up to which K has the same shape, as with another modulus."""
TURNS = (
    "has no derivative: the motion turns where it would be taken, at speed 0; "
    "give kinematics.distance, whose derivative exists"
)
MOVES = "it moves the positions of the cycle by whole cells"
STRUCTURE: Mapping[str, Callable[[Model], object]] = {
    MOVES: lambda model: [
        (each.rows, [*map(each.first_cell, range(len(model.cycle)))])
        for each in model.cycle.maps.values()
    ],
    "it moves where a rate jumps; a gradient follows jumps at layers alone, of laws that do not "
    "depend on the depth": other_breaks,
    "either body may be the softer; name both, as bodies.*.material.hardness": lambda model: (
        model.contact.plastic_share
    ),
    "it separates events that coincide, as a save and the end of a stage; move one a little": (
        lambda model: len(Stops.of(model).times)
    ),
}
"""By what is refused: the parts of a model that may not differ with a number."""


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


class Variant:
    """A model with a number changed; its methods return changes from the model of the case.

    Parameters
    ----------
    base, model : Model
        The model of the case, and the model with another number.
    keys : Set of str
        The keys of the number.
    """

    def __init__(self, base: Model, model: Model, keys: Set[str]) -> None:
        self.base, self.model = base, model
        self.own, self.stops = Stops.of(base), Stops.of(model)
        self.carriers = _moved(base, model) if "kinematics" in keys else None
        system, other = base.contact.system, model.contact.system
        reads = {name for name in OF_CONTACT if getattr(system, name) != getattr(other, name)}
        same = np.array_equal(self.own.times, self.stops.times)
        self._moves = "kinematics" in keys or not same
        self._reads = keys | reads | (OF_MOTION if self._moves else set())
        # States follow a load over time; points that slide further have a speed of their own.
        follows = "load" in keys and not isinstance(base.case.load.normal, float)
        reaches = self._moves and any(position.reach is not None for position in model.cycle)
        self._asks = follows or reaches or not OF_LAW.isdisjoint(keys)
        # Effects see the wear of both bodies.
        bodies = keys if "bodies" in keys and not base.laws.effects else base.laws.wear
        self._bodies = [name for name in base.laws.wear if name in bodies]
        ratio = _symbol(model) / _symbol(base)
        spreads = bool(np.ptp(ratio) > SAME * np.max(ratio))
        self._stiffness = None if spreads else -float(np.log(np.max(ratio)))

    def until(self, end: float, then: float) -> None:
        """End sooner: the model of the case at a time `end`, in s, and this one at `then`."""
        before = self.own.times < end
        self.own = Stops.at(self.base, [*self.own.times[before], end])
        self.stops = Stops.at(self.model, [*self.stops.times[before], then])

    def by_save(self, time: float, seeds: Seeds) -> float:
        """Return the part through the time and distance of a save at `time` (s) of the case."""
        then = self._then(time)
        slid = self.model.motion.distance_at(then) - self.base.motion.distance_at(time)
        return seeds.time * (then - time) + seeds.distance * slid

    def by_stop(self, by_depth: float) -> float:
        """Return the part through the depth that ends the run, given the derivative in it."""
        own, other = self.base.case.stop.depth, self.model.case.stop.depth
        return 0.0 if own is None or other is None else by_depth * (other - own)

    def by_load(self, record: Pressed, by_load: Array) -> float:
        """Return the part through the loads of a contact, given the derivative in each."""
        own = getattr(self.base.contact.loads, record.load)(*record.times)
        other = getattr(self.model.contact.loads, record.load)(*map(self._then, record.times))
        return float(np.sum(by_load * np.subtract(other, own)))

    def by_spread(self, touching: Mask, seeds: Array, pressure: Array) -> float:
        """Return the part through the displacements K p, given the derivatives in them.

        Both lie on the box of K around the contact, shape (positions, nx, ny). It is 0 for a number
        that only scales K, whose part is in `by_rest`.
        """
        if self._stiffness is not None:
            return 0.0
        own, other = _operator(self.base, touching), _operator(self.model, touching)
        return float(np.sum(seeds * (other.apply(pressure) - own.apply(pressure))))

    def by_wear(self, part: Increment, before: Before, seen: Set[str]) -> float:
        """Return the part through an increment under given contacts.

        `before` has the derivatives in its inputs, and `seen` the inputs that laws and effects
        read.
        """
        asks = self._bodies if self._asks or not self._reads.isdisjoint(seen) else ()
        if not (asks or self._moves):
            return 0.0
        own, carriers = part.slid.interval, part.carriers
        begun, ended = self._then(own.time), self._then(own.end_time)
        began, end = (
            float(np.interp(place, self.own.distances, self.stops.distances))
            for place in (own.distance, own.end.distance)
        )
        then = Interval(begun, began, ended, 0.0 if own.rests else end - began)
        return part.through(before, self.model, self.carriers or carriers, then, asks=asks)

    def by_rest(self, gap: Array, stiffness: float, cap: float, states: States) -> float:
        """Return the part through shapes, moduli, the hardness and first states."""
        own, other = self.base.contact, self.model.contact
        pairs = zip(own.gaps, other.gaps, strict=True)
        through = sum(
            float(np.sum(by * (new - old))) for by, (old, new) in zip(gap, pairs, strict=True)
        )
        through += stiffness * (self._stiffness or 0.0)
        if own.system.cap is not None and other.system.cap is not None:
            through += cap * (other.system.cap - own.system.cap)
        old, new = _first_states(self.base), _first_states(self.model)
        return through + sum((new[of] - old[of]) * float(np.sum(by)) for of, by in states.items())

    def _then(self, time: float) -> float:
        """Return the time that corresponds to `time` (s) in the case."""
        return float(np.interp(time, self.own.times, self.stops.times))


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


def _moved(base: Model, model: Model) -> Mapping[str, Carrier] | None:
    """Return the carriers of a model; None if they and its positions' shares equal the base's."""
    own, other = carriers_of(base), carriers_of(model)
    pairs = [([at.share for at in base.cycle], [at.share for at in model.cycle])]
    for name, carrier in other.items():
        pairs += [*zip(vars(own[name]).values(), vars(carrier).values(), strict=True)]
    return None if all(np.array_equal(was, now) for was, now in pairs) else other


@dataclass(frozen=True)
class Chain:
    """The derivatives in the number at a path of a case, by differences.

    The derivative is the sum of the changes of `variants`, each with its weight.
    """

    path: str
    value: float
    variants: Sequence[tuple[float, Variant]]

    def sum(self, change: Callable[[Variant], float]) -> float:
        """Return the derivative of a part, given its change with a variant."""
        return sum(weight * change(variant) for weight, variant in self.variants)


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
    refused: TriboError | None = None
    # Numbers of the motion may be at any phase of many cycles.
    both = [(1, -1)] if places[0][0] == "kinematics" else []
    for sides in (*both, (1,), (-1,)):
        steps = [side * ASIDE * value for side in sides]
        try:
            models = [_varied(base, path, places, value + step, factors) for step in steps]
        except TriboError as error:
            refused = refused or error
            continue
        if len(models) == 2:
            _check_smooth(models[0], base, models[1], path)
        keys = {str(key) for place in places for key in place}
        variants = [
            (1 / (len(sides) * step), Variant(base, model, keys))
            for step, model in zip(steps, models, strict=True)
        ]
        return Chain(path, value, variants)
    why = str(refused).removeprefix(f"{path}: ")
    raise CaseError(f"has no derivative here: {why}", path)


def of_length(model: Model, end: float) -> Chain:
    """Return the chain of the time of the end, `end`, in s."""
    times = Stops.of(model).times
    step = ASIDE * (end - times[times < end][-1])
    found = Chain(
        "stop.depth", end, [(0.5 / by, Variant(model, model, OF_LAW)) for by in (step, -step)]
    )
    for weight, variant in found.variants:
        variant.until(end, end + 0.5 / weight)
    return found


def _varied(
    base: Model,
    path: str,
    places: Sequence[Sequence[Any]],
    number: float,
    factors: Mapping[str, Array],
) -> Model:
    """Return the model of a case with another number; refuse a change of its structure."""
    model = localised(assemble(changed(base.case, path, places, number)), factors)
    for words, of in STRUCTURE.items():
        if of(model) != of(base):
            raise CaseError(words)
    return model


def _check_smooth(higher: Model, base: Model, lower: Model, path: str) -> None:
    """Refuse a number at which the shares of the positions have a kink."""
    up, at, down = (
        np.array([position.share for position in model.cycle]) for model in (higher, base, lower)
    )
    if np.max(np.abs(up + down - 2 * at)) > 1e-3 * np.max(np.abs(up - down)) + 1e-13:
        raise CaseError(MOVES, path)


def _first_states(model: Model) -> dict[Place, float]:
    """Return the first values of the states of laws and effects."""
    found: dict[Place, float] = {
        (name, key): first
        for name, law in model.laws.wear.items()
        for key, first in law.own_state.items()
    }
    for key, (effect, field) in model.laws.between.items():
        found[None, key] = effect.initial_state[field.name]
    return found


def _symbol(model: Model) -> Array:
    """Return the eigenvalues of K."""
    cell = np.zeros(model.grid.cells, dtype=bool)
    cell[model.grid.cells[0] // 2, model.grid.cells[1] // 2] = True
    return _operator(model, cell).symbol()


def _operator(model: Model, touching: Mask) -> Operator:
    found = model.case.contact.operator(model.contact.system, touching)
    assert found is not None
    return found[1]
