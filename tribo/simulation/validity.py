"""Where a case leaves the range in which its models hold."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from tribo.case import Case
from tribo.component import components
from tribo.config.overrides import leaves
from tribo.core import findings
from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.errors import CaseError, NumericalError, PluginError, TooWorn, located
from tribo.core.explain import path
from tribo.core.findings import Finding
from tribo.core.measures import half_widths
from tribo.core.rounding import ROUND_OFF
from tribo.core.state import State
from tribo.model.model import Model
from tribo.motion.stroke import least_positions
from tribo.registry.hookspecs import hookimpl
from tribo.registry.registry import from_packages

SEAM = 4
"""How many times more a surface bends at the edge of a window than inside if it ends there."""


def unusual(case: Case) -> list[Finding]:
    """Return a finding for each quantity of a case that is out of its usual range."""
    found: dict[str, Finding] = {}
    for place, value, mark in leaves(case):
        if not (mark and mark.usual and isinstance(value, float)):
            continue
        if doubt := mark.doubt(value):
            while isinstance(place[-1], int):
                # A pair may be written as one value.
                place = place[:-1]
            limit = min(mark.usual, key=lambda end: abs(end - value))
            found[path(place)] = findings.unusual(path(place), doubt, value, limit)
    return [*found.values()]


@contextmanager
def doubting(case: Case) -> Iterator[None]:
    """Begin the error of a failing calculation with each value of the case that is unusual."""
    try:
        yield
    except PluginError:
        raise
    except (CaseError, NumericalError) as error:
        doubts = unusual(case)
        if doubts:
            # First: what follows from a wrong unit has remedies that mislead.
            error.args = (" ".join([*(doubt.words for doubt in doubts), str(error)]),)
        raise


def few_cells(contact: ContactSolution) -> list[Finding]:
    """Return a finding if a contact is only a few cells wide."""
    spans = zip(contact.extent, contact.pressure.shape, strict=True)
    # A line contact may have few cells along its length.
    wide = [rows.stop - rows.start for rows, all_rows in spans if rows.stop - rows.start < all_rows]
    return [findings.few_cells(min(wide))] if min(wide, default=np.inf) < findings.FEW_CELLS else []


@hookimpl(trylast=True)
def tribo_findings(model: Model) -> list[Finding]:
    """Report the surface of a body that does not repeat with the window as the contact does."""
    if not model.case.contact.periodic:
        return []
    for name, surface in model.surfaces.items():
        for axis, along in enumerate("xy"):
            jump = _jump(np.moveaxis(surface.height, axis, 0))
            if jump > 0:
                return [findings.broken_period(name, along, jump)]
    return []


def findings_of(model: Model, half_width_x: float) -> list[Finding]:
    """Return the findings of the kernel and of packages on a case.

    `half_width_x` is half the length of its first contact, in m.
    """
    own, types = sys.modules[__name__], {each.type for _, each in components(model.case)}
    given = {"model": model, "half_width_x": half_width_x}
    return from_packages("tribo_findings", own, types=types, **given)


def _jump(height: Array) -> float:
    """Return the jump of the height from the last row to the first; 0 if it is periodic."""
    steps = np.diff(height, axis=0, append=height[:1])
    bends = steps - 0.5 * (np.roll(steps, 1, axis=0) + np.roll(steps, -1, axis=0))
    # Those beside the last step have it in them.
    inside, last = bends[1:-2], bends[-1:]
    if len(inside) < SEAM or np.mean(last**2) <= SEAM**2 * np.mean(inside**2):
        return 0.0
    jump = float(np.sqrt(np.mean(steps[-1] ** 2)))
    return jump if jump > ROUND_OFF * float(np.ptp(height)) else 0.0


def check_stroke(model: Model, state: State) -> None:
    """Raise `CaseError` if track or positions cannot serve the first contact, in `state`."""
    if not model.changing:
        return
    half_width = half_widths(state.contact, model.grid)[0]
    with located("kinematics"):
        for name in model.changing:
            exposure = model.cycle.maps[name]
            length = exposure.track(model.grid)
            if exposure.averaged and length < half_width:
                raise CaseError(
                    f"a track of {1e3 * length:.3g} mm, less than the half-width of the first "
                    f"contact, {1e3 * half_width:.3g} mm, has no average; lengthen it, or resolve "
                    'a stroke by kinematics.positions = "auto"'
                )
        # Further apart they leave ripples of up to 10 % of its depth in the groove; each lies up to
        # half a cell beside its place.
        cell, apart = max(model.grid.spacing), model.cycle.apart
        if apart > (0.5 * half_width + cell) * (1 + ROUND_OFF):
            raise CaseError(
                f"{len(model.cycle)} positions lie up to {1e3 * apart:.3g} mm apart, more than "
                f"{0.5e3 * half_width:.3g} mm, half the half-width of the first contact; give at "
                f"least {least_positions(model.case.kinematics.track_extent, half_width)}",
                "kinematics.positions",
            )


def limitation(model: Model, half_width: float) -> Finding | None:
    """Return why averaging over a track does not hold for a contact of a half-width (m), if so."""
    period = model.grid.size[0]
    endless = model.case.contact.periodic and 2 * half_width > period * (1 - ROUND_OFF)
    for name in model.changing:
        exposure = model.cycle.maps[name]
        length = exposure.track(model.grid)
        if not exposure.averaged:
            continue
        if endless and abs(length - period) > ROUND_OFF * period:
            return findings.unlike_the_period(name, length, period)
        if endless:
            continue
        if model.case.kinematics.turns_back and length < findings.SHORT * half_width:
            return findings.short_stroke(length, half_width)
        if length < 2 * half_width:
            return findings.short_track(length, 2 * half_width)
    return None


def hold_wear(model: Model, state: State) -> State:
    """Return a state with each implausible wear as a finding; `TooWorn` if it is impossible."""
    for finding, impossible in implausible(model, state):
        if impossible:
            when = f"at {state.time:.6g} s ({state.distance:.6g} m)"
            error = TooWorn(f"{when} {finding.words}")
            error.finding = replace(finding, time=state.time)
            raise error
        state = state.from_here(finding)
    return state


def implausible(model: Model, state: State) -> Iterator[tuple[Finding, bool]]:
    """Yield a finding for each implausible wear depth and rate, and whether it is impossible."""
    # A window that repeats is a part of a larger contact.
    edges = () if model.case.contact.periodic else model.grid.size
    for name in model.laws.wear:
        wear, exposure = state.bodies[name].wear, model.cycle.maps[name]
        radii = (1 / abs(each) for each in model.surfaces[name].curvature or () if each)
        size = min((*edges, *radii, model.case.contact.layer_thickness))
        depth = float(np.max(wear))
        if depth > findings.DEEP * size:
            yield findings.too_deep(name, depth, size), depth >= size
        if (volume := exposure.volume(wear)) > findings.FAST * state.load_distance:
            rate = volume / state.load_distance
            yield findings.too_fast(name, rate), rate >= findings.IMPOSSIBLE
