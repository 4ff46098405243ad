"""The variables of a result: their dimensions, units and meanings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import inf

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import Field
from tribo.core.measures import Measures
from tribo.core.state import RunInfo, Snapshot
from tribo.result.columns import BODY_COLUMNS, COLUMNS

STATE, EFFECT = "state", "effect"


@dataclass(frozen=True)
class Variable:
    """A variable of the dataset.

    Parameters
    ----------
    dims : tuple of str
        Its dimensions.
    unit, meaning : str
        Unit, and what it means.
    least : float, optional
        No value may be smaller.
    gaps : bool, optional
        Whether values may be NaN.
    kind : str, optional
        ``"state"`` for a field that a wear law keeps, ``"effect"`` for one
        that an effect provides.
    field : str, optional
        The name that such a field has in its model.
    bodies : tuple of str, optional
        The bodies that have such a field; NaN for the others.
    """

    dims: tuple[str, ...]
    unit: str
    meaning: str
    least: float = -inf
    gaps: bool = False
    kind: str = ""
    field: str = ""
    bodies: tuple[str, ...] = ()

    @property
    def grows(self) -> bool:
        """Whether a run adds to it as it goes on."""
        return self.dims[0] in ("time", "step")


_ON_WINDOW = ("time", "x", "y")
_ON_BODY = ("time", "body", "x", "y")


def _fixed() -> dict[str, Variable]:
    table = {
        "x": Variable(("x",), "m", "Position along the sliding direction"),
        "y": Variable(("y",), "m", "Position across the sliding direction"),
        "step": Variable(("step",), "1", "Number of the step"),
        "swept": Variable(("body",), "1", "Whether its points pass through the contact"),
        "density": Variable(("body",), "kg/m^3", "Density", least=0, gaps=True),
        "height": Variable(("body", "x", "y"), "m", "Initial height, outward"),
        "pressure": Variable(_ON_WINDOW, "Pa", "Contact pressure", least=0),
        "wear_depth": Variable(_ON_BODY, "m", "Depth worn away", least=0),
        "plastic_depth": Variable(_ON_BODY, "m", "Permanent displacement"),
    }
    for prefix, dim in (("", "time"), ("history_", "step")):
        for column in COLUMNS:
            table[prefix + column.name] = Variable((dim,), column.unit, column.description)
        for part in BODY_COLUMNS:
            table[prefix + part.name] = Variable((dim, "body"), part.unit, part.description)
    return table


FIXED = _fixed()
"""What every result has, by name."""


def run_variables(run: RunInfo) -> dict[str, Variable]:
    """Return the variables of a run by name, the fields of its models among them.

    A field whose name is taken has ``effect_`` or ``state_`` before it.
    """
    everybody = tuple(body.name for body in run.bodies)
    fields = {(EFFECT, field): everybody for field in run.effect_fields}
    for body in run.bodies:
        for field in body.state_fields:
            fields[STATE, field] = (*fields.get((STATE, field), ()), body.name)
    table = dict(FIXED)
    for (kind, field), bodies in fields.items():
        name = field.name
        while name in table or name == "body":
            name = f"{kind}_{name}"
        table[name] = field_variable(kind, field, bodies)
    return table


def field_variable(kind: str, field: Field, bodies: Iterable[str]) -> Variable:
    """Return the variable of a field that a model keeps or provides."""
    return Variable(
        _ON_BODY,
        field.unit,
        field.description,
        gaps=True,
        kind=kind,
        field=field.name,
        bodies=tuple(bodies),
    )


def step_row(measures: Measures) -> dict[str, Array]:
    """Return what a step adds to the history, by variable."""
    return {f"history_{name}": value for name, value in _scalars(measures).items()}


def save_row(snapshot: Snapshot, variables: Mapping[str, Variable]) -> dict[str, Array]:
    """Return what a save adds, by variable."""
    state, shape = snapshot.state, snapshot.state.contact.pressure.shape
    row = {
        **_scalars(snapshot.measures),
        "pressure": state.contact.pressure,
        "wear_depth": _stacked(shape, {n: b.wear for n, b in state.bodies.items()}, state.bodies),
        "plastic_depth": np.stack([body.plastic for body in state.bodies.values()]),
    }
    for name, variable in variables.items():
        if variable.kind == STATE:
            of_bodies = {n: state.bodies[n].law[variable.field] for n in variable.bodies}
        elif variable.kind == EFFECT:
            # An effect that has failed leaves none.
            of_bodies = dict(snapshot.effects.get(variable.field, {}))
        else:
            continue
        row[name] = _stacked(shape, of_bodies, state.bodies)
    return row


def _stacked(
    shape: tuple[int, ...], of_bodies: Mapping[str, Array], bodies: Iterable[str]
) -> Array:
    return np.stack([np.broadcast_to(of_bodies.get(name, np.nan), shape) for name in bodies])


def _scalars(measures: Measures) -> dict[str, Array]:
    bodies = measures.bodies.values()
    return {
        **{column.name: np.array(column.read(measures), float) for column in COLUMNS},
        **{part.name: np.array([part.read(b) for b in bodies], float) for part in BODY_COLUMNS},
    }
