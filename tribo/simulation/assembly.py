"""Joining the parts of a case: everything checked, nothing solved yet."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from tribo.config.requirements import check_requirements
from tribo.config.stepping import ExplicitConfig, ImplicitConfig
from tribo.config.stop import StopConfig
from tribo.core.arrays import readonly
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, located
from tribo.core.grid import Grid
from tribo.core.material import contact_modulus
from tribo.interfaces.contact import ContactSolver
from tribo.interfaces.effect import Effect
from tribo.interfaces.kinematics import Kinematics
from tribo.interfaces.observer import Observer
from tribo.simulation import motion
from tribo.simulation.bodies import check_law, check_sliding, curvature, laws_of, surface_height
from tribo.simulation.calling import calling
from tribo.simulation.effects import check_effects, in_order
from tribo.simulation.memory import check_memory, memory_needed
from tribo.simulation.model import Body, Model


def assemble(
    *,
    grid: Grid,
    load: float,
    bodies: Sequence[Body],
    contact: ContactSolver,
    kinematics: Kinematics,
    stepping: ImplicitConfig | ExplicitConfig | None = None,
    friction_coefficient: float | None = None,
    effects: Sequence[Effect] = (),
    observers: Sequence[Observer] = (),
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
            check_sliding(body, height, exposures[body.name])
        gap -= height
        if body.wear is not None:
            with located(f"bodies.{body.name}.wear"):
                check_law(body.wear, body)
    gap -= float(np.min(gap))
    system = ContactSystem(
        grid=grid,
        modulus=contact_modulus([body.material for body in bodies]),
        load=load,
        cap=cap,
        curvature=curvature(bodies),
        materials={body.name: body.material for body in bodies},
    )
    with located("contact"), calling(contact):
        contact.check(system)
    stepping = stepping or ImplicitConfig()
    if isinstance(stepping, ImplicitConfig) and not contact.accepts_wear_compliance:
        raise CaseError(
            f"'implicit' stepping adds wear to the contact's compliance, which contact.type = "
            f"{contact.type!r} does not take; use stepping.type = 'explicit' with a "
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
        effects=in_order(effects, bodies, friction_coefficient),
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
    check_effects(model)
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


def _plastic(
    bodies: Sequence[Body], contact: ContactSolver
) -> tuple[float | None, dict[str, float]]:
    hardness = {b.name: b.material.hardness for b in bodies if b.material.hardness is not None}
    with calling(contact):
        plastic = contact.plasticity
    if not hardness or not plastic:
        return None, {body.name: 0.0 for body in bodies}
    if not contact.honours_cap:
        raise CaseError(
            f"contact.type = {contact.type!r} cannot limit the pressure to a hardness; "
            "set contact.plasticity = false, or leave hardness out",
            "contact.plasticity",
        )
    cap = min(hardness.values())
    soft = [name for name, value in hardness.items() if value == cap]
    return cap, {b.name: (1 / len(soft) if b.name in soft else 0.0) for b in bodies}


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


def _listed(times: Sequence[float]) -> str:
    return ", ".join(f"{time:g}" for time in times)
