"""Notices of where a case leaves the range in which its models hold."""

from __future__ import annotations

import math

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.errors import located
from tribo.core.measures import Measures, half_widths
from tribo.core.state import State
from tribo.core.words import readable
from tribo.lab.against_hertz import hertz_contact
from tribo.motion.stroke import check_spacing, spacing_for
from tribo.stepping.model import Model
from tribo.stepping.quadrature import cycle_error

COARSE, FINE = 0.05, 0.01
"""Error of a cycle, of the depth, from which on it is spoken of, and with the positions advised."""
STEEP = 0.3
"""Half-width of a contact over the radius of a body, from which on it is spoken of."""
SHARP = 1.2
"""Largest pressure at the edge over that inside of a contact, from which on it is spoken of."""
UNLIKE = 0.01
"""Relative difference of a track from the period, from which on it is spoken of."""
SEAM = 4
"""How many times more a surface bends at the edge of a window than inside if it ends there."""
ROUNDING = 1e-9
WHOLE = 1 - 1e-9
FEW_CELLS = 8


def few_cells(model: Model, first: ContactSolution) -> str | None:
    """Say so if the first contact is only a few cells wide, by Hertz where that is known."""
    dx, dy = model.grid.spacing
    hertz = None if model.case.begin else hertz_contact(model.contact.system)
    width, breadth = (
        half_widths(first, model.grid)
        if hertz is None
        else (hertz.half_width_x, hertz.half_width_y)
    )
    cells = min(2 * width / dx, 2 * breadth / dy)
    if round(cells) >= FEW_CELLS:
        return None
    return (
        f"the first contact is only {cells:.1f} cells wide, so its pressure is inaccurate "
        f"until it has grown: raise grid.cells for {FEW_CELLS} or more"
    )


def broken_period(model: Model) -> str | None:
    """Say so if the contact repeats with the window, but the surface of a body does not."""
    if not model.case.contact.periodic:
        return None
    for name, surface in model.surfaces.items():
        for axis, along in enumerate("xy"):
            jump = _jump(np.moveaxis(surface.height, axis, 0))
            if jump > 0:
                return (
                    f"the surface of {name} does not repeat with the window: along {along} it "
                    f"jumps by {1e9 * jump:.3g} nm (root mean square) from one period to the next, "
                    "and presses there; give it a period of the window's length or a part of it"
                )
    return None


def _jump(height: Array) -> float:
    """Return the height by which the last row misses the first one as next; 0 if it goes on."""
    steps = np.diff(height, axis=0, append=height[:1])
    bends = steps - 0.5 * (np.roll(steps, 1, axis=0) + np.roll(steps, -1, axis=0))
    # Those beside the last step have it in them.
    inside, last = bends[1:-2], bends[-1:]
    if len(inside) < SEAM or np.mean(last**2) <= SEAM**2 * np.mean(inside**2):
        return 0.0
    jump = float(np.sqrt(np.mean(steps[-1] ** 2)))
    return jump if jump > ROUNDING * float(np.ptp(height)) else 0.0


def too_wide(model: Model, measures: Measures) -> list[str]:
    """Say of which bodies the contact is too wide for their radius to be a half-space."""
    widths = (measures.half_width_x, measures.half_width_y)
    told = []
    for name, surface in model.surfaces.items():
        curvatures = surface.curvature or (0.0, 0.0)
        ratio, curvature = max(
            (abs(c) * a, abs(c)) for c, a in zip(curvatures, widths, strict=True)
        )
        if ratio > STEEP:
            told.append(
                f"at {readable(measures.time, '.3g')} s the contact's half-width a is "
                f"{ratio:.2f} of the radius R of {name}, {1e3 / curvature:.3g} mm: a half-space "
                "with small slopes asks for a/R well below 1 (0.1, say), and pressures and "
                "depths may be far off"
            )
    return told


def short_of_a_lap(model: Model) -> str | None:
    """Say so if the whole run slides over a part of a body's track only."""
    distance = model.end_distance
    for name in [name for name in model.laws.wear if name in model.cycle.swept]:
        length = _track_length(model, name)
        if distance < WHOLE * length:
            return (
                f"the run slides {distance:.3g} m, {distance / length:.2g} of the track of {name}, "
                f"which is {length:.3g} m long: its wear is averaged over the whole track, also "
                "where the contact never comes to; slide once over it at least, and for the "
                "average to hold many times"
            )
    return None


def _track_length(model: Model, name: str) -> float:
    starts = model.cycle.maps[name].starts
    if starts is not None:
        return (max(starts) - min(starts)) * model.grid.spacing[0]
    # What one metre of depth all along the track takes, over the breadth of the window.
    depth = np.ones((1, model.grid.cells[1]))
    return model.cycle.maps[name].volume(depth) / model.grid.size[1]


def check_stroke(model: Model, state: State) -> None:
    """Raise `CaseError` if averaging makes no sense for the first contact, in `state`."""
    if not model.changing:
        return
    half_width = half_widths(state.contact, model.grid)[0]
    with located("kinematics"):
        passes = any(e.starts is not None for e in model.cycle.maps.values())
        if not model.case.contact.periodic or not passes:
            model.motion.check_contact(half_width)
        elif not is_endless(model, half_width) and model.cycle.apart > model.grid.spacing[0]:
            gaps = len(model.cycle) - 1
            check_spacing(gaps * model.cycle.apart, gaps + 1, half_width)


def limitation(model: Model, state: State) -> str | None:
    """Return why averaging over a track does not hold for the contact in `state`, if so."""
    seen = half_width, *_ = track_average(model, state)
    if is_endless(model, half_width):
        return _unlike_the_period(model)
    return model.motion.limitation(*seen)


def _unlike_the_period(model: Model) -> str | None:
    """Say so if a body that meets a contact without an end is averaged over another length."""
    period = model.grid.size[0]
    averaged = [name for name in model.changing if model.cycle.maps[name].starts is None]
    for name in averaged:
        length = _track_length(model, name)
        if name in model.laws.wear and abs(length - period) > UNLIKE * period:
            return (
                f"the contact repeats every {1e3 * period:.4g} mm without an end, but what one "
                f"period wears off {name} is averaged over a track of {1e3 * length:.4g} mm: "
                f"{name} wears {period / length:.2g} times as much as it would; make the track "
                'as long as the window, or resolve it by kinematics.positions = "cells"'
            )
    return None


def track_average(model: Model, state: State) -> tuple[float, float, float, float, bool]:
    """Return half-width, depth, approach (m), ratio of volumes and line for `limitation`."""
    depths = [float(np.max(state.bodies[name].wear)) for name in model.changing]
    contact = state.contact
    half_width = half_widths(contact, model.grid)[0]
    # Worn off the bodies that stay over that off those that are swept.
    lost = {True: 0.0, False: 0.0}
    for name, body in state.bodies.items():
        lost[name in model.cycle.swept] += model.cycle.maps[name].volume(body.wear)
    stays, swept = lost[False], lost[True]
    ratio = stays / swept if swept else (np.inf if stays else 1.0)
    across = bool(np.all(np.any(contact.pressure > 0, axis=0)))
    return half_width, max(depths, default=0.0), state.reference_depth, ratio, across


def is_endless(model: Model, half_width: float) -> bool:
    """Whether the contact goes on into the next period of what repeats along x."""
    return model.case.contact.periodic and 2 * half_width > model.grid.size[0] * (1 - 1e-9)


def coarse_cycle(model: Model, state: State) -> str | None:
    """Say so if the positions of the cycle are so few that the depths are 5 % off."""
    error = cycle_error(model, state)
    if error <= COARSE:
        return None
    # The error goes with the square of the spacing.
    gaps = (len(model.cycle) - 1) * math.sqrt(error / FINE)
    return (
        f"the {len(model.cycle)} positions of the cycle, {1e3 * model.cycle.apart:.3g} mm apart, "
        f"leave the wear depth uncertain by about {100 * error:.2g} %, weighted with the load; "
        f"raise kinematics.positions to {2 * math.ceil(0.5 * gaps) + 1} for 1 %"
    )


def peak_at_the_edge(state: State) -> str | None:
    """Say so if the largest pressure stands in cells at the edge of the contact alone."""
    pressure = state.contact.pressure
    touches = np.pad(pressure > 0, 1, constant_values=True)
    inside = touches[1:-1, 1:-1] & touches[:-2, 1:-1] & touches[2:, 1:-1]
    inside &= touches[1:-1, :-2] & touches[1:-1, 2:]
    largest, within = float(np.max(pressure)), float(np.max(pressure, where=inside, initial=0.0))
    if largest <= SHARP * within or not within:
        return None
    return (
        f"the largest pressure, {1e-6 * largest:.4g} MPa, stands in cells at the edge of the "
        f"contact alone, and {1e-6 * within:.4g} MPa inside of it: it changes with the size of the "
        "cells and from step to step; compare pressures in the centre instead"
    )


def positions_for(model: Model, first: ContactSolution) -> int | None:
    """Return the positions that wear the groove of the first contact evenly to 1 %.

    None where the cycle is not resolved.
    """
    starts = [e.starts for e in model.cycle.maps.values() if e.starts is not None]
    if not starts:
        return None
    path = max(starts[0]) - min(starts[0])
    spacing = spacing_for(first.pressure, FINE, repeats=model.case.contact.periodic)
    return 2 * math.ceil(0.5 * path / spacing) + 1
