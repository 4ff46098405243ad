"""Small inputs for the checks: a window, local fields, contacts, a case of a few steps."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from tribo.case import Body, Case
from tribo.contact.dcfft import DcFft
from tribo.contact.winkler import Winkler
from tribo.contract import LIMITED
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSystem
from tribo.core.errors import CaseError
from tribo.core.fields import (
    FRICTION_COEFFICIENT,
    OF_MOTION,
    PLACE_X,
    ContactConditions,
    Field,
    names_of,
)
from tribo.core.grid import Grid
from tribo.core.material import Material, contact_modulus
from tribo.core.state import Snapshot
from tribo.effects.effect import Effect
from tribo.evolution.local_fields import effect_fields
from tribo.model.model import Model
from tribo.motion.exposure import Exposure, Stationary
from tribo.motion.kinematics import Kinematics
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.march import begin, march
from tribo.simulation.run import Simulation
from tribo.simulation.watch import Watch
from tribo.stepping.implicit import Implicit
from tribo.surfaces.forms import Cylinder, Flat, Sphere
from tribo.testing.checks import BODIES, needed_by
from tribo.testing.compare import first_difference, locked, require
from tribo.testing.process import process_state
from tribo.wear.archard import Archard

# Neither square nor of square cells, so that swapped axes are noticed.
GRID = Grid((0.72e-3, 0.8e-3), (24, 20))
RIM = (3, 5)
"""Cells on each side, along x and y, by which a window is wider; `GRID` becomes square by them."""
LOAD = 100.0
RADIUS = 5e-3
SOLVERS = (Winkler, DcFft)
STEPS = 2000
"""Of a run, at most; most take fewer than a hundred."""
LONG_STEPS = Implicit(depth_tolerance=0.01, pressure_tolerance=0.3)
"""Few of them in a run, for what a run tries is not how exact it is."""
SPEED = 0.1
SPEEDS = (SPEED, 3e-3, 2.0)
PEAK = 2e9
BARE = Material(young=207e9, poisson=0.3)
STEEL = Material(
    young=207e9,
    poisson=0.3,
    hardness=4e9,
    density=7850.0,
    conductivity=46.0,
    heat_capacity=460.0,
)
BRONZE = Material(
    young=110e9,
    poisson=0.34,
    hardness=1.5e9,
    density=8800.0,
    conductivity=60.0,
    heat_capacity=380.0,
)
KNOWN = LIMITED | OF_MOTION
"""Fields that a run itself knows, so that their name says all."""
ARCHARD = Archard(k=1e-16)
"""It wears a third of the first approach within some metres."""


def for_models(material: Material, *models: object, spread: float = 0.5) -> Material:
    """Return a material with the further properties that models need, at typical values."""
    values = {
        each.name: float(np.interp(spread, (0.0, 0.5, 1.0), _range(each)))
        for each in needed_by(*models)
        if each.name not in Material.model_fields
    }
    return material.model_copy(update={"properties": values or None})


def required(*models: Any) -> dict[str, Field]:
    """Return the declaration of each field that models require."""
    each = [of for model in models for of in model.requires]
    known = KNOWN | {of.name: of for of in each if isinstance(of, Field)}
    bare = ", ".join({*names_of(each)} - {*known})
    require(not bare, f"{bare}: a name tells no values to try; require a Field, with a typical one")
    return {name: known[name] for name in names_of(each)}


def _range(declared: Field) -> tuple[float, float, float]:
    """Return a low, a middle and a high value of a field; about 1 if it says too little."""
    least = -math.inf if declared.at_least is None else declared.at_least
    most = math.inf if declared.at_most is None else declared.at_most
    if (typical := declared.typical) is None:
        known = math.isfinite(most - least)
        return (least, 0.5 * (least + most), most) if known else (0.95, 1.0, 1.05)
    low, high = np.clip(sorted((0.5 * typical, 2 * typical)), least, most)
    return low, typical, high


def fields(declared: Mapping[str, Field], p: Array, spread: Array | float) -> dict[str, Array]:
    """Return values of fields at the pressures `p`, of which `spread` leads over their range.

    That is half to twice the typical value, or from one limit to the other. A field whose slope is
    among them follows the pressure by that.
    """
    values = {
        name: np.zeros_like(p) + np.interp(spread, (0.0, 0.5, 1.0), _range(of))
        for name, of in declared.items()
    }
    return {n: values[s] * p if (s := f"{n}_slope") in values else v for n, v in values.items()}


def pattern(shape: tuple[int, ...], number: int = 0) -> Array:
    """Return values between 0 and 1 without symmetry, each point its own, by number others."""
    golden = 0.6180339887498949
    count = 1 + 17 * number + np.arange(np.prod(shape, dtype=int))
    return (count * golden % 1.0).reshape(shape)


def sized(grid: Grid, times: float) -> Grid:
    """Return a window of as many cells, with edges so many times as long."""
    return Grid((times * grid.size[0], times * grid.size[1]), grid.cells)


def finer(grid: Grid, times: tuple[int, int] = (2, 2)) -> Grid:
    """Return a window of the same size with so many times as many cells along each axis."""
    return Grid(grid.size, (times[0] * grid.cells[0], times[1] * grid.cells[1]))


def wider(grid: Grid, way: int = 1) -> Grid:
    """Return a window that is wider by a rim of cells of the same size, or, by -1, narrower."""
    cells = (grid.cells[0] + 2 * way * RIM[0], grid.cells[1] + 2 * way * RIM[1])
    dx, dy = grid.spacing
    return Grid((cells[0] * dx, cells[1] * dy), cells)


def inside(field: Array | float, grid: Grid = GRID) -> Array:
    """Return the part in a window of a field on a window that is wider by a rim."""
    wide = np.broadcast_to(field, wider(grid).cells)
    return wide[RIM[0] : -RIM[0], RIM[1] : -RIM[1]]


def hertz_pressure(grid: Grid) -> Array:
    """Return a half-ellipsoid of pressure in the middle of the window."""
    x, y = grid.mesh
    r2 = (x / (0.2 * GRID.size[0])) ** 2 + (y / (0.25 * GRID.size[1])) ** 2
    pressure: Array = PEAK * np.sqrt(np.maximum(1 - r2, 0.0))
    return pressure


def contact_conditions(
    effect: Any, number: int = 0, names: Sequence[str] = BODIES
) -> ContactConditions:
    """Return the input of a fresh effect, by number; the second body is swept."""
    # The faster, the less pressure: the power stays what it is.
    pressure = hertz_pressure(GRID) / (1, 2, 20)[number]
    known = fields(required(effect), pressure, pattern(GRID.cells, number))
    start = effect.initial_state()
    state = {
        f.name: np.full((1, 1) if f.uniform else GRID.cells, start[f.name])
        for f in effect.state_fields
    }
    pair = for_models(STEEL, effect), for_models(BRONZE, effect, spread=0.6)
    materials = dict(zip(names, pair, strict=True))
    return ContactConditions(
        system=replace(problem(names=names).system, materials=materials),
        pressure=pressure,
        speed=SPEEDS[number],
        time=10.0 * (1 + number),
        distance=1.0 + number,
        swept=frozenset(names[1:]),
        track=(math.inf, 5e-3, 5e-2)[number],
        turns_back=number == 1,
        fields={name: {body: values.copy() for body in names} for name, values in known.items()},
        state=state,
        wear_rates={name: 1e-16 * (1 + n) * pressure for n, name in enumerate(names)},
    )


def ball(grid: Grid, cells: tuple[int, int] = (0, 0)) -> Array:
    """Return a ball with a slanted ripple, which has no symmetry, moved by some cells."""
    x, y = grid.mesh
    x, y = x - cells[0] * grid.spacing[0], y - cells[1] * grid.spacing[1]
    bowl = (x**2 + y**2) / (2 * RADIUS)
    ripple = 1e-7 * np.sin((3.1 * x + 4.7 * y) / 0.72e-3 + 0.4)
    return np.asarray(bowl + ripple)


def problem(
    hardness: float | None = None,
    grid: Grid = GRID,
    names: Sequence[str] = BODIES,
    solver: object = None,
) -> ContactProblem:
    """Return a contact problem: steel on steel, with what a solver needs of it."""
    material = for_models(STEEL, solver).model_copy(update={"hardness": hardness})
    system = ContactSystem(
        grid=grid,
        modulus=contact_modulus([material, material]),
        load=LOAD,
        cap=hardness,
        curvature=(1 / RADIUS, 1 / RADIUS),
        materials=dict.fromkeys(names, material),
    )
    return locked(ContactProblem(system, ball(grid), LOAD))


def run(parts: Callable[[], dict[str, Any]]) -> Snapshot:
    """Run a small case to its last snapshot, and once more from the middle with new objects.

    The run itself holds in each step that a body loses just what its law says. It leaves the state
    of the process as it is.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model, resumed = (_accepted(parts()) for _ in range(2))
        before = process_state()
        states = [begin(model)]
        for accepted in march(model, states[0]):
            states.append(accepted.state)
            require(len(states) <= STEPS, f"a small run is not done after {STEPS} steps")
        effect_fields(model, states[-1])
        last = Watch(model).snapshot(states[-1])
        middle = len(states) // 2
        later = zip(states[middle + 1 :], march(resumed, states[middle]), strict=True)
        for state, again in later:
            where = first_difference(state, again.state)
            lost = f"{where} differs in a run that was resumed: what no state keeps is lost then"
            require(where is None, lost)
        where = first_difference(before, process_state())
        require(where is None, f"{where} was changed in a run")
    return last


def _accepted(parts: Mapping[str, Any]) -> Model:
    """Return the model of a small case: of several contacts, the first that nothing refuses."""
    refused: list[CaseError] = []
    for motion, solver in product((sliding(3.0), _Staying(**dict(sliding(3.0)))), SOLVERS):
        common = {"kinematics": motion, "contact": solver()}
        try:
            return Simulation(small_case(**{**common, **parts})).model
        except CaseError as error:
            refused.append(error)
    raise refused[0]


def small_case(
    *,
    kinematics: Kinematics | None = None,
    law: Any = ARCHARD,
    effects: Sequence[Any] = (),
    **more: Any,
) -> Case:
    """Return a case with both bodies under one law, if both have places for it."""
    kinematics = kinematics or sliding(3.0)
    material = for_models(STEEL, law, kinematics, *effects, *more.values())
    provided = {f.name for e in effects for f in (*e.provides, *e.state_fields)}
    known = {FRICTION_COEFFICIENT.name, *OF_MOTION} | provided
    exposures = kinematics.exposures(GRID, BODIES)
    placed = PLACE_X.name in names_of(law.requires)
    wearing = [name for name in BODIES if not (placed and exposures[name].averaged)]
    # What passes as a whole does not vary along x.
    passes = [not exposures[name].shape_stays for name in BODIES]
    curved = Cylinder(radius=RADIUS, axis="x") if all(passes) else Sphere(radius=RADIUS)
    surfaces = (Flat(), curved) if passes[0] else (curved, Flat())
    lacking = {n: of for n, of in required(law, *effects).items() if n not in known}
    return Case(
        grid=GRID.model_copy(update={"ends_at_window": True}),
        load=LOAD,
        bodies={
            name: Body(surface=surface, material=material, wear=law if name in wearing else None)
            for name, surface in zip(BODIES, surfaces, strict=True)
        },
        kinematics=kinematics,
        friction=None if FRICTION_COEFFICIENT.name in provided else FRICTION_COEFFICIENT.typical,
        effects=[*([_providing(lacking)] if lacking else []), *effects],
        **{"contact": Winkler(), "stepping": LONG_STEPS, **more},
    )


def sliding(distance: float) -> Reciprocating:
    """Return back and forth sliding of 2 mm strokes."""
    return Reciprocating(
        stroke=2e-3, frequency=SPEED / 4e-3, distance=distance, positions="average"
    )


class _Staying(Reciprocating):
    """Back and forth sliding by so little that the points of both bodies stay in contact."""

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        return {name: Stationary(grid) for name in bodies}


def _providing(lacking: Mapping[str, Field]) -> Effect:
    class Given(Effect):
        type = "tribo.testing.given"
        provides = tuple(lacking.values())

        def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
            spread = 0.49 + 0.02 * pattern(contact.pressure.shape)
            answers = fields(lacking, contact.pressure, spread)
            return {name: dict.fromkeys(contact.materials, v) for name, v in answers.items()}

    return Given()
