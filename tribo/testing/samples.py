"""Small inputs for the checks: a window, local fields, contacts, a case of a few steps."""

from __future__ import annotations

import warnings
from collections import UserDict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribo.case import Body, Case
from tribo.contact.winkler import Winkler
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSystem, WearCompliance
from tribo.core.fields import FRICTION_COEFFICIENT, PLACE_X, PLACE_Y, ContactConditions, Field
from tribo.core.grid import Grid
from tribo.core.material import Material, contact_modulus
from tribo.core.state import Snapshot
from tribo.effects.effect import Effect
from tribo.motion.reciprocating import Reciprocating
from tribo.observers.observer import Observer
from tribo.simulation.run import Simulation
from tribo.surfaces.cylinder import Cylinder
from tribo.surfaces.flat import Flat
from tribo.surfaces.sphere import Sphere
from tribo.testing.checks import FieldValue
from tribo.testing.compare import locked, require
from tribo.wear.archard import Archard

# Neither square nor of square cells, so that swapped axes are noticed.
GRID = Grid((0.72e-3, 0.8e-3), (24, 20))
BODIES = ("ball", "disk")
LOAD = 100.0
RADIUS = 5e-3
STEPS = 2000
"""Of a run, at most; most take fewer than a hundred."""
SPEED = 0.1
PEAK = 2e9
STEEL = Material(
    young=207e9,
    poisson=0.3,
    hardness=4e9,
    density=7850.0,
    conductivity=46.0,
    heat_capacity=460.0,
)
ARCHARD = Archard(k=1e-16)
"""It wears a third of the first approach within some metres."""


def field(name: str, names: Sequence[str], given: Mapping[str, FieldValue], p: Array) -> Array:
    """Return a typical value of the field `name` at the pressures `p`.

    As `given`, else as declared by an effect that was imported. One of which
    nothing is known follows its slope if that is among `names` too, and is 1
    if not.
    """
    value = given.get(name, _declared(name))
    if value is None:
        slope = f"{name}_slope"
        return field(slope, (), given, p) * p if slope in names else np.ones_like(p)
    return np.zeros_like(p) + (value(p) if callable(value) else value)


def _declared(name: str) -> float | None:
    """Return the typical value of a field that the case or a loaded effect provides, if stated."""
    known = [FRICTION_COEFFICIENT, PLACE_X, PLACE_Y]
    effects = Effect.__subclasses__()
    for effect in effects:
        effects += effect.__subclasses__()
        known += getattr(effect, "provides", ())
    return next((f.typical for f in known if f.name == name and f.typical is not None), None)


def fields(names: Sequence[str], given: Mapping[str, FieldValue], p: Array) -> dict[str, Array]:
    """Return fields that vary a little about their typical values."""
    return {name: field(name, names, given, p) * (0.95 + 0.1 * pattern(p.shape)) for name in names}


def pattern(shape: tuple[int, ...]) -> Array:
    """Return values between 0 and 1 without symmetry, each point its own, always the same."""
    golden = 0.6180339887498949
    values: Array = ((1 + np.arange(np.prod(shape, dtype=int))) * golden % 1.0).reshape(shape)
    return values


def hertz_pressure(grid: Grid) -> Array:
    """Return a half-ellipsoid of pressure in the middle of the window."""
    x, y = grid.mesh
    r2 = (x / (0.2 * grid.size[0])) ** 2 + (y / (0.25 * grid.size[1])) ** 2
    pressure: Array = PEAK * np.sqrt(np.maximum(1 - r2, 0.0))
    return pressure


class Asked(UserDict[str, Any]):
    """A mapping that remembers which names it was asked for in vain.

    Parameters
    ----------
    values : Mapping[str, object]
        What it holds.
    """

    def __init__(self, values: Mapping[str, Any]) -> None:
        super().__init__(values)
        self.missed: set[object] = set()

    def __missing__(self, name: str) -> Any:
        self.missed.add(name)
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        if name not in self.data:
            self.missed.add(name)
        return name in self.data


def contact_conditions(
    effect: Any, given: Mapping[str, FieldValue], names: Sequence[str] = BODIES
) -> ContactConditions:
    """Return what an effect is told; the second body is swept."""
    pressure = hertz_pressure(GRID)
    known = fields(effect.requires, given, pressure)
    state = {
        f.name: np.full((1, 1) if f.uniform else GRID.cells, effect.initial_state()[f.name])
        for f in effect.state_fields
    }
    return ContactConditions(
        grid=GRID,
        pressure=pressure,
        speed=SPEED,
        time=10.0,
        distance=1.0,
        materials=dict.fromkeys(names, STEEL),
        swept=frozenset(names[1:]),
        fields={name: {body: values.copy() for body in names} for name, values in known.items()},
        state=state,
        wear_rates=dict.fromkeys(names, 1e-16 * pressure),
    )


def ball(grid: Grid, scale: float = 1.0, cells: tuple[int, int] = (0, 0)) -> Array:
    """Return a ball with a slanted ripple, which has no symmetry, moved by some cells."""
    x, y = grid.mesh
    x, y = x - cells[0] * grid.spacing[0], y - cells[1] * grid.spacing[1]
    bowl = (x**2 + y**2) / (2 * scale * RADIUS)
    ripple = 1e-7 * scale * np.sin((3.1 * x + 4.7 * y) / (0.72e-3 * scale) + 0.4)
    return np.asarray(bowl + ripple)


def problem(
    *,
    gap: Array | None = None,
    load: float = LOAD,
    cap: float | None = None,
    wear: WearCompliance | None = None,
    scale: float = 1.0,
    stiffer: float = 1.0,
) -> ContactProblem:
    """Return a contact problem with lengths times `scale` and moduli times `stiffer`."""
    grid = Grid((scale * GRID.size[0], scale * GRID.size[1]), GRID.cells)
    force = scale**2 * stiffer
    material = STEEL.model_copy(update={"young": stiffer * STEEL.young, "hardness": cap})
    # The system states the first contact's load, whatever the problem's own is.
    system = ContactSystem(
        grid=grid,
        modulus=contact_modulus([material, material]),
        load=force * LOAD,
        cap=cap,
        curvature=(1 / (scale * RADIUS), 1 / (scale * RADIUS)),
        materials=dict.fromkeys(BODIES, material),
    )
    gap = ball(grid, scale) if gap is None else gap
    return locked(ContactProblem(system, gap, force * load, wear))


def run(
    given: Mapping[str, FieldValue],
    *,
    law: Any = ARCHARD,
    kinematics: Any = None,
    effects: Sequence[Any] = (),
    observers: Sequence[Observer] = (),
    watcher: Observer | None = None,
    **more: Any,
) -> None:
    """Run a few steps on elastic springs, both bodies under one law, if both have places for it.

    The run itself holds in each step that a body loses just what its law says.
    """
    kinematics = kinematics or sliding(3.0)
    provided = {f.name for e in effects for f in (*e.provides, *e.state_fields)}
    known = {FRICTION_COEFFICIENT.name, PLACE_X.name, PLACE_Y.name} | provided
    averaged = {n for n, e in kinematics.exposures(GRID, BODIES).items() if e.averaged}
    wearing = {*BODIES} - (averaged if PLACE_X.name in law.requires else set())
    needed = sorted({*law.requires}.union(*(e.requires for e in effects)) - known)
    case = Case(
        grid=GRID.model_copy(update={"ends_at_window": True}),
        load=LOAD,
        bodies={
            name: Body(surface=surface, material=STEEL, wear=law if name in wearing else None)
            for name, surface in zip(BODIES, _shapes(kinematics), strict=True)
        },
        contact=Winkler(),
        kinematics=kinematics,
        friction=None if FRICTION_COEFFICIENT.name in provided else _friction(given),
        effects=[*([_providing(needed, given)] if needed else []), *effects],
        observers=observers,
        **more,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        Simulation(case).run(observers=[_Limit(), *([watcher] if watcher else [])]).close()


class _Limit(Observer):
    """Ends a run that does not come to its end by itself."""

    type = "tribo.testing.limit"

    def on_step(self, snapshot: Snapshot) -> None:
        require(snapshot.state.steps <= STEPS, f"a small run is not done after {STEPS} steps")


def sliding(distance: float) -> Reciprocating:
    """Return back and forth sliding of 2 mm strokes."""
    return Reciprocating(
        stroke=2e-3, frequency=SPEED / 4e-3, distance=distance, positions="average"
    )


def _friction(given: Mapping[str, FieldValue]) -> float:
    return float(field("friction_coefficient", (), given, np.zeros(())))


def _providing(names: Sequence[str], given: Mapping[str, FieldValue]) -> Effect:
    class Given(Effect):
        type = "tribo.testing.given"
        provides = tuple(Field(name, "1", "A sample.") for name in names)

        def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
            answers = fields(names, given, contact.pressure)
            return {name: dict.fromkeys(contact.materials, v) for name, v in answers.items()}

    return Given()


def _shapes(kinematics: Any) -> list[Any]:
    """Return a surface for each body; those that pass as a whole do not vary along x."""
    exposures = kinematics.exposures(GRID, BODIES)
    passes = [not exposures[name].shape_stays for name in BODIES]
    if all(passes):
        return [Cylinder(radius=RADIUS, axis="x"), Flat()]
    sphere = Sphere(radius=RADIUS)
    return [Flat(), sphere] if passes[0] else [sphere, Flat()]
