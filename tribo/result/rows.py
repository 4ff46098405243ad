"""What a run writes to its result file: the header, its variables, a row for each step and save."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import product

import numpy as np

from tribo.core.arrays import Array, middle_rows
from tribo.core.state import RunInfo, Snapshot, State
from tribo.result.columns import BODY_COLUMNS, COLUMNS
from tribo.result.header import Header
from tribo.result.layout import (
    BETWEEN,
    DIMS,
    EFFECT,
    FIXED,
    HISTORY,
    ON_BODY,
    ON_TRACK,
    ON_WINDOW,
    SAVED,
    STATE,
    STEPPED,
    TRACK,
    TRACK_PLASTIC,
    TRACK_STATE,
    Rows,
    Variable,
)


def header_of(run: RunInfo) -> Header:
    """Return the header of a run that begins."""
    system = run.system
    known = {
        "load_N": system.load,
        "window_m": system.grid.size,
        "modulus_Pa": system.modulus,
        "cap_Pa": system.cap,
        "curvature_1_m": system.curvature,
        "case": run.case,
        "provenance": run.provenance,
    }
    return Header.model_validate(known)


def variables(run: RunInfo) -> dict[str, Variable]:
    """Return the variables of a run by name, the fields of its models among them.

    A field whose name is taken has ``effect_`` or ``state_`` before it; a field along the whole
    track has ``track_state_``.
    """
    bodies, rows = run.bodies, _rows(run)
    left_out: set[str] = set()
    if rows <= run.system.grid.cells[0]:
        left_out |= {"track_x", TRACK, TRACK_PLASTIC}
    elif run.system.cap is None:
        left_out.add(TRACK_PLASTIC)
    table = {name: variable for name, variable in FIXED.items() if name not in left_out}
    owners = dict.fromkeys(product([EFFECT], run.effect_fields), tuple(b.name for b in bodies))
    owners |= dict.fromkeys(product([BETWEEN], run.between_fields), ())
    for body in bodies:
        kinds = (STATE, TRACK_STATE) if body.rows > run.system.grid.cells[0] else (STATE,)
        for field, kind in product(body.state_fields, kinds):
            owners[kind, field] = (*owners.get((kind, field), ()), body.name)
    for (kind, field), names in owners.items():
        name = f"{kind}_{field.name}" if kind == TRACK_STATE else field.name
        while name in FIXED or name in table or name == "body":
            name = f"{kind}_{name}"
        dims = ("time",) if kind == BETWEEN and field.uniform else DIMS[kind]
        table[name] = Variable(dims, field.unit, field.description, kind, field.name, names)
    for column in run.columns:
        name, whose = column.name, tuple(body.name for body in bodies if column.of_bodies)
        name = f"column_{name}" if name in table or name == "body" else name
        for kinds, key in ((SAVED, name), (STEPPED, HISTORY + name)):
            kind, about = kinds[column.of_bodies], (column.unit, column.description)
            table[key] = Variable(DIMS[kind], *about, kind, column.name, whose)
    return table


def constants(run: RunInfo) -> dict[str, Array]:
    """Return the values of the variables that do not grow with the run."""
    grid, bodies, rows = run.system.grid, run.bodies, _rows(run)
    values = {
        "x": grid.x,
        "y": grid.y,
        "swept": np.array([body.swept * (1 if body.straight else 2) for body in bodies], float),
        # NaN where there is none.
        "density": np.array([body.density for body in bodies], dtype=float),
        "height": np.stack([body.height for body in bodies]),
    }
    if rows > grid.cells[0]:
        values["track_x"] = np.asarray((np.arange(rows) - 0.5 * (rows - 1)) * grid.spacing[0])
    return values


def _rows(run: RunInfo) -> int:
    """Return how many cells along x the longest surface has."""
    return max(body.rows for body in run.bodies)


def step_row(snapshot: Snapshot, table: Mapping[str, Variable]) -> Rows:
    """Return the row of a step in the history."""
    row = {HISTORY + name: value for name, value in _scalars(snapshot).items()}
    return row | _of_models(snapshot, table, STEPPED)


def save_row(snapshot: Snapshot, table: Mapping[str, Variable]) -> Rows:
    """Return the row of a save."""
    state = snapshot.state
    row: Rows = {**_scalars(snapshot), "pressure": state.contact.pressure}
    row |= _of_models(snapshot, table, SAVED)
    for name, variable in table.items():
        if variable.kind == BETWEEN:
            kept = state.between[variable.field]
            row[name] = kept if variable.dims == ON_WINDOW else float(kept[0, 0])
        elif variable.dims == ON_BODY:
            row[name] = _on_window(state, _on_bodies(snapshot, variable))
        elif variable.dims == ON_TRACK:
            row[name] = _on_track(state, _on_bodies(snapshot, variable))
    return row


def _on_bodies(snapshot: Snapshot, variable: Variable) -> Mapping[str, Array]:
    """Return a field of bodies, by body, each on its own surface."""
    state, field = snapshot.state, variable.field
    if variable.kind == EFFECT:
        # An effect that has failed leaves none.
        return snapshot.effects.get(field, {})
    if variable.kind:
        return {name: state.remembered(name, field) for name in variable.bodies}
    return {name: getattr(body, field) for name, body in state.bodies.items()}


def part_of(rows: Iterable[Rows]) -> Rows:
    """Return rows as columns: lists of numbers, and an array for each field."""
    columns: Rows = {}
    for row in rows:
        for name, value in row.items():
            columns.setdefault(name, []).append(value)
    return {
        name: np.stack(values) if isinstance(values[0], np.ndarray) else values
        for name, values in columns.items()
    }


def _on_window(state: State, of_bodies: Mapping[str, Array]) -> Array:
    """Return fields in the window, NaN for bodies that have none."""
    shape, missing = state.contact.pressure.shape, np.full((1, 1), np.nan)
    fields = (middle_rows(of_bodies.get(name, missing), shape[0]) for name in state.bodies)
    return np.stack([np.broadcast_to(field, shape) for field in fields])


def _on_track(state: State, of_bodies: Mapping[str, Array]) -> Array:
    """Return fields on bodies' own surfaces, NaN for surfaces no longer than the window."""
    nx, ny = state.contact.pressure.shape
    rows = max(len(body.wear) for body in state.bodies.values())
    stacked = np.full((len(state.bodies), rows, ny), np.nan)
    for on_track, name in zip(stacked, state.bodies, strict=True):
        field = of_bodies.get(name)
        if field is not None and len(field) > nx:
            first = (rows - len(field)) // 2
            on_track[first : first + len(field)] = field
    return stacked


def _scalars(snapshot: Snapshot) -> Rows:
    bodies = snapshot.measures.bodies
    return {
        **{column.name: column.read(snapshot) for column in COLUMNS},
        **{part.name: [part.read(snapshot, body) for body in bodies] for part in BODY_COLUMNS},
    }


def _of_models(snapshot: Snapshot, table: Mapping[str, Variable], kinds: tuple[str, ...]) -> Rows:
    """Return the columns of models."""
    values = {n: snapshot.columns[v.field] for n, v in table.items() if v.kind in kinds}
    return {n: [*v.values()] if isinstance(v, Mapping) else v for n, v in values.items()}
