"""The variables of a result file, and the rows that steps and saves add."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from tribo.core.arrays import Array, middle_rows
from tribo.core.fields import Field
from tribo.core.state import RunInfo, Snapshot, State
from tribo.result.columns import BODY_COLUMNS, COLUMNS

STATE, EFFECT, TRACK_STATE, BETWEEN = "state", "effect", "track_state", "between"
SAVED, STEPPED = ("saved", "saved_of_body"), ("stepped", "stepped_of_body")
HISTORY = "history_"
TRACK, TRACK_PLASTIC = "track_depth", "track_plastic"

Rows = dict[str, Any]
"""Added values, by variable: numbers, or for a field an array."""


@dataclass(frozen=True)
class Variable:
    """A variable of the dataset.

    A field of a model has a `kind`, the name that it has in the model, and the bodies that have it
    (NaN for the others): ``"state"`` is kept on a body, ``"track_state"`` along its whole track,
    ``"effect"`` provided by an effect, ``"between"`` kept by one. A column of a model is of a kind
    in `SAVED` and, if it is in the history, in `STEPPED`; the second kind is for bodies.
    """

    dims: tuple[str, ...]
    unit: str
    meaning: str
    kind: str = ""
    field: str = ""
    bodies: tuple[str, ...] = ()


_ON_WINDOW = ("time", "x", "y")
_ON_BODY = ("time", "body", "x", "y")
_ON_TRACK = ("time", "body", "track_x", "y")
DIMS: Mapping[str, tuple[str, ...]] = {
    STATE: _ON_BODY,
    EFFECT: _ON_BODY,
    TRACK_STATE: _ON_TRACK,
    BETWEEN: _ON_WINDOW,
    **dict(zip(SAVED, (("time",), ("time", "body")), strict=True)),
    **dict(zip(STEPPED, (("step",), ("step", "body")), strict=True)),
}
"""Dimensions of a field of a model by its kind; a uniform field has the time alone."""


FIXED = {
    "x": Variable(("x",), "m", "Position along the sliding direction"),
    "y": Variable(("y",), "m", "Position across the sliding direction"),
    "step": Variable(("step",), "1", "Number of the step"),
    "swept": Variable(("body",), "1", "Its points pass through the contact: 1, across too: 2"),
    "density": Variable(("body",), "kg/m^3", "Density"),
    "height": Variable(("body", "x", "y"), "m", "Initial height, outward"),
    "pressure": Variable(_ON_WINDOW, "Pa", "Contact pressure"),
    "wear_depth": Variable(_ON_BODY, "m", "Depth worn away"),
    "plastic_depth": Variable(_ON_BODY, "m", "Permanent displacement"),
    "track_x": Variable(("track_x",), "m", "Position along the track"),
    TRACK: Variable(_ON_TRACK, "m", "Depth worn away along the whole track"),
    TRACK_PLASTIC: Variable(_ON_TRACK, "m", "Permanent displacement along the whole track"),
} | {
    prefix + column.name: Variable(dims, column.unit, column.description)
    for prefix, dims, columns in (
        ("", ("time",), COLUMNS),
        ("", ("time", "body"), BODY_COLUMNS),
        (HISTORY, ("step",), COLUMNS),
        (HISTORY, ("step", "body"), BODY_COLUMNS),
    )
    for column in columns
}
"""Variables of every result by name, except of a track, and without fields of models."""


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
    for (kind, field), owners in _owners(run).items():
        name = f"{kind}_{field.name}" if kind == TRACK_STATE else field.name
        while name in FIXED or name in table or name == "body":
            name = f"{kind}_{name}"
        dims = ("time",) if kind == BETWEEN and field.uniform else DIMS[kind]
        table[name] = Variable(dims, field.unit, field.description, kind, field.name, owners)
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


def _owners(run: RunInfo) -> dict[tuple[str, Field], tuple[str, ...]]:
    """Return the names of the bodies that have a field of a model, by its kind and the field."""
    everybody = tuple(body.name for body in run.bodies)
    found = {(EFFECT, field): everybody for field in run.effect_fields}
    found |= {(BETWEEN, field): () for field in run.between_fields}
    for body in run.bodies:
        kinds = (STATE, TRACK_STATE) if body.rows > run.system.grid.cells[0] else (STATE,)
        for field, kind in product(body.state_fields, kinds):
            found[kind, field] = (*found.get((kind, field), ()), body.name)
    return found


def step_row(snapshot: Snapshot, table: Mapping[str, Variable]) -> Rows:
    """Return the row of a step in the history."""
    row = {HISTORY + name: value for name, value in _scalars(snapshot).items()}
    return row | _of_models(snapshot, table, STEPPED)


def save_row(snapshot: Snapshot, table: Mapping[str, Variable]) -> Rows:
    """Return the row of a save."""
    state, shape = snapshot.state, snapshot.state.contact.pressure.shape
    row: Rows = {**_scalars(snapshot), "pressure": state.contact.pressure}
    row |= _of_models(snapshot, table, SAVED)
    wear = {name: body.wear for name, body in state.bodies.items()}
    plastic = {name: body.plastic for name, body in state.bodies.items()}
    own = {"wear_depth": wear, "plastic_depth": plastic, TRACK: wear, TRACK_PLASTIC: plastic}
    for name, variable in table.items():
        if variable.kind in (*SAVED, *STEPPED):
            continue
        if variable.kind == BETWEEN:
            kept = state.between[variable.field]
            row[name] = kept if variable.dims == _ON_WINDOW else float(kept[0, 0])
            continue
        if variable.kind == EFFECT:
            # An effect that has failed leaves none.
            of_bodies = dict(snapshot.effects.get(variable.field, {}))
        elif variable.kind:
            of_bodies = {n: state.remembered(n, variable.field) for n in variable.bodies}
        elif name in own:
            of_bodies = own[name]
        else:
            continue
        on_track = variable.dims == _ON_TRACK
        row[name] = (
            _on_track(state, of_bodies) if on_track else _stacked(shape, of_bodies, state.bodies)
        )
    return row


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


def _stacked(
    shape: tuple[int, ...], of_bodies: Mapping[str, Array], bodies: Iterable[str]
) -> Array:
    missing = np.full((1, 1), np.nan)
    fields = (middle_rows(of_bodies.get(name, missing), shape[0]) for name in bodies)
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
