"""How a run moves on in time: a closed, built-in choice."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from tribo.core.table import Table
from tribo.core.units import Quantity


def _type_required(schema: dict[str, Any]) -> None:
    # It has a default for those who make objects; in a case it tells the two apart.
    schema.setdefault("required", []).append("type")


class Implicit(Table):
    """Backward Euler, with increments chosen by error; stable at any length."""

    model_config = ConfigDict(json_schema_extra=_type_required)

    type: Literal["implicit"] = "implicit"
    depth_tolerance: Annotated[float, Quantity("1", above=0, at_most=0.1)] = 1e-3
    """Largest local error of the wear depth in one step, relative to the depth worn so far; five
    times as much is allowed of the volume, relative to what the step wears."""
    pressure_tolerance: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.05
    """Largest load-weighted relative change of pressure in one step."""
    settle: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.01
    """Length of the last step before a save, relative to the distance slid by then."""
    nonlinear_tolerance: Annotated[float, Quantity("1", above=0, at_most=1e-3)] = 1e-8
    """How exactly a step fulfils backward Euler for a law that is not linear in pressure."""
    max_passes: Annotated[int, Field(ge=1, le=1000)] = 60
    """Solves a step may take to do so; more rejects it."""


class Explicit(Table):
    """Forward Euler with a fixed time step, as in the paper; limited by stability."""

    model_config = ConfigDict(json_schema_extra=_type_required)

    type: Literal["explicit"] = "explicit"
    time_step: Annotated[float, Quantity("s", above=0)]
    """Length of a step."""
    allow_unstable: bool = False
    """Go on beyond the stability limit, at your own risk."""


Stepping = Annotated[Implicit | Explicit, Field(discriminator="type")]
