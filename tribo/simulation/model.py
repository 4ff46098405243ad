"""A case made of objects: everything checked, nothing solved yet."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from tribo.config.requirements import check_requirements
from tribo.config.stepping import ExplicitConfig, ImplicitConfig
from tribo.config.stop import StopConfig
from tribo.core.arrays import Array, readonly
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, PluginError
from tribo.core.fields import FRICTION_COEFFICIENT
from tribo.core.grid import Grid
from tribo.core.material import Material, contact_modulus
from tribo.interfaces.component import Component, ComponentConfig
from tribo.interfaces.contact import ContactSolver, ContactSolverConfig
from tribo.interfaces.effect import Effect, EffectConfig
from tribo.interfaces.exposure import Exposure
from tribo.interfaces.kinematics import Kinematics, KinematicsConfig
from tribo.interfaces.observer import Observer, ObserverConfig
from tribo.interfaces.surface import Surface, SurfaceConfig
from tribo.interfaces.wear import WearLaw, WearLawConfig
from tribo.simulation import answers, motion
from tribo.simulation.calling import calling, named
from tribo.simulation.memory import check_memory, memory_needed


@dataclass(frozen=True)
class Body:
    """One of the two bodies.

    Parameters
    ----------
    name : str
        Its name.
    surface : Surface
        Its shape before it wears.
    material : Material
        What it is made of.
    wear : WearLaw, optional
        How it wears; it does not if left out.
    """

    name: str
    surface: Surface[SurfaceConfig]
    material: Material
    wear: WearLaw[WearLawConfig] | None = None


@dataclass(frozen=True)
class Model:
    """The composed case; make one with `assemble`.

    Besides what `assemble` takes, it holds what follows from it: `exposures`
    and `plastic_share` by body name, the constants of the contact `system`,
    and the initial `gap` in m, shape (nx, ny), with minimum 0.
    """

    grid: Grid
    load: float
    bodies: tuple[Body, ...]
    contact: ContactSolver[ContactSolverConfig]
    kinematics: Kinematics[KinematicsConfig]
    stepping: ImplicitConfig | ExplicitConfig
    friction_coefficient: float | None
    effects: tuple[Effect[EffectConfig], ...]
    observers: tuple[Observer[ObserverConfig], ...]
    save_times: tuple[float, ...]
    stop: StopConfig
    requires: tuple[str, ...]
    ends_at_window: bool
    exposures: Mapping[str, Exposure]
    plastic_share: Mapping[str, float]
    system: ContactSystem
    gap: Array

    @property
    def may_reach_edge(self) -> bool:
        """Whether the contact may reach the edge of the window."""
        return self.ends_at_window or self.contact.periodic

    @property
    def end_time(self) -> float:
        """When the run ends if no depth stops it earlier, in s."""
        return motion.end_time(self.kinematics, self.stop.distance)

    def is_swept(self, name: str) -> bool:
        """Whether the body's points pass through the contact."""
        return self.exposures[name].swept

    def components(self) -> Iterator[tuple[str, Component[ComponentConfig]]]:
        """Yield every component with its place in a case."""
        for body in self.bodies:
            yield f"bodies.{body.name}.surface", body.surface
            if body.wear is not None:
                yield f"bodies.{body.name}.wear", body.wear
        yield "contact", self.contact
        yield "kinematics", self.kinematics
        for i, effect in enumerate(self.effects):
            yield f"effects[{i}]", effect
        for i, observer in enumerate(self.observers):
            yield f"observers[{i}]", observer


def assemble(
    *,
    grid: Grid,
    load: float,
    bodies: Sequence[Body],
    contact: ContactSolver[ContactSolverConfig],
    kinematics: Kinematics[KinematicsConfig],
    stepping: ImplicitConfig | ExplicitConfig | None = None,
    friction_coefficient: float | None = None,
    effects: Sequence[Effect[EffectConfig]] = (),
    observers: Sequence[Observer[ObserverConfig]] = (),
    save_times: Sequence[float] = (),
    stop: StopConfig | None = None,
    ends_at_window: bool = False,
    requires: Sequence[str] = (),
) -> Model:
    """Check that the parts fit together and join them.

    Parameters
    ----------
    grid : Grid
        The window.
    load : float
        Normal load, in N.
    bodies : sequence of Body
        The two bodies.
    contact, kinematics : ContactSolver, Kinematics
        How the contact is solved and how the bodies move.
    stepping : ImplicitConfig or ExplicitConfig, optional
        How the run moves on; implicit with default tolerances if left out.
    friction_coefficient : float, optional
        For laws and effects that ask for it.
    effects, observers : sequence, optional
        In any order; effects are sorted by what they need.
    save_times : sequence of float, optional
        In s; t = 0 and the end are always saved.
    stop : StopConfig, optional
        What ends the run early.
    ends_at_window : bool, optional
        Whether the bodies end at the window's edge, so that the contact may
        reach it.
    requires : sequence of str, optional
        Distributions that must be installed, as ``"acme-tribo>=1.2"``.

    Raises
    ------
    CaseError
        If parts do not fit; the message names the place, and the remedy.
    """
    check_requirements(requires)
    if len(bodies) != 2 or bodies[0].name == bodies[1].name:
        raise CaseError("a contact needs two bodies with different names", "bodies")
    names = [body.name for body in bodies]
    with located("kinematics"):
        exposures = motion.exposures(kinematics, grid, names)
    cap, share = _plastic(bodies, contact)
    # Before the first array is made.
    check_memory(grid, memory_needed(grid, laws_of(bodies), effects, plastic=cap is not None))
    gap = np.zeros(grid.cells)
    for body in bodies:
        with located(f"bodies.{body.name}.surface"):
            height = surface_height(body, grid)
            _check_sliding(body, height, exposures[body.name])
        gap -= height
        if body.wear is not None:
            with located(f"bodies.{body.name}.wear"):
                _check_law(body.wear, body)
    gap -= float(np.min(gap))
    system = ContactSystem(
        grid=grid,
        modulus=contact_modulus([body.material for body in bodies]),
        load=load,
        cap=cap,
        curvature=_curvature(bodies),
        materials={body.name: body.material for body in bodies},
    )
    with located("contact"), calling(contact):
        contact.check(system)
    stepping = stepping or ImplicitConfig()
    if isinstance(stepping, ImplicitConfig) and not contact.accepts_wear_compliance:
        raise CaseError(
            f"'implicit' stepping adds wear to the contact's compliance, which contact.type = "
            f"{contact.type_name()!r} does not take; use stepping.type = 'explicit' with a "
            "time_step, or a contact type that does",
            "stepping.type",
        )
    model = Model(
        grid=grid,
        load=load,
        bodies=tuple(bodies),
        contact=contact,
        kinematics=kinematics,
        stepping=stepping,
        friction_coefficient=friction_coefficient,
        effects=_in_order(effects, bodies, friction_coefficient),
        observers=tuple(observers),
        save_times=tuple(save_times),
        stop=stop or StopConfig(),
        requires=tuple(requires),
        ends_at_window=ends_at_window,
        exposures=exposures,
        plastic_share=share,
        system=system,
        gap=readonly(gap),
    )
    motion.check_path(kinematics, model.end_time)
    _check_ends(model)
    _check_effects(model)
    return model


def varied(model: Model, **changes: Any) -> Model:
    """Return `model` with other values of what `assemble` takes, and no observers.

    Raises
    ------
    CaseError
        If the parts no longer fit together.
    """
    kept = (
        "grid load bodies contact kinematics stepping friction_coefficient effects save_times stop "
        "ends_at_window"
    )
    return assemble(**{**{name: getattr(model, name) for name in kept.split()}, **changes})


@contextmanager
def located(path: str) -> Iterator[None]:
    """Give a `CaseError` raised inside its place in the case, unless it has one."""
    try:
        yield
    except CaseError as error:
        if error.path:
            raise
        raise CaseError(str(error), path) from error


def surface_height(body: Body, grid: Grid) -> Array:
    """Return the height of a body's surface before it wears, shape (nx, ny), in m."""
    with calling(body.surface, body.name):
        answer = body.surface.height(grid)
    return answers.field(named(body.surface, body.name), "a height map", answer, grid.cells)[0]


def _check_sliding(body: Body, height: Array, exposure: Exposure) -> None:
    if not exposure.shape_stays and np.any(height != height[:1]):
        raise CaseError(
            f"body {body.name!r} is swept along x, so its surface must not vary along x, as "
            f"{body.surface.type_name()!r} does; let kinematics.swept name the other body, or use "
            "a 'flat' or a 'cylinder' with axis = 'x'"
        )


def _check_law(law: WearLaw[WearLawConfig], body: Body) -> None:
    with calling(law, body.name):
        law.check(body.material)
        given = law.initial_state()
    who = named(law, body.name)
    declared = {field.name for field in law.state_fields}
    if not isinstance(given, Mapping) or set(given) != declared:
        raise PluginError(
            f"{who} declares the state fields {sorted(declared)}, but starts with {given!r:.80}"
        )
    for name, value in given.items():
        answers.number(who, f"an initial {name!r}", value)


def _curvature(bodies: Sequence[Body]) -> tuple[float, float] | None:
    known = [_curvature_of(body) for body in bodies]
    if any(c is None for c in known):
        return None
    return sum(c[0] for c in known if c), sum(c[1] for c in known if c)


def _curvature_of(body: Body) -> tuple[float, float] | None:
    with calling(body.surface, body.name):
        answer = body.surface.curvature
    if answer is None:
        return None
    who = named(body.surface, body.name)
    along, across = answers.field(who, "a curvature", answer, (2,))[0]
    return float(along), float(across)


def laws_of(bodies: Sequence[Body]) -> list[WearLaw[WearLawConfig]]:
    """Return the wear laws of those that wear."""
    return [body.wear for body in bodies if body.wear is not None]


def _plastic(
    bodies: Sequence[Body], contact: ContactSolver[ContactSolverConfig]
) -> tuple[float | None, dict[str, float]]:
    hardness = {b.name: b.material.hardness for b in bodies if b.material.hardness is not None}
    with calling(contact):
        plastic = contact.config.plasticity
    if not hardness or not plastic:
        return None, {body.name: 0.0 for body in bodies}
    if not contact.honours_cap:
        raise CaseError(
            f"contact.type = {contact.type_name()!r} cannot limit the pressure to a hardness; "
            "set contact.plasticity = false, or leave hardness out",
            "contact.plasticity",
        )
    cap = min(hardness.values())
    soft = [name for name, value in hardness.items() if value == cap]
    return cap, {b.name: (1 / len(soft) if b.name in soft else 0.0) for b in bodies}


def _in_order(
    effects: Sequence[Effect[EffectConfig]],
    bodies: Sequence[Body],
    friction_coefficient: float | None,
) -> tuple[Effect[EffectConfig], ...]:
    known = set() if friction_coefficient is None else {FRICTION_COEFFICIENT.name}
    ordered: list[Effect[EffectConfig]] = []
    waiting = list(effects)
    while waiting:
        ready = next((e for e in waiting if set(e.requires) <= known), None)
        if ready is None:
            first = waiting[0]
            missing = sorted(set(first.requires) - known)
            text = _missing(f"effect {first.type_name()!r}", missing, waiting)
            raise MissingFieldError(text, "effects", missing)
        waiting.remove(ready)
        ordered.append(ready)
        for field in ready.provides:
            if field.name in known:
                raise CaseError(
                    f"{field.name!r} is provided twice, the second time by "
                    f"{ready.type_name()!r}; keep one",
                    "effects",
                )
            known.add(field.name)
    for body in bodies:
        if body.wear is not None and not set(body.wear.requires) <= known:
            missing = sorted(set(body.wear.requires) - known)
            text = _missing(f"wear law {body.wear.type_name()!r}", missing, [])
            raise MissingFieldError(text, f"bodies.{body.name}.wear", missing)
    return tuple(ordered)


class MissingFieldError(CaseError):
    """A law or an effect needs fields that nothing provides."""

    def __init__(self, message: str, path: str, missing: Sequence[str]) -> None:
        super().__init__(message, path)
        self.missing = tuple(missing)


def _missing(who: str, missing: Sequence[str], waiting: Sequence[Effect[EffectConfig]]) -> str:
    if list(missing) == [FRICTION_COEFFICIENT.name]:
        return f"{who} needs a coefficient of friction: add [friction] coefficient = …"
    in_circle = [
        effect.type_name()
        for effect in waiting
        if any(field.name in missing for field in effect.provides)
    ]
    if in_circle:
        return (
            f"{who} needs {', '.join(missing)}, which {', '.join(in_circle)} provides, but these "
            "effects wait for one another"
        )
    return (
        f"{who} needs the field {', '.join(missing)}, which nothing in this case provides: add an "
        "effect that does ('tribo plugins list' names those installed)"
    )


def _check_ends(model: Model) -> None:
    end = model.end_time
    times = model.save_times
    if any(later <= earlier for earlier, later in pairwise(times)):
        raise CaseError(f"must increase, but are {_listed(times)} s", "output.save_times")
    if times and times[-1] > end * (1 + 1e-12):
        raise CaseError(
            f"{times[-1]:g} s is beyond the end of the run at {end:g} s; lengthen the motion or "
            "leave it out",
            "output.save_times",
        )
    stop = model.stop
    if stop.body is not None and stop.body not in {body.name for body in model.bodies}:
        raise CaseError(
            f"no body is called {stop.body!r}; the bodies are "
            + ", ".join(body.name for body in model.bodies),
            "stop.body",
        )


def _check_effects(model: Model) -> None:
    materials = {body.name: body.material for body in model.bodies}
    swept = frozenset(name for name in materials if model.is_swept(name))
    for effect in model.effects:
        with located("effects"), calling(effect):
            effect.check(materials, swept)


def _listed(times: Sequence[float]) -> str:
    return ", ".join(f"{time:g}" for time in times)
