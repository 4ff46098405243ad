"""The attributes of a result file, which anyone may have edited: what they must be."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BaseModel, Field, ValidationError

from tribo.core.findings import Finding, worn_through
from tribo.core.units import Quantity
from tribo.core.words import checked_name

_JSON = ("case", "provenance", "findings")
_Positive = Annotated[float, Quantity("1", above=0)]
_AtLeast0 = Annotated[float, Quantity("1", at_least=0)]
_Name = Annotated[str, AfterValidator(checked_name)]


class _Layer(BaseModel):
    thickness: _Positive


class _Body(BaseModel):
    layers: list[_Layer] = []


class _Case(BaseModel):
    grid: dict[str, Any] = {}
    load: dict[str, Any] = {}
    kinematics: dict[str, Any] = {}
    bodies: Annotated[dict[_Name, _Body], Field(min_length=2, max_length=2)]


class _Origin(BaseModel):
    type: str
    whose: str = Field(alias="class")
    distribution: str
    version: str
    editable: bool
    code: str
    config: dict[str, Any]
    facts: dict[str, str]


class _Plugin(BaseModel):
    distribution: str
    version: str
    status: str
    reason: str


class _Begun(BaseModel):
    result: str
    sha256: str


class _Made(BaseModel):
    python: str
    packages: dict[str, str]
    components: dict[str, _Origin]
    plugins: list[_Plugin]
    begun_with: _Begun | None = None


class _Provenance(_Made):
    resumed_with: list[_Made] = []


class _Header(BaseModel):
    status: Literal["done", "running", "killed", "interrupted", "failed"]
    load: _Positive = Field(alias="load_N")
    window: tuple[_Positive, _Positive] = Field(alias="window_m")
    modulus: _Positive = Field(alias="modulus_Pa")
    cap: _Positive | None = Field(None, alias="cap_Pa")
    curvature: tuple[_AtLeast0, _AtLeast0] | None = Field(None, alias="curvature_1_m")
    wall_time: _AtLeast0 | None = Field(None, alias="wall_time_s")
    case: _Case
    provenance: _Provenance
    findings: list[Finding]


def read_header(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes of a file with their JSON read; ValueError if one is wrong."""
    plain = {
        name: value.tolist() if isinstance(value, np.ndarray | np.generic) else value
        for name, value in attributes.items()
    }
    if "findings" not in plain:
        # An older file has sentences alone.
        words = json.loads(plain["notices"])
        plain["findings"] = json.dumps([{"kind": "notice", "words": each} for each in words])
    plain |= {name: json.loads(plain[name]) for name in _JSON}
    try:
        read = _Header.model_validate(plain)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise ValueError(f"{place!r} is {first['input']!r:.80}: {first['msg']}") from None
    found = tuple(read.findings)
    return plain | {"findings": found, "worn_through": worn_through(found)}
