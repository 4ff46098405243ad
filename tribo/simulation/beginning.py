"""The state at which a run begins: unworn, or with the worn bodies of a result."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, located
from tribo.core.findings import begun_worn
from tribo.core.grid import Grid
from tribo.core.rounding import SAME
from tribo.core.state import BodyState, State, key_of
from tribo.model.model import Model
from tribo.result.layout import BETWEEN, STATE, TRACK, TRACK_PLASTIC, TRACK_STATE
from tribo.result.read import Result
from tribo.stepping.first_contact import first_contact, first_law_state


def first_state(model: Model) -> State:
    """Return the state before any sliding: the first contact, of worn bodies if the case says so.

    Wear, load times distance and states of laws and effects continue from the result that the case
    begins with; time and distance start at 0. `CaseError` if the contact does not fit the window,
    or the result the case.
    """
    begin = model.case.begin
    if begin is None:
        return first_contact(model)
    with located("begin"), Result.open(begin) as result:
        if result.status in ("running", "killed"):
            raise CaseError(
                f"{result.name} is {result.status}: let its run end, or go on with it first"
            )
        _check_alike(model, result)
        bodies = {name: _worn(model, result, name) for name in model.case.bodies}
        found, afresh, left = _states(model, result)
        carried = result.saves()[-1]
    for name, body in bodies.items():
        bodies[name] = replace(body, law={k: found.get((name, k), v) for k, v in body.law.items()})
    of_effects = {key_of(field, place): values for (place, field), values in found.items()}
    between = {key: values for key, values in of_effects.items() if key in model.laws.between}
    state = replace(
        first_contact(model, bodies, between),
        load_distance=carried["load_distance_N_m"],
        friction_energy=carried.get("friction_energy_J", 0.0),
    )
    return state.with_findings(begun_worn(begin, carried["time_s"], afresh, left))


def checksum(begin: str) -> str:
    """Return the checksum of the file of a result."""
    return sha256(Path(begin).read_bytes()).hexdigest()


def _check_alike(model: Model, result: Result) -> None:
    """Refuse a result of other bodies, or on another grid."""
    name, grid = result.name, result.grid
    if set(result.body_names) != set(model.case.bodies):
        raise CaseError(
            f"{name} has the bodies {', '.join(result.body_names)}, and the case "
            f"{', '.join(model.case.bodies)}; name them alike"
        )
    if (grid.size, grid.cells) != (model.grid.size, model.grid.cells):
        raise CaseError(
            f"{name} has {_cells(grid)}, and the case {_cells(model.grid)}; give the case the same "
            "grid"
        )
    for body in model.surfaces:
        height = model.height(body)
        if np.max(np.abs(height - result.body(body).height)) > SAME * np.ptp(height):
            raise CaseError(
                f"{name} begins with another surface of {body} than the case does; give the case "
                "the same surfaces, from which wear depths count"
            )
        if result.body(body).swept != (body in model.cycle.swept):
            raise CaseError(
                f"{body} moves in {name} or in the case, and is stationary in the other; let "
                "kinematics.swept name the same body"
            )


def _worn(model: Model, result: Result, name: str) -> BodyState:
    """Return the state of a body in a result, on the rows of the body in the case."""
    body, rows = result.body(name), model.cycle.maps[name].rows
    depth, plastic = body.wear_depth[-1], body.plastic_depth[-1]
    if (track := _on_track(result, TRACK, name)) is not None:
        yielded = _on_track(result, TRACK_PLASTIC, name)
        depth, plastic = track, np.zeros_like(track) if yielded is None else yielded
    wear = _fitted(depth, (rows, model.grid.cells[1]))
    if wear is None:
        raise CaseError(
            f"{name} has {len(depth)} rows of cells in {result.name}, and {rows} in the case (1 "
            "for the average over a track); give both the same kinematics.stroke, and "
            "kinematics.positions that resolve both or average both"
        )
    return BodyState(wear, plastic, first_law_state(model, name, wear))


def _states(
    model: Model, result: Result
) -> tuple[dict[tuple[str | None, str], Array], list[str], list[str]]:
    """Return the states of laws and effects with which the case continues, by body and field.

    The body is None for the contact as a whole. A field continues where the result has a field of
    its name, unit and shape at the same place; the lists name fields that start afresh or are left
    out.
    """
    found: dict[tuple[str | None, str], Array] = {}
    afresh, left = [], []
    for place in (*model.case.bodies, None):
        where = "the contact" if place is None else place
        # The whole track comes last, and is taken where it is kept.
        kinds = (BETWEEN,) if place is None else (STATE, TRACK_STATE)
        fields = [each for kind in kinds for each in result.fields_of(kind, place).items()]
        kept = {(field.name, field.unit): variable for variable, field in fields}
        for field in model.laws.kept_on(place):
            values, shape = None, (1, 1) if field.uniform else model.grid.cells
            if place is not None:
                shape = model.cycle.maps[place].rows, model.grid.cells[1]
            if variable := kept.get((field.name, field.unit)):
                values = _fitted(_on_track(result, variable, place), shape)
            if values is None:
                afresh.append(f"{field.name} of {where}")
            else:
                found[place, field.name] = values
        left += [f"{name} of {where}" for name, _ in kept if (place, name) not in found]
    return found, afresh, left


def _on_track(result: Result, variable: str, name: str | None) -> Array | None:
    """Return a field along the whole path of a body, shape (rows, ny), if it is kept."""
    if variable not in dir(result):
        return None
    track = np.atleast_2d(result.field(variable, -1, name))
    # Shorter ones lie in the middle of the longest, NaN beyond their ends.
    return track[~np.isnan(track[:, 0])] if np.any(np.isfinite(track)) else None


def _fitted(field: Array | None, shape: tuple[int, int]) -> Array | None:
    """Return a field in a shape, one row for all that are alike; None where it has another."""
    if field is not None and shape[0] == 1 and np.all(field == field[:1]):
        field = field[:1]
    return field if field is not None and field.shape == shape else None


def _cells(grid: Grid) -> str:
    (lx, ly), (nx, ny) = grid.size, grid.cells
    return f"{nx} × {ny} cells in a window of {1e3 * lx:.4g} × {1e3 * ly:.4g} mm"
