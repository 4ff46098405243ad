"""The gradient of a run: the derivative of a number of its result in every input."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from tribo import LOAD_SHARE, LOCAL_SLIP, Array, Case, CaseError, Explicit, Simulation, State
from tribo.kernel_api import Model, assemble, did_you_mean, suggestion

from tribo_inverse.adjoint.backwards import JUST, Derivatives, swept_back
from tribo_inverse.adjoint.numbers import find
from tribo_inverse.adjoint.parameters import TURNS, Chain, Variant, at_turn, chain, of_length
from tribo_inverse.adjoint.view import Objective, Seeds, View, looked
from tribo_inverse.recording.local import localised
from tribo_inverse.recording.tape import Tape, recorded


@dataclass(frozen=True)
class Gradient:
    """The derivatives of an objective.

    Parameters
    ----------
    value : float
        The objective.
    parameters : Mapping[str, float]
        By path: the derivative in each number of the case, in its SI unit.
    relative : Mapping[str, float]
        By path: by how many per cent the objective changes for one per cent of the number; NaN if
        the objective is 0.
    wear_rate : Mapping[str, ndarray]
        By body: the derivative in a factor, 1 here, on its wear rate at each cell of its own
        surface.
    height : Mapping[str, ndarray]
        By body: in its height outward at each cell of its own surface, in 1/m.
    worn_before : Mapping[str, ndarray]
        By body: in the depth worn before the run, on its own surface, in 1/m.
    refused : Mapping[str, str]
        By path: why the objective has no derivative in this number.

    Examples
    --------
    >>> from tribo_inverse import EndTime, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> life = gradient(case, EndTime(), ["bodies.ball.surface.radius", "kinematics.frequency"])
    >>> {path: round(percent, 1) for path, percent in life.relative.items()}  # for 1 % each
    {'bodies.ball.surface.radius': 0.7, 'kinematics.frequency': -1.0}
    """

    value: float
    parameters: Mapping[str, float]
    relative: Mapping[str, float]
    wear_rate: Mapping[str, Array]
    height: Mapping[str, Array]
    worn_before: Mapping[str, Array]
    refused: Mapping[str, str]

    def __str__(self) -> str:
        """Return lines with the influence of numbers on the objective, in % for 1 %."""
        ranked = sorted(self.relative.items(), key=lambda item: -abs(item[1]))
        width = max((len(path) for path in self.relative), default=0)
        lines = [f"{path:{width}}  {percent:+.3f} % for 1 %" for path, percent in ranked]
        if self.value == 0:
            lines = ["The objective is 0, as of a body that does not wear: there are no per cent."]
        lines += [f"{path}: {reason}" for path, reason in self.refused.items()]
        return "\n".join(lines)

    def __getitem__(self, path: str) -> float:
        """Return the derivative in the number at `path`; `CaseError` if there is none."""
        if path in self.refused:
            raise CaseError(self.refused[path], path)
        if path not in self.parameters:
            like = suggestion(did_you_mean(path, self.parameters))
            raise CaseError(f"is none of the numbers of this gradient{like}", path)
        return self.parameters[path]


def gradient(
    case: Case | Mapping[str, Any] | str | Path | Model,
    objective: Objective | Mapping[float, Objective],
    wrt: Sequence[str] | None = None,
    *,
    factors: Mapping[str, Array] | None = None,
) -> Gradient:
    """Run a case; return the derivatives of a number of its result in every input.

    They are exact for the steps that the run took (the discrete adjoint): their ends stay at
    the same parts of the time between saves. One more solve a step gives all derivatives, and two
    where a depth ends the run, whose duration then depends on the inputs.

    Parameters
    ----------
    case : Case, Mapping, str, Path or Model
        As `Simulation` takes it.
    objective : callable, or Mapping of float to callable
        The number at the end of the run; or the sum of several numbers, by the saved time (s) of
        each. See `tribo_inverse.adjoint.objective`.
    wrt : sequence of str, optional
        Paths of numbers, as ``bodies.ball.wear.k``; ``*`` stands for each body. All numbers of
        bodies, load, motion, friction and contact, and ``stop.depth``, if left out.
    factors : Mapping[str, ndarray], optional
        By body: a factor on its wear rate at each cell of its own surface, of the shape of
        `View.wear`; 1 if left out.

    Returns
    -------
    Gradient
        With the maps, at no further cost.

    Raises
    ------
    CaseError
        If the case has parts without a gradient, or a path leads to no number or to a number
        without a derivative.
    NumericalError
        If the run fails.

    Examples
    --------
    >>> from tribo_inverse import Volume, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> round(gradient(case, Volume("ball"), ["stop.depth"]).relative["stop.depth"], 1)  # % for 1 %
    1.2
    """
    factors = factors or {}
    model = localised(covered(Simulation(case).model), factors)
    looks = objective if isinstance(objective, Mapping) else {model.end_time: objective}
    if not (looks and all(map(callable, looks.values()))):
        raise CaseError(
            f"{objective!r} is no objective; give a Volume, Depth, Deepest, Pressure or EndTime, "
            "or a function of a View"
        )
    chains, refused = _chains(model, wrt, factors)
    with closing(Tape(model)) as tape:
        states = recorded(model, [*looks], tape)
        turning = at_turn(model, [state.time for state in states.values()])
        if wrt is not None and (asked := [c.path for c in chains if c.path in turning]):
            raise CaseError(TURNS, asked[0])
        refused |= {each.path: TURNS for each in chains if each.path in turning}
        chains = [each for each in chains if each.path not in turning]
        seen = {time: looked(look, View(model, states[time])) for time, look in looks.items()}
        value = float(sum(of for of, _ in seen.values()))
        seeds = {time: of for time, (_, of) in seen.items()}
        end = states.get(model.end_time)
        if end is not None and end.time < model.end_time:
            for _, variant in (pair for each in chains for pair in each.variants):
                variant.until(end.time, end.time)
            found, by_depth = _at_depth(model, tape, seeds, chains, end)
        else:
            found, by_depth = swept_back(model, tape, seeds, chains), 0.0

    def direct(variant: Variant) -> float:
        change = variant.by_stop(by_depth) - value
        for time, state in states.items():
            change += looked(looks[time], View(variant.model, state))[0]
            change += variant.by_save(state.time, seeds[time])
        return change

    parameters = {
        each.path: float(through + each.sum(direct))
        for each, through in zip(chains, found.parameters, strict=True)
    }
    relative = {
        each.path: parameters[each.path] * each.value / value if value else float("nan")
        for each in chains
    }
    return Gradient(value, parameters, relative, **found.maps, refused=refused)


def covered(model: Model) -> Model:
    """Return a model without the effects on which no law and no load depends.

    Raises
    ------
    CaseError
        If a part of it has no gradient.
    """
    if loading := [each for each in model.laws.effects if each.changes_load]:
        raise CaseError(
            f"{loading[0]} makes the load depend on the state, which has no gradient; leave it out",
            "effects",
        )
    if model.contact.hardness:
        raise CaseError(
            "the largest pressure of a cell jumps where it wears into a layer of another hardness; "
            "a gradient needs one hardness: leave out the hardness of layers",
            "bodies",
        )
    middle = model.contact.gap <= np.min(model.contact.gap)
    if model.case.contact.operator(model.contact.system, middle) is None:
        raise CaseError(f"{model.case.contact.type!r} does not state its operator", "contact.type")
    laws, between = model.laws, model.laws.between.values()
    given = laws.provided | {field.name for _, field in between}
    required = {name for law in laws.wear.values() for name in law.requires}
    followed = given & {*required, LOAD_SHARE.name, LOCAL_SLIP.name}
    fills = any(field.fills for _, field in between)
    # Explicit steps follow a load along themselves only where something is remembered.
    if not laws.effects or followed or fills or isinstance(model.case.stepping, Explicit):
        return model
    return assemble(model.case.model_copy(update={"effects": ()}))


def _at_depth(
    model: Model, tape: Tape, seeds: Mapping[float, Seeds], chains: Sequence[Chain], end: State
) -> tuple[Derivatives, float]:
    """Return the derivatives of a run that ends at a depth; the second in this depth, in 1/m.

    With J the objective, and D the depth at the time t, a number p that changes the depth changes t
    by −(∂D/∂p)/(∂D/∂t), and so J by ∂J/∂p − (∂J/∂t)/(∂D/∂t) ∂D/∂p, both at the same change of t.
    """
    length, last = of_length(model, end.time), model.end_time
    at_end = {**dict.fromkeys(seeds, Seeds()), last: _deepest(model, end)}
    objective, depth = (
        swept_back(model, tape, each, [length, *chains]) for each in (seeds, at_end)
    )
    by_time = objective.parameters[0] + length.sum(lambda each: each.by_save(end.time, seeds[last]))
    by_depth = by_time / depth.parameters[0]
    found = objective.plus(-by_depth, depth)
    return replace(found, parameters=found.parameters[1:]), by_depth


def _deepest(model: Model, end: State) -> Seeds:
    """Return 1 at the cell whose depth ended the run, the first of equally deep cells."""
    worn = {name: end.bodies[name].wear for name in model.case.stop.whose(end.bodies)}
    name = max(worn, key=lambda each: float(np.max(worn[each])))
    seed = np.zeros_like(worn[name])
    seed.flat[np.argmax(worn[name] >= np.max(worn[name]) * (1 - JUST))] = 1.0
    return Seeds({name: seed})


def _chains(
    model: Model, wrt: Sequence[str] | None, factors: Mapping[str, Array]
) -> tuple[list[Chain], dict[str, str]]:
    """Return the chain of each number; and by path why a number has no derivative."""
    chains, refused = list[Chain](), dict[str, str]()
    for path, places, value in find(model.case, wrt):
        try:
            chains.append(chain(model, path, places, value, factors))
        except CaseError as error:
            if wrt is not None:
                raise
            refused[path] = str(error).removeprefix(f"{path}: ")
    return chains, refused
