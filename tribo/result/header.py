"""The attributes of a result file, which anyone may have edited."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Final, Literal

import numpy as np
import pydantic_core
from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    TypeAdapter,
    ValidationError,
)

from tribo.core.state import RunInfo

FORMAT: Final = 2
LARGEST = 1e100
"""No quantity comes near it; its square and cube are still finite."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="allow", strict=True)


class _Case(_Table):
    """What is read of a case without the plugins that it was made with."""

    bodies: Annotated[dict[str, dict[str, Any]], Field(min_length=2, max_length=2)]
    contact: dict[str, Any] = {}


class _Origin(_Table):
    type: str
    qualified: Annotated[str, Field(alias="class")]
    distribution: str
    version: str
    editable: bool
    code: str
    config: dict[str, Any]
    facts: dict[str, str]


class _Plugin(_Table):
    distribution: str
    version: str
    status: str
    reason: str


class _Environment(_Table):
    python: str
    packages: dict[str, str]
    components: dict[str, _Origin]
    plugins: list[_Plugin]


class _Provenance(_Environment):
    resumed_with: list[_Environment] = []


def _like(model: type[BaseModel]) -> Callable[[dict[str, Any]], dict[str, Any]]:
    adapter = TypeAdapter(model)

    def check(data: dict[str, Any]) -> dict[str, Any]:
        adapter.validate_python(data)
        return data

    return check


Finite = Annotated[float, Field(gt=-LARGEST, lt=LARGEST)]
Positive = Annotated[float, Field(gt=0, lt=LARGEST)]
_Json = BeforeValidator(pydantic_core.from_json)


class Header(BaseModel):
    """The attributes of a result, as its file has them; JSON is read.

    Parameters
    ----------
    status : str
        ``"done"``, ``"running"``, ``"interrupted"`` or ``"failed"``.
    wall_time_s : float or None
        Time the run took; None while it runs.
    load_N, window_m, modulus_Pa, cap_Pa, curvature_1_m
        Constants of the contact, as `tribo.core.contact.ContactSystem` has them.
    case, provenance : dict
        The configuration; versions and classes.
    notices : list of str
        Warnings given during the run.
    """

    model_config = ConfigDict(strict=True, frozen=True)

    Conventions: str = "CF-1.11"
    title: str = "tribo wear simulation"
    tribo_format: Literal[2] = FORMAT
    status: Literal["done", "running", "interrupted", "failed"]
    wall_time_s: Finite | None = None
    load_N: Positive  # noqa: N815
    window_m: Annotated[list[Positive], Field(min_length=2, max_length=2)]
    modulus_Pa: Positive  # noqa: N815
    cap_Pa: Positive | None = None  # noqa: N815
    curvature_1_m: Annotated[list[Finite], Field(min_length=2, max_length=2)] | None = None
    case: Annotated[dict[str, Any], _Json, AfterValidator(_like(_Case))]
    provenance: Annotated[dict[str, Any], _Json, AfterValidator(_like(_Provenance))]
    notices: Annotated[list[str], _Json]

    @classmethod
    def of_run(cls, run: RunInfo) -> Header:
        """Return the attributes of a run that begins."""
        system = run.system
        return cls.model_construct(
            status="running",
            load_N=system.load,
            window_m=list(system.grid.size),
            modulus_Pa=system.modulus,
            cap_Pa=system.cap,
            curvature_1_m=None if system.curvature is None else list(system.curvature),
            case=dict(run.case),
            provenance=dict(run.provenance),
            notices=[],
        )

    @classmethod
    def read(cls, attributes: Mapping[str, Any]) -> Header:
        """Return the attributes of a file.

        Raises
        ------
        ValueError
            If one is missing or wrong, in one line.
        """
        # A number is a list of one in netCDF.
        plain = {
            name: value if isinstance(value, str) else np.squeeze(value).tolist()
            for name, value in attributes.items()
        }
        try:
            return cls.model_validate(plain)
        except ValidationError as error:
            first = error.errors(include_url=False)[0]
            place = ".".join(map(str, first["loc"]))
            raise ValueError(f"{place!r}: {first['msg']}") from None

    def attributes(self) -> dict[str, Any]:
        """Return what the file gets: numbers, lists and text."""
        return {
            name: json.dumps(value) if name in ("case", "provenance", "notices") else value
            for name, value in self
            if value is not None
        }
