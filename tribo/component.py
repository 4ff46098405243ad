"""What every model has in common: fields that configure it, and a name for files."""

from __future__ import annotations

import re
from abc import ABC
from collections.abc import Mapping
from typing import Any, ClassVar

from pydantic import (
    BaseModel,
    ConfigDict,
    GetJsonSchemaHandler,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema


class Component(BaseModel, ABC):
    """A model: its fields are its configuration, its methods its physics.

    It is frozen and knows all its keys. What it caches is private and changes
    no answer; what evolves in a run is never kept in it.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, use_attribute_docstrings=True)

    type: ClassVar[str]
    """The name that stands for the class in a case; its own in snake case if left out."""

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        """Name a class that does not name itself after itself, as in ``hot_wear``."""
        if Component not in cls.__bases__ and not hasattr(cls, "type"):
            cls.type = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", cls.__name__).lower()

    @model_validator(mode="before")
    @classmethod
    def _without_its_type(cls, data: Any) -> Any:
        if isinstance(data, Mapping) and data.get("type") == getattr(cls, "type", None):
            return {key: value for key, value in data.items() if key != "type"}
        return data

    @model_serializer(mode="wrap")
    def _with_its_type(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return {"type": self.type, **handler(self)}

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Add the name to the schema of the fields."""
        made = handler.resolve_ref_schema(handler(schema))
        named = {"const": cls.type, "default": cls.type, "title": "Type", "type": "string"}
        made["properties"] = {"type": named, **made.get("properties", {})}
        return made

    def __eq__(self, other: object) -> bool:
        """Whether both are of one class and configured alike; what they cache does not count."""
        return type(self) is type(other) and dict(self) == dict(other)

    def __hash__(self) -> int:
        return hash((type(self), *(value for _, value in self)))

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to another process as a class and its configuration."""
        return type(self).model_validate, (dict(self),)

    def facts(self) -> Mapping[str, str]:
        """Return what a user ought to see before a run, such as what a file was read as.

        ``tribo check`` shows it, every result keeps it, and a run does not
        resume where it has changed.

        Returns
        -------
        Mapping[str, str]
            Text by its name, as in ``{"size": "1.24 × 0.94 mm"}``.
        """
        return {}
