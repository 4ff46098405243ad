"""The numbers of a case, and what each of them changes in a step whose pressures are given."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError

from tribo.case import Case
from tribo.config.overrides import leaves, path_keys
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, TriboError
from tribo.core.words import did_you_mean, suggestion
from tribo.simulation.assembly import assemble
from tribo.simulation.model import Model
from tribo.study.gradient.linear import Carrier
from tribo.study.gradient.local import localised
from tribo.study.gradient.tape import Pressed, Slid
from tribo.study.gradient.touched import Touched, carriers

NUDGE = 3e-5
"""Part of a number by which it is varied: what is compared is a height, a rate, never a solve."""
FINE = 1e-7
"""The same for numbers of the motion, which may be at any phase of many cycles."""
ANY = "*"
"""The key that stands for each body, as in ``bodies.*.material.hardness``."""
HOW = ("grid", "stepping")
"""Parts of a case that say how it is computed, and have no derivative."""
NOT_PHYSICS = (*HOW, "output", "stop", "begin", "effects", "observers", "requires")
"""Parts of a case whose numbers are left out unless they are named."""


@dataclass(frozen=True)
class Variant:
    """A model with a number changed, and its weight in the derivative."""

    model: Model
    weight: float
    stops: Array
    distances: Array
    carriers: Mapping[str, Carrier]
    moves: bool


@dataclass(frozen=True)
class Chain:
    """What one number of a case changes, by differences of models that differ in it.

    Parameters
    ----------
    path : str
        Where the number stands.
    value : float
        What it is.
    unit : str
        Its unit.
    variants : sequence of Variant
        Whose weighted sum is the derivative.
    base : Model
        The model of the case itself.
    stops, distances : ndarray
        Times at which steps of it end in any case, in s, and how far it has slid by then, in m. In
        between, a variant makes its steps at the same parts of each stretch.
    """

    path: str
    value: float
    unit: str
    variants: Sequence[Variant]
    base: Model
    stops: Array
    distances: Array

    def by_load(self, record: Pressed, by_load: Array) -> float:
        """Return what comes through the loads of a contact, given the derivative in each."""
        total = 0.0
        for each in self.variants:
            loads = getattr(each.model.loads, record.load)
            times = [self._then(each, time) for time in record.times]
            total += each.weight * float(np.sum(by_load * np.array(loads(*times))))
        return total

    @property
    def moves(self) -> bool:
        """Whether it changes how bodies slide."""
        return any(each.moves for each in self.variants)

    def by_law(self, cells: Touched, speed: float, by_rate: Mapping[str, Array]) -> float:
        """Return what comes through the laws, given the derivative in the rate of each cell."""
        total = 0.0
        for each in self.variants:
            for name in each.model.laws:
                carrier = each.carriers[name]
                rate = cells.rate(each.model, name, carrier, speed, cells.pressure)
                total += each.weight * float(np.sum(by_rate[name] * rate))
        return total

    def by_motion(self, slid: Slid, cells: Touched, wear: Mapping[str, Array]) -> float:
        """Return what comes through the depths of a step, given the derivative in each."""
        total = 0.0
        for each in self.variants:
            begun, ended = (self._then(each, time) for time in (slid.time, slid.end_time))
            begin, end = (
                float(np.interp(distance, self.distances, each.distances))
                for distance in (slid.distance, slid.end_distance)
            )
            increment, model = end - begin, each.model
            shares = np.array([position.share for position in model.cycle])[cells.position]
            for name, carrier in each.carriers.items():
                if name in model.laws:
                    speed = increment / (ended - begun)
                    rate = cells.rate(model, name, carrier, speed, cells.pressure)
                    worn = np.sum(shares * cells.seen(carrier, wear[name]) * rate)
                    total += each.weight * increment * float(worn)
        return total

    def by_rest(self, gap: Array, stiffness: float, cap: float) -> float:
        """Return what comes through shapes, moduli and the hardness."""
        total = 0.0
        for each in self.variants:
            model = each.model
            through = sum(
                float(np.sum(g * shape)) for g, shape in zip(gap, model.gaps, strict=True)
            )
            through -= stiffness * np.log(softness(model) / softness(self.base))
            if model.system.cap is not None:
                through += cap * model.system.cap
            total += each.weight * through
        return total

    def _then(self, each: Variant, time: float) -> float:
        """Return the time in a variant of what happens at `time` (s) in the case."""
        return float(np.interp(time, self.stops, each.stops))


def find(
    case: Case, asked: Sequence[str] | None
) -> list[tuple[str, list[tuple[Any, ...]], float, str]]:
    """Return path, places, value and unit of the numbers that are asked for, or of all.

    Raises
    ------
    CaseError
        If a path does not lead to a number with decimals, or to several different ones, or to one
        that says how the run is computed.
    """
    known = {
        place: (value, mark.unit if mark else "1")
        for place, value, mark in leaves(case)
        if isinstance(value, float)
    }
    if asked is None:
        return [
            (".".join(map(str, place)), [place], value, unit)
            for place, (value, unit) in known.items()
            if not (place[0] in NOT_PHYSICS or _is_tolerance(place) or value == 0)
        ]
    found = []
    for path in asked:
        keys = path_keys(path.replace(ANY, "any-body"))
        keys = [ANY if key == "any-body" else key for key in keys]
        places = [place for place in known if _fits(place, keys)]
        if places == [] and keys == ["load", "normal"]:
            raise CaseError("has several stages; name one, as load.normal.0.normal", path)
        if not places:
            paths = [".".join(map(str, place)) for place in known]
            raise CaseError(
                f"is no number with decimals in this case{suggestion(did_you_mean(path, paths))}",
                path,
            )
        if any(place[0] in HOW or _is_tolerance(place) for place in places):
            raise CaseError(
                "says how the run is computed, in which there is no derivative; name numbers of "
                "bodies, load, motion, friction or contact",
                path,
            )
        values = {known[place][0] for place in places}
        if len(values) > 1:
            raise CaseError(f"stands for different numbers: {sorted(values)}", path)
        found.append((path, places, values.pop(), known[places[0]][1]))
    return found


def _is_tolerance(place: Sequence[Any]) -> bool:
    return str(place[-1]).endswith("tolerance")


def _fits(place: Sequence[Any], keys: Sequence[str]) -> bool:
    return len(place) == len(keys) and all(
        key in (ANY, str(at)) for key, at in zip(keys, place, strict=True)
    )


def chain(
    base: Model,
    path: str,
    places: Sequence[Sequence[Any]],
    value: float,
    unit: str,
    factors: Mapping[str, Array],
) -> Chain:
    """Return what a number changes, `factors` on the wear rates being the base's.

    Raises
    ------
    CaseError
        If the case has no derivative in it.
    """
    if value == 0:
        raise CaseError("is 0, of which no part can be taken as a difference", path)
    step = value * (FINE if places[0][0] == "kinematics" else NUDGE)
    errors: list[str] = []
    central, upper = [(1, 0.5), (-1, -0.5)], [(0, -1.5), (1, 2.0), (2, -0.5)]
    lower = [(-by, -weight) for by, weight in upper]
    for scheme in (central, upper, lower):
        try:
            models = [
                _varied(base, places, value + by * step, factors) if by else base
                for by, _ in scheme
            ]
        except (TriboError, ValidationError) as error:
            errors.append(str(error))
            continue
        weights = [weight / step for _, weight in scheme]
        variants = _weighed(base, models, weights)
        if scheme is central:
            _check_smooth(base, *variants)
        stops = _stops(base)
        return Chain(path, value, unit, variants, base, stops, _distances(base, stops))
    raise CaseError(f"has no derivative here: {errors[0]}", path)


def _varied(
    base: Model, places: Sequence[Sequence[Any]], number: float, factors: Mapping[str, Array]
) -> Model:
    """Return the model of a case with another number."""
    case = base.case
    for place in places:
        case = changed(case, place, number)
    model = localised(assemble(case), factors)
    _check_alike(base, model)
    if len(_stops(model)) != len(_stops(base)):
        raise CaseError("it changes how many stops the run makes")
    return model


def _weighed(base: Model, models: Sequence[Model], weights: Sequence[float]) -> list[Variant]:
    """Return models with their weights, each with all laws that differ in any of them.

    The base may be one of them; what it leaves out, the others must leave out too.
    """
    stops = [_stops(model) for model in models]
    moves = any(
        model.case.kinematics != base.case.kinematics
        or model.case.friction != base.case.friction
        or not np.array_equal(of_model, _stops(base))
        for model, of_model in zip(models, stops, strict=True)
    )
    if not moves:
        worn = {name: (body.wear, body.material) for name, body in base.case.bodies.items()}
        differ = {
            name
            for model in models
            for name, body in model.case.bodies.items()
            if (body.wear, body.material) != worn[name]
        }
        models = [
            replace(model, laws={name: law for name, law in model.laws.items() if name in differ})
            for model in models
        ]
    unmoved = carriers(base)
    return [
        Variant(
            model,
            weight,
            of_model,
            _distances(model, of_model),
            carriers(model) if moves else unmoved,
            moves,
        )
        for model, weight, of_model in zip(models, weights, stops, strict=True)
    ]


def changed(value: Any, place: Sequence[Any], number: float) -> Any:
    """Return a case, or a part of it, with the number at a place in it."""
    if not place:
        return number
    key, *rest = place
    if isinstance(value, BaseModel):
        inside = changed(getattr(value, key), rest, number)
        return type(value).model_validate({**dict(value), key: inside})
    if isinstance(value, Mapping):
        return {**value, key: changed(value[key], rest, number)}
    return tuple(changed(v, rest, number) if i == key else v for i, v in enumerate(value))


def _stops(model: Model) -> Array:
    """Return the times at which steps end whatever the tolerances, and 0, in s."""
    edges = {*model.loads.edges, *model.motion.edges()}
    within = {time for time in edges if 0 < time < model.end_time}
    return np.array(sorted({0.0, *model.saves, *within}))


def _distances(model: Model, stops: Array) -> Array:
    return np.array([model.motion.distance_at(float(time)) for time in stops])


def _check_smooth(base: Model, higher: Variant, lower: Variant) -> None:
    """Refuse a number at which the shares of the positions have a kink."""
    up, at, down = (
        np.array([position.share for position in model.cycle])
        for model in (higher.model, base, lower.model)
    )
    if np.max(np.abs(up + down - 2 * at)) > 1e-3 * np.max(np.abs(up - down)) + 1e-13:
        raise CaseError("it moves the positions of the cycle by whole cells")


def _check_alike(base: Model, model: Model) -> None:
    """Refuse a number that changes more than values."""
    ways = [(e.rows, None if e.starts is None else tuple(e.starts)) for e in _each(base)]
    others = [(e.rows, None if e.starts is None else tuple(e.starts)) for e in _each(model)]
    if ways != others or len(base.cycle) != len(model.cycle):
        raise CaseError("it moves the positions of the cycle by whole cells")
    if base.plastic_share != model.plastic_share:
        raise CaseError(
            "both bodies have the same hardness, and either may be the softer; name both, as "
            f"bodies.{ANY}.material.hardness"
        )
    ratio = _symbol(model) / _symbol(base)
    if np.ptp(ratio) > 1e-9 * float(np.max(ratio)):
        raise CaseError("it changes the shape of the displacement under a pressure")


def _each(model: Model) -> Iterator[Any]:
    yield from model.exposures.values()


def softness(model: Model) -> float:
    """Return a number to which K is proportional, in m/Pa."""
    return float(np.max(_symbol(model)))


def _symbol(model: Model) -> Array:
    cell = np.zeros(model.grid.cells, dtype=bool)
    cell[model.grid.cells[0] // 2, model.grid.cells[1] // 2] = True
    found = model.contact.operator(model.system, cell)
    assert found is not None
    return found[1].symbol()
