"""What the texts of a result must hold to be read: anybody may have written them."""

from __future__ import annotations

import json
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError, field_validator

from tribo.core.depth import check_depth
from tribo.core.errors import CaseError

T = TypeVar("T")


class _Table(BaseModel):
    model_config = ConfigDict(extra="allow", strict=True)


class StoredCase(_Table):
    """What is read of a case without the plugins it was made with."""

    bodies: dict[str, dict[str, Any]]
    contact: dict[str, Any] = {}

    @field_validator("bodies")
    @classmethod
    def _two(cls, bodies: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
        if len(bodies) != 2:
            raise ValueError(f"two are needed, and there are {len(bodies)}")
        return bodies


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


class StoredProvenance(_Environment):
    """What made a result, and what it was continued with."""

    resumed_with: list[_Environment] = []


def stored(text: str, kind: type[T]) -> Any:
    """Return JSON as plain data that is known to be of a kind.

    Raises
    ------
    ValueError
        If it is not, in one line.
    """
    try:
        data = json.loads(text)
        check_depth(data, "JSON")
        TypeAdapter(kind).validate_python(data)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join(map(str, first["loc"]))
        message = first["msg"].removeprefix("Value error, ")
        raise ValueError(f"{place}: {message}".removeprefix(": ")) from None
    except (RecursionError, CaseError):
        raise ValueError("it is nested too deeply") from None
    return data
