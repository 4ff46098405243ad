"""Joining the parts of a case: everything checked, nothing solved yet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from tribo.case import Body, Case
from tribo.config.requirements import check_requirements
from tribo.config.stepping import Implicit
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import readonly
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, located
from tribo.core.material import contact_modulus
from tribo.simulation import motion
from tribo.simulation.bodies import check_law, check_sliding, curvature, surface_height
from tribo.simulation.calling import calling
from tribo.simulation.effects import check_effects, in_order
from tribo.simulation.memory import check_memory, memory_needed
from tribo.simulation.model import Model


def assemble(case: Case) -> Model:
    """Check that the parts of a case fit together, and derive what a run needs.

    Raises
    ------
    CaseError
        If parts do not fit; the message names the place, and the remedy.
    """
    check_requirements(case.requires)
    grid, contact, bodies = case.grid, case.contact, case.bodies
    with located("kinematics"):
        exposures = motion.exposures(case.kinematics, grid, list(bodies))
    cap, share = _plastic(bodies, contact)
    # Before the first array is made.
    laws = [body.wear for body in bodies.values() if body.wear is not None]
    check_memory(grid, memory_needed(grid, laws, case.effects, plastic=cap is not None))
    gap = np.zeros(grid.cells)
    for name, body in bodies.items():
        with located(f"bodies.{name}.surface"):
            height = surface_height(name, body.surface, grid)
            check_sliding(name, body.surface, height, exposures[name])
        gap -= height
        if body.wear is not None:
            with located(f"bodies.{name}.wear"):
                check_law(name, body.wear, body.material)
    gap -= float(np.min(gap))
    system = ContactSystem(
        grid=grid,
        modulus=contact_modulus([body.material for body in bodies.values()]),
        load=case.load.normal,
        cap=cap,
        curvature=curvature({name: body.surface for name, body in bodies.items()}),
        materials={name: body.material for name, body in bodies.items()},
    )
    with located("contact"), calling(contact):
        contact.check(system)
    if isinstance(case.stepping, Implicit) and not contact.accepts_wear_compliance:
        raise CaseError(
            f"'implicit' stepping adds wear to the contact's compliance, which contact.type = "
            f"{contact.type!r} does not take; use stepping.type = 'explicit' with a "
            "time_step, or a contact type that does",
            "stepping.type",
        )
    model = Model(case, in_order(case), exposures, share, system, readonly(gap))
    motion.check_path(case.kinematics, model.end_time)
    _check_ends(model)
    check_effects(model)
    return model


def varied(case: Case, **changes: Any) -> Case:
    """Return `case` with other parts and without observers."""
    return case.model_copy(update={"observers": (), "requires": (), **changes})


def _plastic(
    bodies: Mapping[str, Body], contact: ContactSolver
) -> tuple[float | None, dict[str, float]]:
    hardness = {
        name: body.material.hardness
        for name, body in bodies.items()
        if body.material.hardness is not None
    }
    if not hardness or not contact.plasticity:
        return None, dict.fromkeys(bodies, 0.0)
    if not contact.honours_cap:
        raise CaseError(
            f"contact.type = {contact.type!r} cannot limit the pressure to a hardness; "
            "set contact.plasticity = false, or leave hardness out",
            "contact.plasticity",
        )
    cap = min(hardness.values())
    soft = [name for name, value in hardness.items() if value == cap]
    return cap, {name: (1 / len(soft) if name in soft else 0.0) for name in bodies}


def _check_ends(model: Model) -> None:
    end = model.end_time
    times = model.case.output.save_times
    if any(later <= earlier for earlier, later in pairwise(times)):
        raise CaseError(f"must increase, but are {_listed(times)} s", "output.save_times")
    if times and times[-1] > end * (1 + 1e-12):
        raise CaseError(
            f"{times[-1]:g} s is beyond the end of the run at {end:g} s; lengthen the motion or "
            "leave it out",
            "output.save_times",
        )
    stop = model.stop
    if stop.body is not None and stop.body not in model.bodies:
        raise CaseError(
            f"no body is called {stop.body!r}; the bodies are " + ", ".join(model.bodies),
            "stop.body",
        )


def _listed(times: Sequence[float]) -> str:
    return ", ".join(f"{time:g}" for time in times)
