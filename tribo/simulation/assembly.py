"""Check that the parts of a case fit together, and derive the model of a run; no solves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from tribo.case import Body, Case
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, readonly
from tribo.core.coating import Coating
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, located
from tribo.core.fields import LOCAL_SLIP, PLACE_X
from tribo.core.grid import Grid, RepeatingGrid
from tribo.core.loads import Loads
from tribo.core.material import contact_modulus
from tribo.core.rounding import ROUND_OFF
from tribo.core.words import unknown
from tribo.guards.motion import GuardedMotion
from tribo.guards.parts import GuardedEffect, GuardedLaw, GuardedSolver, GuardedSurface
from tribo.model.contact_setup import ContactSetup
from tribo.model.cycle import Cycle
from tribo.model.laws import Laws
from tribo.model.layered_law import LayeredLaw
from tribo.model.model import Model
from tribo.motion.closed_track import Unidirectional
from tribo.motion.exposure import Exposure
from tribo.simulation.effects import in_order
from tribo.simulation.hardness import yielding
from tribo.simulation.memory import check_memory, memory_needed

SAME_RADIUS = 1e-2
"""Relative difference up to which a ring has the radius of its track."""


def assemble(case: Case) -> Model:
    """Check that the parts of a case fit together, guard them, and derive the model of a run."""
    grid, bodies = case.grid, case.bodies
    motion, solver = GuardedMotion(case.kinematics), GuardedSolver(case.contact)
    with located("kinematics"):
        window = grid
        if case.contact.periodic:
            window = RepeatingGrid(size=grid.size, cells=grid.cells)
        positions = motion.cycle(window)
        exposures = motion.exposures(window, list(bodies), len(positions))
        cycle = Cycle(grid, positions, exposures)
    cap, share, hardness = yielding(bodies, case.contact)
    # Before the first array is made.
    check_memory(grid, memory_needed(case, len(cycle)))
    surfaces, laws = {}, {}
    for name, body in bodies.items():
        exposure = exposures[name]
        with located(f"bodies.{name}.surface"):
            surfaces[name] = GuardedSurface(body.surface, name, exposure.own_grid(grid))
            _check_sliding(surfaces[name], exposure)
            turns = isinstance(case.kinematics, Unidirectional) and case.kinematics.turns
            if turns and exposure.swept:
                _check_ring(surfaces[name], exposure.track(grid), grid)
        if body.wear is not None:
            laws[name] = _law(body, name, grid, exposure)
    loads = Loads(case.load.points)
    known = [each.curvature for each in surfaces.values() if each.curvature is not None]
    system = ContactSystem(
        grid=grid,
        modulus=contact_modulus([body.material for body in bodies.values()]),
        load=loads.after(0.0),
        cap=cap,
        # Along x and y; none if a surface states none.
        curvature=(sum(c[0] for c in known), sum(c[1] for c in known))
        if len(known) == len(surfaces)
        else None,
        materials={name: body.material for name, body in bodies.items()},
        coatings=_coatings(bodies, case.contact),
    )
    with located("contact"):
        solver.ask(case.contact.check, replace(system, load=loads.largest))
    if case.stepping.needs_wear_compliance and not case.contact.accepts_wear_compliance:
        raise CaseError(
            f"'implicit' stepping adds wear to the contact's compliance, which contact.type = "
            f"{case.contact.type!r} does not take; use stepping.type = 'explicit' with a "
            "time_step, or a contact type that does",
            "stepping.type",
        )
    given = (*motion.effects(), *case.effects)
    effects = in_order(case, [GuardedEffect(effect, list(bodies)) for effect in given])
    friction = None if case.friction is None else case.friction.coefficient
    with located("stop.distance"):
        end = motion.end_time(case.stop.distance)
    motion.check_distance(end)
    model = Model(
        case=case,
        motion=motion,
        surfaces=surfaces,
        cycle=cycle,
        contact=ContactSetup(solver, system, loads, _gaps(cycle, surfaces), share, hardness),
        laws=Laws(laws, effects, friction),
        end_time=end,
    )
    _check_ends(model)
    _check_steady_cycle(model)
    for effect in effects:
        with located("effects"):
            effect.ask(effect.component.check, system, model.cycle.swept, case.contact.type)
    return model


def varied(case: Case, **changes: Any) -> Case:
    """Return `case` with other parts and without observers."""
    return case.model_copy(update={"observers": (), **changes})


def _law(body: Body, name: str, grid: Grid, exposure: Exposure) -> GuardedLaw:
    """Return the law of a body that wears, or the laws of its layers."""
    laws = []
    own = [f"layers.{i}.wear" if each.wear else "wear" for i, each in enumerate(body.layers, 1)]
    places = (*own, "wear")
    for law, material, place in zip(body.laws(), body.materials(), places, strict=True):
        with located(f"bodies.{name}.{place}"):
            laws.append(GuardedLaw(law, name, material))
            laws[-1].ask(law.check_cells, grid.spacing)
            if PLACE_X.name in laws[-1].requires and exposure.averaged:
                raise CaseError(
                    f"{law.type!r} wears places of their own, but the average over a track has "
                    f"none on body {name!r}; resolve the cycle (kinematics.positions), or give "
                    "this law to the body that stays in the contact"
                )
    if not body.layers:
        return laws[0]
    with located(f"bodies.{name}.layers"):
        return LayeredLaw(laws, [layer.thickness for layer in body.layers])


def _coatings(bodies: Mapping[str, Body], contact: ContactSolver) -> dict[str, Coating]:
    """Return the elastic layer on each body that has one, by name."""
    coatings = {}
    for name, body in bodies.items():
        *materials, base = body.materials()
        place = f"bodies.{name}.layers"
        elastic = [(each.young, each.poisson) for each in materials]
        while elastic and elastic[-1] == (base.young, base.poisson):
            elastic.pop()
        if not elastic:
            continue
        if len(set(elastic)) > 1:
            raise CaseError(
                "layers may differ from the body in young and poisson, but not from one another: "
                "one elastic layer on each body; give them the same",
                place,
            )
        if not contact.takes_coatings:
            raise CaseError(
                f"contact.type = {contact.type!r} takes no elastic layers; leave young and poisson "
                "out, or take 'dcfft' or 'periodic'",
                place,
            )
        thickness = sum(layer.thickness for layer in body.layers[: len(elastic)])
        coatings[name] = Coating(thickness, materials[0], base)
    return coatings


def _gaps(cycle: Cycle, surfaces: Mapping[str, GuardedSurface]) -> tuple[Array, ...]:
    """Return the initial gap at each position, 0 at the least in the middle of the cycle."""

    def gap_at(position: int) -> Array:
        gap = np.zeros(cycle.grid.cells)
        for name, surface in surfaces.items():
            gap -= cycle.maps[name].see(surface.height, position)
        return gap

    lowest = float(np.min(gap_at(cycle.middle)))
    if not any(_varies(surfaces[name].height, cycle.maps[name]) for name in cycle.swept):
        return (readonly(gap_at(cycle.middle) - lowest),) * len(cycle)
    return tuple(readonly(gap_at(position) - lowest) for position in range(len(cycle)))


def _check_sliding(surface: GuardedSurface, exposure: Exposure) -> None:
    """Raise `CaseError` if the motion changes the shape of a moving body in the window."""
    if not exposure.shape_stays and _varies_along_x(surface.height):
        raise CaseError(
            f"body {surface.body!r} is swept along x, so its surface must not vary along x, as "
            f"{surface.component.type!r} does; resolve the cycle (kinematics.positions, for "
            "'unidirectional' where the contact is periodic), let kinematics.swept name the other "
            "body, use a 'flat' or a 'cylinder' with axis = 'x', or, for a ring on a block, "
            "'unidirectional' with turns = true"
        )


def _check_ring(surface: GuardedSurface, lap: float, grid: Grid) -> None:
    """Raise `CaseError` if a body that turns is not round, or not of its track's radius."""
    form, radius = surface.ask(surface.component.smoothed), lap / (2 * np.pi)
    relief = surface.height - form.height(grid)
    passing = np.max(np.ptp(relief, axis=0)) > ROUND_OFF * np.ptp(surface.height)
    curvature = (form.curvature or (0.0, 0.0))[0]
    if passing or abs(radius * curvature - 1) > SAME_RADIUS:
        raise CaseError(
            f"body {surface.body!r} turns about an axis along y (kinematics.turns = true), so its "
            "surface must be round and smooth about that, with the radius of its track, "
            f"{1e3 * radius:.4g} mm; give such a 'cylinder' or 'sphere', or leave turns out"
        )


def _varies_along_x(height: Array) -> bool:
    return bool(np.any(height != height[:1]))


def _varies(height: Array, exposure: Exposure) -> bool:
    """Whether the height of a moving body differs between positions."""
    breadth = exposure.across is not None and np.any(height != height[:, :1])
    return bool(breadth or _varies_along_x(height))


def _check_steady_cycle(model: Model) -> None:
    """Refuse stages of the load within a cycle whose slip of points an effect states."""
    if LOCAL_SLIP.name not in model.laws.provided:
        return
    loads, cycle = model.contact.loads, 2 * model.case.kinematics.track_extent
    ends = [0.0, *(edge for edge in loads.edges if edge < model.end_time)]
    slid = np.diff([model.motion.distance_at(end) for end in ends])
    if np.any((slid > 0) & (slid < cycle * (1 - ROUND_OFF))):
        change = 100 * (1 - loads.least / loads.largest)
        raise CaseError(
            f"a stage is shorter than a cycle of {cycle:.3g} m, in which partial slip takes the "
            f"load as steady; it changes by {change:.3g} %, the wear by up to 1.7 times that",
            "load.normal",
        )


def _check_ends(model: Model) -> None:
    end, last = model.end_time, model.contact.loads.end
    if last < end * (1 - 1e-12):
        raise CaseError(
            f"the load ends at {last:g} s, before the run does at {end:g} s; give it up to then, "
            "or shorten the motion",
            "load.normal",
        )
    with located("output.save_times"):
        times = model.save_times
    if any(later <= earlier for earlier, later in pairwise(times)):
        listed = ", ".join(f"{time:g}" for time in times)
        raise CaseError(f"must increase, but are {listed} s", "output.save_times")
    if times and times[-1] > end * (1 + 1e-12):
        written = model.case.output.save_times[-1]
        moment = written if isinstance(written, str) else f"{written:g} s"
        raise CaseError(
            f"{moment} is beyond the end of the run at {end:g} s; lengthen the motion or leave it "
            "out",
            "output.save_times",
        )
    stop = model.case.stop
    if stop.body is not None and stop.body not in model.case.bodies:
        raise CaseError(unknown("body", stop.body, model.case.bodies), "stop.body")
