"""The state at which a run begins: unworn, or with the worn bodies of a result."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import numpy as np

from tribo.case import Begin
from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.findings import begun_worn
from tribo.core.grid import Grid
from tribo.core.rounding import SAME
from tribo.core.state import BodyState, State, key_of
from tribo.model.model import Model
from tribo.result.layout import BETWEEN, STATE, TRACK, TRACK_PLASTIC, TRACK_STATE
from tribo.result.read import Result
from tribo.stepping.first_contact import first_contact, first_law_state

PLACE = "begin.result"


def first_state(model: Model) -> State:
    """Return the state before any sliding: the first contact, of worn bodies if the case says so.

    Wear, load times distance and states of laws and effects continue from the result that the case
    begins with; time and distance start at 0. `CaseError` if the contact does not fit the window,
    or the result the case.
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
        bodies = {name: _worn(model, result, name, save) for name in model.case.bodies}
        found, afresh, left = _remembered(model, result, save)
        carried = result.saves()[save]
    for name, body in bodies.items():
        bodies[name] = replace(body, law={k: found.get((name, k), v) for k, v in body.law.items()})
    of_effects = {key_of(field, place): values for (place, field), values in found.items()}
    between = {key: values for key, values in of_effects.items() if key in model.laws.between}
    state = replace(
        first_contact(model, bodies, between),
        load_distance=carried["load_distance_N_m"],
        friction_energy=carried.get("friction_energy_J", 0.0),
    )
    return state.with_findings(begun_worn(begin.result, carried["time_s"], afresh, left))


def checksum(begin: Begin) -> str:
    """Return the checksum of the file of a result."""
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
    if set(result.body_names) != set(model.case.bodies):
        raise CaseError(
            f"{name} has the bodies {', '.join(result.body_names)}, and the case "
            f"{', '.join(model.case.bodies)}; name them alike",
            PLACE,
        )
    if (grid.size, grid.cells) != (model.grid.size, model.grid.cells):
        raise CaseError(
            f"{name} has {_cells(grid)}, and the case {_cells(model.grid)}; give the case the same "
            "grid",
            PLACE,
        )
    for body in model.surfaces:
        height = model.height(body)
        if np.max(np.abs(height - result.body(body).height)) > SAME * np.ptp(height):
            raise CaseError(
                f"{name} begins with another surface of {body} than the case does; give the case "
                "the same surfaces, from which wear depths count",
                PLACE,
            )


def _worn(model: Model, result: Result, name: str, save: int) -> BodyState:
    """Return the state of a body in a result, on the rows of the body in the case."""
    nx, rows = model.grid.cells[0], model.cycle.maps[name].rows
    body, track = result.body(name), _along_track(result, TRACK, name, save)
    if body.swept != (name in model.cycle.swept):
        ways = "passes through the contact", "stays in it"
        was, is_now = ways if body.swept else ways[::-1]
        raise CaseError(f"{name} {was} in {result.name}, and {is_now} in the case", PLACE)
    if track is None:
        kept = [body.wear_depth[save], body.plastic_depth[save]]
    else:
        plastic = _along_track(result, TRACK_PLASTIC, name, save)
        kept = [track, np.zeros_like(track) if plastic is None else plastic]
    wear = _on_rows(kept[0], rows, nx)
    if wear is None:
        raise CaseError(
            f"{name} has {len(kept[0])} rows of cells in {result.name}, and {rows} in the case (1 "
            "for the average over a track); give both the same kinematics.stroke, and "
            "kinematics.positions that resolve both or average both",
            PLACE,
        )
    return BodyState(wear, kept[1], first_law_state(model, name, wear))


def _remembered(
    model: Model, result: Result, save: int
) -> tuple[dict[tuple[str | None, str], Array], list[str], list[str]]:
    """Return the states of laws and effects with which the case continues, by body and field.

    The body is None for the contact as a whole. A field continues where the result has a field of
    its name and unit at the same place; the lists name fields that start afresh or are left out.
    """
    found: dict[tuple[str | None, str], Array] = {}
    afresh, left = [], []
    for place in (*model.case.bodies, None):
        where = "the contact" if place is None else place
        kept = _kept(result, place)
        for field in model.laws.kept_on(place):
            variable = kept.get((field.name, field.unit))
            laid = None if variable is None else _laid(model, result, variable, save, place, field)
            if laid is None:
                afresh.append(f"{field.name} of {where}")
            else:
                found[place, field.name] = laid
        left += [f"{name} of {where}" for name, _ in kept if (place, name) not in found]
    return found, afresh, left


def _kept(result: Result, place: str | None) -> dict[tuple[str, str], str]:
    """Return the variable of each state field of a body, or of the contact, by name and unit."""
    # What there is along the whole track comes last, and so is what is taken.
    kinds = (BETWEEN,) if place is None else (STATE, TRACK_STATE)
    fields = [each for kind in kinds for each in result.fields_of(kind, place).items()]
    return {(field.name, field.unit): variable for variable, field in fields}


def _laid(
    model: Model, result: Result, variable: str, save: int, place: str | None, field: Field
) -> Array | None:
    """Return a state field of a result as the case keeps it; None where it is of another shape."""
    if place is not None:
        along = _along_track(result, variable, place, save)
        rows = model.cycle.maps[place].rows
        return None if along is None else _on_rows(along, rows, model.grid.cells[0])
    values = result.field(variable, save)
    if field.uniform:
        return values.reshape(1, 1) if values.size == 1 else None
    return values if values.shape == model.grid.cells else None


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


def _cells(grid: Grid) -> str:
    (lx, ly), (nx, ny) = grid.size, grid.cells
    return f"{nx} × {ny} cells in a window of {1e3 * lx:.4g} × {1e3 * ly:.4g} mm"
