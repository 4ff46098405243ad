"""The attributes of a result file, which anyone may have edited: what they must be."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, BaseModel, Field, ValidationError

from tribo.core.findings import Finding, worn_through
from tribo.core.units import Quantity
from tribo.core.words import checked_name

_JSON = ("case", "provenance", "notices", "worn_through")
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


class _WornThrough(BaseModel):
    body: str
    layer: int
    distance_m: _AtLeast0
    time_s: _AtLeast0


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
    findings: list[Finding] = []
    notices: list[str]
    worn_through: list[_WornThrough]


def findings_attributes(findings: Iterable[Finding]) -> dict[str, str]:
    """Return what a file has of the findings of a run: as data, as sentences, and layers alone."""
    found = list(findings)
    plain: dict[str, Any] = {
        "findings": [asdict(each) for each in found],
        "notices": [str(each) for each in found],
        "worn_through": worn_through(found),
    }
    return {name: json.dumps(values) for name, values in plain.items()}


def read_header(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes of a file with their JSON read; ValueError if one is wrong."""
    plain = {
        name: value.tolist() if isinstance(value, np.ndarray | np.generic) else value
        for name, value in attributes.items()
    }
    plain |= {name: json.loads(plain[name]) for name in _JSON}
    if "findings" in plain:
        plain["findings"] = json.loads(plain["findings"])
    try:
        read = _Header.model_validate(plain)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise ValueError(f"{place!r} is {first['input']!r:.80}: {first['msg']}") from None
    # Older files have the sentences alone.
    older = (notice.partition(": ") for notice in read.notices)
    found = read.findings or [Finding(kind, words) for kind, _, words in older]
    return plain | {"findings": tuple(found)}
