"""The variables of a result file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

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

    A field of bodies has the name that it has in `BodyState`. A field of a model has a `kind`, the
    name that it has in the model, and the bodies that have it (NaN for the others): ``"state"`` is
    kept on a body, ``"track_state"`` along its whole track, ``"effect"`` provided by an effect,
    ``"between"`` kept by one. A column of a model is of a kind in `SAVED` and, if it is in the
    history, in `STEPPED`; the second kind is for bodies.
    """

    dims: tuple[str, ...]
    unit: str
    meaning: str
    kind: str = ""
    field: str = ""
    bodies: tuple[str, ...] = ()


ON_WINDOW = ("time", "x", "y")
ON_BODY = ("time", "body", "x", "y")
ON_TRACK = ("time", "body", "track_x", "y")
DIMS: Mapping[str, tuple[str, ...]] = {
    STATE: ON_BODY,
    EFFECT: ON_BODY,
    TRACK_STATE: ON_TRACK,
    BETWEEN: ON_WINDOW,
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
    "pressure": Variable(ON_WINDOW, "Pa", "Contact pressure"),
    "wear_depth": Variable(ON_BODY, "m", "Depth worn away", field="wear"),
    "plastic_depth": Variable(ON_BODY, "m", "Permanent displacement", field="plastic"),
    "track_x": Variable(("track_x",), "m", "Position along the track"),
    TRACK: Variable(ON_TRACK, "m", "Depth worn away along the whole track", field="wear"),
    TRACK_PLASTIC: Variable(
        ON_TRACK, "m", "Permanent displacement along the whole track", field="plastic"
    ),
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
