"""Runs repeated with the same steps, by which gradients are checked."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from paper_models import archard, case, half_space, motion, pair
from tribo import Simulation
from tribo.case import Case, Layer
from tribo.core.grid import Grid
from tribo.simulation.assembly import assemble
from tribo.simulation.march import march
from tribo.stepping.first_contact import first_contact
from tribo.stepping.implicit import Implicit
from tribo.stepping.step import distance_until, rested, start_sliding
from tribo.wear.running_in import RunningIn, Smoothing

from tribo_inverse.adjoint.gradient import covered, gradient
from tribo_inverse.adjoint.numbers import changed, find
from tribo_inverse.adjoint.parameters import Stops
from tribo_inverse.adjoint.view import Seeds, View
from tribo_inverse.recording.local import localised


def repeated(model, base, steps, worn, until=None):
    """The states after the same steps, at the same parts of each stretch, in a model.

    Of a run that a depth ends the last stretch goes on `until` a time (s).
    """
    stops, own = Stops.of(base), Stops.of(model)
    if until:
        before = stops.times < steps[-1][0]
        stops = Stops.at(base, [*stops.times[before], steps[-1][0]])
        own = Stops.at(model, [*own.times[before], until])
    state = first_contact(model)
    if worn:
        bodies = {name: replace(state.bodies[name], wear=depth) for name, depth in worn.items()}
        state = first_contact(model, {**state.bodies, **bodies})
    found = []
    for time, distance in steps:
        then = float(np.interp(time, stops.times, own.times))
        if distance_until(model, state, then) is None:
            state = rested(model, state, then)
        else:
            state = start_sliding(model, state)
            increment = float(np.interp(distance, stops.distances, own.distances)) - state.distance
            state = model.case.stepping.step(model, state, increment, then)
        found.append(state)
    return found


def deepest(model, state):
    """The depth that may end a run."""
    name = model.case.stop.body
    bodies = [state.bodies[name]] if name else state.bodies.values()
    return max(np.max(body.wear) for body in bodies)


def end_distance(view):
    """The distance slid."""
    return view.state.distance, Seeds(distance=1.0)


def looks_of(objective, model):
    """Objectives by the time that they look at."""
    return objective if isinstance(objective, dict) else {model.end_time: objective}


def sought(model, base, steps, objective, worn, depth, by):
    """The objective after the same steps; of a run that a depth ends, up to this depth.

    Of that depth it is on the line through the runs that end a part `by` sooner and later, whose
    error, the same to both sides, a central difference has not.
    """
    looks = looks_of(objective, base)
    times = [*(time for time, _ in steps[:-1]), base.end_time]

    def after(until=None):
        states = repeated(model, base, steps, worn, until)
        pairs = [(time, state) for time, state in zip(times, states, strict=True) if time in looks]
        seen = sum(looks[time](View(model, state))[0] for time, state in pairs)
        return seen, deepest(model, states[-1]) if until else None

    if not depth:
        return after()[0]
    (sooner, less), (later, more) = (after(steps[-1][0] * part) for part in (1 - by, 1 + by))
    return sooner + (later - sooner) * (depth - less) / (more - less)


def difference(base, steps, objective, numbers, maps, part, depth=None):
    """The central difference along relative changes of numbers, by path, and of maps, by kind."""
    found = []
    for by in (part, -part):
        case = base.case
        for path, change in numbers.items():
            ((_, places, value),) = find(case, [path])
            case = changed(case, path, places, value * (1 + by * change))
        rates = {name: 1 + by * change for name, change in maps.get("wear_rate", {}).items()}
        model = localised(assemble(case), rates)
        gaps = list(model.contact.gaps)
        for name, change in maps.get("height", {}).items():
            for position in range(len(gaps)):
                gaps[position] = gaps[position] - by * model.cycle.maps[name].see(change, position)
        worn = {name: by * change for name, change in maps.get("worn_before", {}).items()}
        made = replace(model, contact=replace(model.contact, gaps=tuple(gaps)))
        ends = depth and depth + made.case.stop.depth - base.case.stop.depth
        found.append(sought(made, base, steps, objective, worn, ends, part))
    return (found[0] - found[1]) / (2 * part)


@dataclass(frozen=True)
class Kind:
    """A kind of run: what is differentiated, in which numbers, and the part they are varied by."""

    case: Case
    objective: object
    paths: list
    part: float
    seed: int = 0

    def off(self):
        """By how much the gradient misses the difference along random changes, relative to it."""
        states, random = [], np.random.default_rng(self.seed)

        def noted(*given):
            for accepted in march(*given):
                states.append(accepted.state)
                yield accepted

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("tribo_inverse.recording.tape.march", noted)
            found = gradient(self.case, self.objective, self.paths)
        model = covered(Simulation(self.case).model)
        numbers = {path: random.uniform(0.5, 1.5) for path in self.paths}
        own = {name: (each.rows, model.grid.cells[1]) for name, each in model.cycle.maps.items()}
        sizes = {"wear_rate": 1.0, "height": 1e-8}
        if model.contact.system.cap is None:
            # What a run begins with would yield anew.
            sizes["worn_before"] = 1e-8
        maps = {
            which: {
                name: size * random.uniform(0.5, 1.5, shape)
                for name, shape in own.items()
                if name in model.laws.wear or which != "wear_rate"
            }
            for which, size in sizes.items()
        }
        steps = [(state.time, state.distance) for state in states]
        ended = steps[-1][0] < model.end_time
        depth = deepest(model, states[-1]) if ended else None
        direct = difference(model, steps, self.objective, numbers, maps, self.part, depth)
        follows = sum(by * found.relative[path] * found.value for path, by in numbers.items())
        for which, of_bodies in maps.items():
            for name, change in of_bodies.items():
                follows += float(np.sum(getattr(found, which)[name] * change))
        return abs(follows - direct) / abs(direct)


CLOSE = 1e-6
"""As near as differences of runs come, whose contacts are solved to 1e-12."""
WINDOW = Grid(("0.5 mm", "0.5 mm"), (10, 10))
FINE = Grid(("0.5 mm", "0.5 mm"), (16, 16))
SMALL = Grid(("0.45 mm", "0.5 mm"), (5, 6))
"""With contacts of six cells, of three pressures, where each cell costs breaks of its own."""
ODD = Grid(("0.45 mm", "0.5 mm"), (9, 10))
"""With one deepest cell in each row, where two would have a derivative to each side."""
MIDDLE = Grid(("0.45 mm", "0.45 mm"), (9, 9))
"""With one deepest cell."""
TIGHT = half_space(tolerance=1e-12)
BASE = ["load.normal", "bodies.ball.wear.k", "bodies.disk.wear.k", "kinematics.frequency"]
SHAPE = ["bodies.ball.surface.radius", "bodies.ball.material.young", "bodies.disk.material.poisson"]


def few(**values):
    """Steps so long that a run has a handful of them."""
    return Implicit(
        **{"depth_tolerance": 0.1, "pressure_tolerance": 0.5, "settle": 1, "max_passes": 500}
        | values
    )


def layered(ball=None, disk=None, of_ball=None, of_disk=None):
    """Bodies, each in a layer of this thickness and law, and with the law of what is below."""
    bodies = []
    plain = pair(of_ball or archard(), of_disk or archard())
    for (name, body), top in zip(plain, (ball, disk), strict=True):
        layers = (Layer(thickness=top[0], wear=top[1]),) if top else ()
        bodies.append((name, body.model_copy(update={"layers": layers})))
    return bodies


def run(**changes):
    parts = {"grid": WINDOW, "load": 20.0, "contact": TIGHT, "stepping": few()}
    return case(**{**parts, "kinematics": motion(duration=20), **changes})


def kind(objective, paths, part=1e-5, seed=0, **changes):
    """A kind of run with these changes."""
    return Kind(run(**changes), objective, paths, part, seed)


def resolved(**changes):
    return motion(
        **{"stroke": "0.125 mm", "positions": 5, "frequency": 100, "duration": 20} | changes
    )


STAGES = ["load.normal.1.normal", "load.normal.2.normal", "load.normal.3.normal"]
HARD = "bodies.disk.material.hardness"
RAMP = [
    {"at": 0, "normal": 10.0},
    {"at": 5, "normal": 20.0},
    {"until": 7, "normal": 40.0},
    {"until": 11, "normal": 20.0},
]
FRESH = RunningIn(law=archard(), factor=4.0, over="1 GPa m")
SMOOTH = Smoothing(law=archard(), factor=3.0, roughness="0.4 um", settled="0.1 um", depth="0.2 um")
OF_FRESH = ["bodies.ball.wear.over", "bodies.ball.wear.factor", "bodies.ball.wear.law.k"]
OF_SMOOTH = ["bodies.disk.wear.roughness", "bodies.disk.wear.depth", "bodies.disk.wear.law.k"]
LONG = few(nonlinear_tolerance=1e-13, cycle_tolerance=1e-12)
