"""`expected.toml`: what a validation case must give, who says so, and how closely."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, field_validator, model_validator

from tribo.core.arrays import Array
from tribo.core.table import Table
from tribo.core.units import parse

Place = tuple[float, float]
Number = float | str
Kind = Literal["closed form", "other code", "measured"]


class Expectation(Table):
    """A quantity of the result, and its value; of several places, the values there.

    The error is relative: Σ|got − value|/Σ|value|. Of a value of 0 it is absolute.
    """

    quantity: str
    """A variable of a result, such as ``"max_pressure"``, or what a script calls it."""
    body: str | None = None
    """Whose, of a variable that each body has."""
    time: float | None = None
    """The save, by its time in s; the last if left out."""
    place: tuple[Place, ...] = ()
    """Where (x, y) in m, of a field, between cells on lines; its largest value if left out."""
    value: tuple[Number, ...]
    """In the SI unit of the quantity, or text with a unit; a value for each place."""
    tolerance: Annotated[float, Field(ge=0)]
    """Largest error."""
    reason: str
    """What the error consists of: why the tolerance is what it is."""
    order: float | None = None
    """Order of convergence over the `levels`; the observed one must be within 0.2 of it."""
    source: str | None = None
    kind: Kind | None = None
    published: bool | None = None

    @field_validator("place", mode="before")
    @classmethod
    def _one_place(cls, place: Any) -> Any:
        single = isinstance(place, list) and place and not isinstance(place[0], list)
        return [place] if single else place

    @field_validator("value", mode="before")
    @classmethod
    def _one_value(cls, value: Any) -> Any:
        return value if isinstance(value, list) else [value]

    @model_validator(mode="after")
    def _one_for_each_place(self) -> Expectation:
        if len(self.value) != max(len(self.place), 1):
            raise ValueError(
                f"{len(self.value)} values for {len(self.place)} places; give one for each"
            )
        return self

    def numbers(self, unit: str) -> Array:
        """Return the values in an SI unit; CaseError for a text in another one."""
        return np.array([parse(v, unit) if isinstance(v, str) else v for v in self.value])

    @property
    def label(self) -> str:
        """What it is, whose and when."""
        parts = [self.quantity.replace("_", " ")]
        parts += [f"of {self.body}"] if self.body else []
        parts += [f"at {len(self.place)} places"] if len(self.place) > 1 else []
        parts += [f"after {self.time:g} s"] if self.time is not None else []
        return " ".join(parts)


class Expected(Table):
    """The contents of `expected.toml`."""

    title: str
    """The case in a line."""
    source: str
    """Where the values come from, with page, table or equation."""
    kind: Kind
    """Who computed or measured them."""
    published: bool
    """Whether the source prints the values; false where they are derived from what it prints."""
    quick: bool = False
    """Whether ``tribo verify --quick`` takes the case: it runs in less than a second."""
    levels: dict[str, tuple[Any, ...]] = Field(default_factory=dict)
    """Values by their path in the case, coarse to fine, as ``"grid.cells" = [31, 93, 279]``."""
    solvers: tuple[str, ...] = ()
    """Contact solvers that must give the same, where they are installed."""
    expect: tuple[Expectation, ...]

    @field_validator("levels")
    @classmethod
    def _alike(cls, levels: dict[str, tuple[Any, ...]]) -> dict[str, tuple[Any, ...]]:
        if len({len(values) for values in levels.values()}) > 1:
            raise ValueError("lists of unequal length; give every path a value for each level")
        return levels

    @field_validator("expect")
    @classmethod
    def _some(cls, expect: tuple[Expectation, ...]) -> tuple[Expectation, ...]:
        if not expect:
            raise ValueError("a case expects something: add [[expect]] with a quantity")
        return expect
