"""The attributes of a result file: one description to write and to read them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from tribo.core.contact import ContactSystem
from tribo.core.findings import Finding, as_json
from tribo.core.grid import Grid
from tribo.core.words import checked_name

FORMAT = 2
_JSON = ("case", "provenance", "findings")


def _named(case: dict[str, Any]) -> dict[str, Any]:
    """Return the tables of a case whose bodies may give files their names."""
    if len({checked_name(name) for name in case["bodies"]}) != 2:
        raise ValueError("a case has two bodies")
    return case


class Header(BaseModel):
    """The attributes of a result file, in SI units."""

    model_config = ConfigDict(frozen=True)

    conventions: str = Field("CF-1.11", alias="Conventions")
    title: str = "tribo wear simulation"
    tribo_format: int = FORMAT
    status: Literal["done", "running", "killed", "interrupted", "failed"] = "running"
    load: float = Field(alias="load_N")
    window: tuple[float, float] = Field(alias="window_m")
    modulus: float = Field(alias="modulus_Pa")
    cap: float | None = Field(None, alias="cap_Pa")
    curvature: tuple[float, float] | None = Field(None, alias="curvature_1_m")
    wall_time: float | None = Field(None, alias="wall_time_s")
    case: Annotated[dict[str, Any], AfterValidator(_named)]
    provenance: dict[str, Any]
    findings: tuple[Finding, ...] = ()

    @classmethod
    def read(cls, attributes: Mapping[str, Any]) -> Header:
        """Return the header that the attributes of a file are; ValueError if one is wrong."""
        plain = {
            name: value.tolist() if isinstance(value, np.ndarray | np.generic) else value
            for name, value in attributes.items()
        }
        return cls.model_validate(plain | {name: json.loads(plain[name]) for name in _JSON})

    def attributes(self) -> dict[str, Any]:
        """Return the attributes: numbers, lists and text, some of it JSON."""
        fields = type(self).model_fields.items()
        values = {field.alias or name: getattr(self, name) for name, field in fields}
        values |= {"case": json.dumps(self.case), "provenance": json.dumps(self.provenance)}
        values["findings"] = as_json(self.findings)
        return {name: value for name, value in values.items() if value is not None}

    def system(self, cells: tuple[int, int]) -> ContactSystem:
        """Return the constants of the contact, on so many cells."""
        ends = bool(self.case.get("grid", {}).get("ends_at_window"))
        grid = Grid(self.window, cells, ends)
        return ContactSystem(grid, self.modulus, self.load, self.cap, self.curvature)
