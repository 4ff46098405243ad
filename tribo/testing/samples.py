"""Small inputs for the checks: a window, bodies, local fields, a case of a few steps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from tribo.case import Body, Case
from tribo.contact.winkler import Winkler
from tribo.core.arrays import Array
from tribo.core.fields import ContactConditions, Field, LocalConditions
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.state import State
from tribo.effects.effect import Effect
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.simulation.model import Model
from tribo.simulation.rates import Moment, law_states, wear_rates
from tribo.surfaces.cylinder import Cylinder
from tribo.surfaces.flat import Flat
from tribo.surfaces.sphere import Sphere
from tribo.testing.subject import FieldValue, Subject, require
from tribo.wear.archard import Archard

# Neither square nor of square cells, so that swapped axes are noticed.
GRID = Grid((0.72e-3, 0.8e-3), (24, 20))
BODIES = ("ball", "disk")
LOAD = 100.0
RADIUS = 5e-3
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

_TYPICAL: Mapping[str, FieldValue] = {
    "friction_coefficient": 0.3,
    "temperature": 400.0,
    "traction": lambda pressure: 0.3 * pressure,
    "traction_slope": 0.3,
}
"""What is plausible for a field whose name ends so."""

MOST_STEPS = 1000


def typical(name: str, given: Mapping[str, FieldValue], pressure: Array) -> Array:
    """Return the field `name` at `pressure`: as given, or guessed from its name."""
    guess = next((value for end, value in _TYPICAL.items() if name.endswith(end)), 1.0)
    value = given.get(name, guess)
    at_each: Array = np.zeros_like(pressure) + (value(pressure) if callable(value) else value)
    return at_each


def following(names: Sequence[str], given: Mapping[str, FieldValue]) -> dict[str, FieldValue]:
    """Return fields as `given`; one that is not, nor typical, follows its slope, if in `names`."""

    def by_slope(slope: str) -> FieldValue:
        return lambda pressure: typical(slope, given, pressure) * pressure

    guessed = {
        name: by_slope(f"{name}_slope")
        for name in names
        if f"{name}_slope" in names and not name.endswith(tuple(_TYPICAL))
    }
    return {**guessed, **given}


def friction_coefficient(given: Mapping[str, FieldValue]) -> float:
    """Return the coefficient of friction of the small cases."""
    return float(typical("friction_coefficient", given, np.zeros(())))


def pattern(shape: tuple[int, ...]) -> Array:
    """Return values between 0 and 1 without symmetry, each point its own, always the same."""
    golden = 0.6180339887498949
    values: Array = ((1 + np.arange(np.prod(shape, dtype=int))) * golden % 1.0).reshape(shape)
    return values


def sample_field(name: str, given: Mapping[str, FieldValue], pressure: Array) -> Array:
    """Return a field that varies a little about its typical value."""
    value: Array = typical(name, given, pressure) * (0.95 + 0.1 * pattern(pressure.shape))
    return value


def sample_pressure(shape: tuple[int, ...]) -> Array:
    """Return pressures up to `PEAK`, and 0 in every third point."""
    pressure: Array = PEAK * (0.02 + 0.98 * pattern(shape))
    pressure.reshape(-1)[::3] = 0.0
    return pressure


def hertz_pressure(grid: Grid) -> Array:
    """Return a half-ellipsoid of pressure in the middle of the window."""
    x, y = grid.mesh
    r2 = (x / (0.2 * grid.size[0])) ** 2 + (y / (0.25 * grid.size[1])) ** 2
    pressure: Array = PEAK * np.sqrt(np.maximum(1 - r2, 0.0))
    return pressure


class Asked(Mapping[str, Array]):
    """A mapping that remembers which names it was asked for in vain.

    Parameters
    ----------
    values : Mapping[str, ndarray]
        What it holds.
    """

    def __init__(self, values: Mapping[str, Array]) -> None:
        self._values = dict(values)
        self.missed: set[str] = set()

    def __getitem__(self, name: str) -> Array:
        if name not in self._values:
            self.missed.add(name)
        return self._values[name]

    def __contains__(self, name: object) -> bool:
        if name not in self._values:
            self.missed.add(str(name))
        return name in self._values

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)


def local_conditions(
    subject: Subject, law: Any, pressure: Array, state: Mapping[str, Array] | None = None
) -> LocalConditions:
    """Return what a law is told at points of the given pressure; state as at the start."""
    if state is None:
        state = {
            name: np.full(pressure.shape, value) for name, value in law.initial_state().items()
        }
    return LocalConditions(
        pressure=pressure,
        speed=SPEED,
        material=STEEL,
        fields={name: sample_field(name, subject.fields, pressure) for name in law.requires},
        state=state,
    )


def contact_conditions(
    subject: Subject, effect: Any, names: Sequence[str] = BODIES
) -> ContactConditions:
    """Return what an effect is told; the second body is swept."""
    pressure = hertz_pressure(GRID)
    return ContactConditions(
        grid=GRID,
        pressure=pressure,
        speed=SPEED,
        time=10.0,
        distance=1.0,
        friction_coefficient=friction_coefficient(subject.fields),
        materials=dict.fromkeys(names, STEEL),
        swept=frozenset(names[1:]),
        fields={
            name: {body: sample_field(name, subject.fields, pressure) for body in names}
            for name in effect.requires
        },
    )


def given(names: Sequence[str], values: Mapping[str, FieldValue]) -> Effect:
    """Return an effect that provides fields at sample values.

    Parameters
    ----------
    names : sequence of str
        Names of the fields.
    values : Mapping[str, float or callable]
        Typical values, where known.
    """

    class Given(Effect):
        type = "tribo.testing.given"
        provides = tuple(Field(name, "1", "A sample.") for name in names)

        def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
            return {
                name: dict.fromkeys(contact.materials, sample_field(name, values, contact.pressure))
                for name in names
            }

    return Given()


def archard() -> Archard:
    """Return a law that wears a third of the first approach within some metres."""
    return Archard(k=1e-16)


def sliding(distance: float) -> Reciprocating:
    """Return back and forth sliding of 2 mm strokes."""
    return Reciprocating(stroke=2e-3, frequency=SPEED / 4e-3, distance=distance)


def small_model(
    subject: Subject,
    *,
    law: Any = None,
    kinematics: Any = None,
    effects: Sequence[Any] = (),
    observers: Sequence[Any] = (),
    **more: Any,
) -> Model:
    """Return a case of a few steps on elastic springs, both bodies under one law."""
    law = law or archard()
    kinematics = kinematics or sliding(3.0)
    known = {"friction_coefficient"}.union(*({f.name for f in e.provides} for e in effects))
    needed = {*law.requires}.union(*(effect.requires for effect in effects)) - known
    extra = [given(sorted(needed), subject.fields)] if needed else []
    shapes = _shapes(kinematics)
    return assemble(
        Case(
            grid=GRID.model_copy(update={"ends_at_window": True}),
            load=LOAD,
            bodies={
                name: Body(surface=surface, material=STEEL, wear=law)
                for name, surface in zip(BODIES, shapes, strict=True)
            },
            contact=Winkler(plasticity=False),
            kinematics=kinematics,
            friction=friction_coefficient(subject.fields),
            effects=[*extra, *effects],
            observers=observers,
            **more,
        )
    )


def _shapes(kinematics: Any) -> list[Any]:
    """Return a surface for each body; those that pass as a whole do not vary along x."""
    exposures = kinematics.exposures(GRID, BODIES)
    passes = [not exposures[name].shape_stays for name in BODIES]
    flat = Flat()
    if all(passes):
        return [Cylinder(radius=RADIUS, axis="x"), flat]
    sphere = Sphere(radius=RADIUS)
    return [flat, sphere] if passes[0] else [sphere, flat]


def steps(model: Model) -> Iterator[tuple[State, State]]:
    """Yield the states before and after each step of a run."""
    before = begin(model)
    for number, accepted in enumerate(march(model, before)):
        require(number < MOST_STEPS, f"a small case was not done after {MOST_STEPS} steps")
        yield before, accepted.state
        before = accepted.state


def expect_volume_balance(model: Model) -> None:
    """Fail unless each step of a run removes from each body just what its law says."""
    for before, after in steps(model):
        increment = after.distance - before.distance
        moment = Moment(after.time, after.distance, increment / (after.time - before.time))
        rates = wear_rates(model, after.contact, law_states(after), moment)
        for name, rate in rates.items():
            needed = increment * float(np.sum(rate.depth_rate)) * model.grid.cell_area
            volume = model.exposures[name].volume
            found = volume(after.bodies[name].wear) - volume(before.bodies[name].wear)
            # The step's nonlinear tolerance is 1e-8 of the deepest cell. State fields lag by
            # one pass behind the pressure, which shows where wear is just beginning.
            part = 1e-2 if rate.state_rates else 1e-6
            allowed = part * needed + 1e-12 * volume(after.bodies[name].wear)
            require(
                abs(found - needed) <= allowed,
                f"from {before.distance:.4g} to {after.distance:.4g} m body {name!r} lost "
                f"{found:.6g} m³; its law says {needed:.6g} m³",
            )
