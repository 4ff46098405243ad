"""What ends a run before its motion does."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from tribo.core.table import Table
from tribo.core.units import Quantity


class Stop(Table):
    """Ends the run at the first condition that is met."""

    distance: Annotated[float, Quantity("m", above=0)] | None = None
    """Sliding distance."""
    depth: Annotated[float, Quantity("m", above=0)] | None = None
    """Largest wear depth."""
    body: str | None = None
    """Name of the body whose depth counts; either, if left out."""

    @model_validator(mode="after")
    def _body_needs_depth(self) -> Self:
        if self.body is not None and self.depth is None:
            raise ValueError("body says whose depth counts: give depth too")
        return self
