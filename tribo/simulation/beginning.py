"""The state at which a run begins: unworn, or with the worn bodies of a result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from hashlib import sha256
from math import isnan
from pathlib import Path

import numpy as np

from tribo.case import Begin
from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.state import BodyState, State
from tribo.result.layout import BETWEEN, STATE, TRACK, TRACK_PLASTIC, TRACK_STATE
from tribo.result.read import Result
from tribo.simulation.model import Model
from tribo.stepping.step import first_contact

PLACE = "begin.result"
SAME = 1e-6
"""Of the range of heights, within which two surfaces are the same."""


def first_state(model: Model) -> State:
    """Return the state before any sliding: the first contact, of worn bodies if the case says so.

    Wear and load times distance go on from the result that the case begins with; time and distance
    begin anew.

    Raises
    ------
    CaseError
        If the contact does not fit the window, or the result does not fit the case.
    NumericalError
        If the solver fails.
    """
    begin = model.case.begin
    if begin is None:
        return first_contact(model)
    try:
        result = Result.open(begin.result)
    except CaseError as error:
        given = Path(begin.result)
        where = "" if given.is_absolute() or given.exists() else f"; looked for in {Path.cwd()}"
        raise CaseError(f"{error}{where}", PLACE) from None
    with result:
        save = _save(result, begin)
        _check_alike(model, result)
        bodies = {name: _worn(model, result, name, save) for name in model.bodies}
        carried, between = result.saves()[save], _between(model, result, save)
    load_distance = carried["load_distance_N_m"]
    if isnan(load_distance):
        # Older files lack it; their load was constant.
        load_distance = result.system.load * carried["distance_m"]
    energy = carried["friction_energy_J"]
    state = replace(
        first_contact(model, bodies),
        load_distance=load_distance,
        friction_energy=0.0 if isnan(energy) else energy,
    )
    state = replace(state, between={**state.between, **between})
    return state.with_notice(
        "begin",
        f"the bodies begin as worn as in {begin.result} at {carried['time_s']:g} s; wear depths, "
        "volumes and load_distance go on from there, time and distance begin anew",
    )


def checksum(begin: Begin) -> str:
    """Return what tells the file of a result from any other."""
    return sha256(Path(begin.result).read_bytes()).hexdigest()


def _save(result: Result, begin: Begin) -> int:
    if result.status in ("running", "killed"):
        raise CaseError(
            f"{result.name} is {result.status}: let its run end, or go on with it first", PLACE
        )
    if begin.time is None:
        return -1
    try:
        return result.save_at(begin.time)
    except CaseError as error:
        raise CaseError(str(error), "begin.time") from None


def _check_alike(model: Model, result: Result) -> None:
    """Refuse a result of other bodies, or on another grid."""
    name, grid = result.name, result.grid
    if set(result.body_names) != set(model.bodies):
        raise CaseError(
            f"{name} has the bodies {', '.join(result.body_names)}, and the case "
            f"{', '.join(model.bodies)}; name them alike",
            PLACE,
        )
    if (grid.size, grid.cells) != (model.grid.size, model.grid.cells):
        raise CaseError(
            f"{name} has {_cells(grid)}, and the case {_cells(model.grid)}; give the case the same "
            "grid",
            PLACE,
        )
    for body, surface in model.surfaces.items():
        was = result.case["bodies"][body].get("surface")
        # A file that a surface is read from may have changed since.
        height = model.under(body, surface.height, len(model.cycle) // 2)
        off = np.max(np.abs(height - result.body(body).height))
        if was != model.data["bodies"][body]["surface"] or off > SAME * np.ptp(height):
            raise CaseError(
                f"{name} begins with another surface of {body} than the case does; give the case "
                "the same surfaces: what is worn is a depth below them",
                PLACE,
            )


def _worn(model: Model, result: Result, name: str, save: int) -> BodyState:
    """Return what a result has of a body, on the rows that the body has in the case."""
    nx, rows = model.grid.cells[0], model.exposures[name].rows
    body, track = result.body(name), _along_track(result, TRACK, name, save)
    if body.swept != (name in model.swept):
        ways = "passes through the contact", "stays in it"
        was, is_now = ways if body.swept else ways[::-1]
        raise CaseError(f"{name} {was} in {result.name}, and {is_now} in the case", PLACE)
    if track is None:
        kept = [body.wear_depth[save], body.plastic_depth[save]]
        state = {field: values[save] for field, values in body.state.items()}
    else:
        plastic = _along_track(result, TRACK_PLASTIC, name, save)
        kept = [track, np.zeros_like(track) if plastic is None else plastic]
        along = {f.name: key for key, f in result.fields_of(TRACK_STATE, name).items()}
        found = {field: _along_track(result, key, name, save) for field, key in along.items()}
        state = {field: values for field, values in found.items() if values is not None}
        yielded = result.saves()[save]["bodies"][name]["max_plastic_depth_m"] > 0
        if (yielded and plastic is None) or set(body.state) - set(state):
            raise CaseError(
                f"{result.name} is of an older tribo, which kept of what has yielded, and of what "
                f"a law remembers, only the part of {name} in the window; run its case again",
                PLACE,
            )
    wear = _on_rows(kept[0], rows, nx)
    if wear is None:
        dx = model.grid.spacing[0]
        was, is_now = _path(kept[0], nx, dx), _path(np.empty((rows, 1)), nx, dx)
        raise CaseError(
            f"the cycle of {name} was {was} in {result.name}, and is {is_now} in the case; give "
            "both the same kinematics.stroke, and kinematics.positions that resolve both or "
            "average both",
            PLACE,
        )
    law = {}
    if name in model.laws:
        law = {k: np.full_like(wear, v) for k, v in model.laws[name].initial_state.items()}
        if _same_law(model, result, name):
            remembered = {k: _on_rows(state[k], rows, nx) for k in law if k in state}
            law |= {k: values for k, values in remembered.items() if values is not None}
    return BodyState(wear=wear, plastic=kept[1], law=law)


def _between(model: Model, result: Result, save: int) -> dict[str, Array]:
    """Return what a result has of the state of the effects, where each lies in the case."""
    found = {}
    whole = {field.name: key for key, field in result.fields_of(BETWEEN).items()}
    for name, (effect, field) in model.between.items():
        if effect.carrier is None or field.uniform:
            if name in whole:
                kept = result.field(whole[name], save)
                found[name] = kept.reshape(1, 1) if field.uniform else kept
            continue
        along = {f.name: k for k, f in result.fields_of(TRACK_STATE, effect.carrier).items()}
        here = {f.name: k for k, f in result.fields_of(STATE, effect.carrier).items()}
        values = None
        if name in along:
            values = _along_track(result, along[name], effect.carrier, save)
        elif name in here:
            values = result.field(here[name], save, effect.carrier)
        rows, nx = model.exposures[effect.carrier].rows, model.grid.cells[0]
        laid = None if values is None else _on_rows(values, rows, nx)
        if laid is not None:
            found[name] = laid
    return found


def _same_law(model: Model, result: Result, name: str) -> bool:
    """Whether a body has a law of the same type in a result and in the case."""
    law, was = model.case.bodies[name].wear, result.case["bodies"][name].get("wear")
    return law is not None and isinstance(was, Mapping) and law.type == was.get("type")


def _along_track(result: Result, variable: str, name: str, save: int) -> Array | None:
    """Return a field along the whole path of a body, shape (rows, ny), if it is kept."""
    if variable not in dir(result):
        return None
    track = result.field(variable, save, name)
    # Shorter ones lie in the middle of the longest, NaN beyond their ends.
    return track[~np.isnan(track[:, 0])] if np.any(np.isfinite(track)) else None


def _on_rows(field: Array, rows: int, window: int) -> Array | None:
    """Return a field on so many rows; None where it has others."""
    if rows == 1:
        return field[:1] if len(field) == window and np.all(field == field[:1]) else None
    return field if len(field) == rows else None


def _path(worn: Array, window: int, dx: float) -> str:
    """Say how a body with these rows has passed through a window of so many cells."""
    if len(worn) == 1 or (len(worn) == window and np.all(worn == worn[:1])):
        return "averaged"
    return f"resolved along {1e3 * (len(worn) - window) * dx:.4g} mm"


def _cells(grid: Grid) -> str:
    (lx, ly), (nx, ny) = grid.size, grid.cells
    return f"{nx} × {ny} cells in a window of {1e3 * lx:.4g} × {1e3 * ly:.4g} mm"
