"""The JSON schema of a configuration, with the components that are installed now."""

from __future__ import annotations

from contextvars import ContextVar
from typing import Any

from pydantic import BaseModel, GetJsonSchemaHandler, TypeAdapter
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from tribo.config.choices import Choices, Mode, trying
from tribo.registry.registry import Registry, default_registry

_choices: ContextVar[Choices | None] = ContextVar("_choices", default=None)
_begun: ContextVar[frozenset[str]] = ContextVar("_begun", default=frozenset())


def json_schema(
    model: type[BaseModel],
    registry: Registry | None = None,
    mode: Mode = "validation",
) -> dict[str, Any]:
    """Return the JSON schema of a configuration.

    A component that cannot be imported, or whose own schema cannot be made,
    is left out of the choices, with a warning that names its plugin.

    Parameters
    ----------
    model : type
        A pydantic model, with slots anywhere in it.
    registry : Registry, optional
        The components that slots may take; the installed ones if left out.
    mode : str
        The schema of what is read (``"validation"``) or of what is written.
    """
    token = _choices.set(Choices(registry or default_registry(), mode))
    try:
        return model.model_json_schema(mode=mode)
    finally:
        _choices.reset(token)


def slot_schema(kind: str, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
    """Return the choice among the components of one kind.

    It is made anew each time, and so follows the registry.
    """
    if trying.get():
        return {}
    configs = (_choices.get() or Choices(default_registry(), handler.mode)).of(kind)
    if not configs:
        return {"not": {}}
    schemas = {name: TypeAdapter(config).core_schema for name, config in configs.items()}
    refs = {name: _ref(schema) for name, schema in schemas.items()}
    # A configuration may have a slot into which it fits itself: then it is only referred to.
    begun = _begun.get()
    choices = {
        name: schema
        if refs[name] not in begun
        else core_schema.definition_reference_schema(refs[name])
        for name, schema in schemas.items()
    }
    token = _begun.set(begun | set(refs.values()))
    try:
        choice = handler(core_schema.tagged_union_schema(choices, "type"))
    finally:
        _begun.reset(token)
    for name, ref in choice["discriminator"]["mapping"].items():
        if refs[name] not in begun:
            _require_type(handler.resolve_ref_schema({"$ref": ref}))
    short = [name for name, config in configs.items() if _needs_nothing(config)]
    if handler.mode == "serialization" or not short:
        return choice
    return {"anyOf": [choice, {"type": "string", "enum": short}]}


def _require_type(schema: JsonSchemaValue) -> None:
    schema["required"] = ["type", *(key for key in schema.get("required", []) if key != "type")]


def _needs_nothing(config: type[BaseModel]) -> bool:
    return not any(field.is_required() for field in config.model_fields.values())


def _ref(schema: CoreSchema) -> str:
    """Return the name under which pydantic keeps the definition of a model."""
    inner: Any = schema["schema"] if schema["type"] == "definitions" else schema
    return str(inner["schema_ref"] if inner["type"] == "definition-ref" else inner["ref"])
