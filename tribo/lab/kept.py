"""Fields of effects and states of models: at each save, in a table, and as maps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.core.data_table import DataTable, Heading, TableRow
from tribo.core.rounding import ROUND_OFF
from tribo.lab.units import row_name
from tribo.result.layout import BETWEEN, EFFECT, STATE
from tribo.result.read import Result


@dataclass(frozen=True)
class KeptField:
    """A field at every save, shape (saves, nx, ny), or a number at each, shape (saves,)."""

    key: str
    name: str
    unit: str
    values: Array

    @property
    def varies(self) -> bool:
        """Whether it differs from place to place at any save."""
        return not all(steady(values) for values in self.values)

    def mean(self, result: Result, save: int) -> float:
        """Return the mean in the contact at a save."""
        touched = result.field("pressure", save) > 0
        return float(np.mean(np.broadcast_to(self.values[save], touched.shape)[touched]))


def steady(values: Array) -> bool:
    """Return whether values are all the same but for rounding."""
    return bool(np.ptp(values) <= ROUND_OFF * np.max(np.abs(values)))


def kept_fields(result: Result) -> list[KeptField]:
    """Return the fields that a result has of its models.

    A field that is equal on all bodies is listed once; a field that an effect failed to provide is
    left out.
    """
    return [each for each in _fields(result) if np.isfinite(each.values).all()]


def fields_table(result: Result) -> DataTable | None:
    """Return the range and the mean of each field at the last save; None without fields."""
    rows = []
    for field in kept_fields(result):
        last = field.values[-1]
        name, factor = row_name(field.name, field.unit, last)
        values = float(np.min(last)), field.mean(result, -1), float(np.max(last))
        rows.append(TableRow((name, *(value / factor for value in values)), ".4g"))
    headings = list(map(Heading, ("", "least", "mean in the contact", "largest")))
    return DataTable("Fields of effects and wear laws at the end", headings, rows) if rows else None


def _fields(result: Result) -> Iterator[KeptField]:
    every = range(len(result.times))
    for key, field in result.fields_of(BETWEEN).items():
        values = np.array([result.field(key, save) for save in every])
        yield KeptField(key, field.name.replace("_", " "), field.unit, values)
    for kind in (EFFECT, STATE):
        for key, field in result.fields_of(kind).items():
            of_bodies = {
                body: np.array([result.field(key, save, body) for save in every])
                for body in result.body_names
                if key in result.fields_of(kind, body)
            }
            both = np.array([*of_bodies.values()])
            apart = np.max(np.ptp(both, axis=0))
            alike = len(both) > 1 and bool(apart <= ROUND_OFF * np.max(np.abs(both)))
            for body, values in [*of_bodies.items()][: 1 if alike else None]:
                name = field.name.replace("_", " ")
                own = (key, name) if alike else (f"{body}_{key}", f"{name}, {body}")
                yield KeptField(*own, field.unit, values)
