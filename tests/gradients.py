"""A run repeated with the same steps, by which gradients are checked."""

from dataclasses import replace

import numpy as np

from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.stepping.step import rested, rests, start_sliding
from tribo.study.gradient.local import localised
from tribo.study.gradient.objective import View
from tribo.study.gradient.parameters import Stops, changed, find


def taken(model):
    """Times and distances at the ends of the steps that a run takes."""
    return [(a.state.time, a.state.distance) for a in march(model, begin(model))]


def repeated(model, base, steps, objective, worn=None):
    """The objective after the same steps, at the same parts of each stretch, in a model."""
    looks = objective if isinstance(objective, dict) else {base.end_time: objective}
    stops, own = Stops.of(base), Stops.of(model)
    state, total = begin(model), 0.0
    for name, depth in (worn or {}).items():
        body = replace(state.bodies[name], wear=depth)
        state = replace(state, bodies={**state.bodies, name: body})
    for time, distance in steps:
        then = float(np.interp(time, stops.times, own.times))
        if rests(model, state, then):
            state = rested(model, state, then)
        else:
            state = start_sliding(model, state)
            increment = float(np.interp(distance, stops.distances, own.distances)) - state.distance
            state = model.stepping.step(model, state, increment, then)
        if time in looks:
            total += looks[time](View(model, state))[0]
    return total


def difference(base, steps, objective, numbers, maps, part):
    """The central difference along relative changes of numbers, by path, and of maps, by kind."""
    found = []
    for by in (part, -part):
        case = base.case
        for path, change in numbers.items():
            ((_, places, value),) = find(case, [path])
            for place in places:
                case = changed(case, place, value * (1 + by * change))
        rates = {name: 1 + by * change for name, change in maps.get("wear_rate", {}).items()}
        model = localised(assemble(case), rates)
        gaps = list(model.gaps)
        for name, change in maps.get("height", {}).items():
            for position in range(len(gaps)):
                gaps[position] = gaps[position] - by * model.under(name, change, position)
        worn = {name: by * change for name, change in maps.get("worn_before", {}).items()}
        found.append(repeated(replace(model, gaps=tuple(gaps)), base, steps, objective, worn))
    return (found[0] - found[1]) / (2 * part)
