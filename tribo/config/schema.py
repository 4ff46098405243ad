"""The JSON schema of a case, with the installed components."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

from tribo.component import KIND
from tribo.core.errors import warn
from tribo.core.words import said
from tribo.registry.all_plugins import import_all
from tribo.registry.registry import Registry, default_registry

Schema = dict[str, Any]


def json_schema(model: type[BaseModel], registry: Registry | None = None) -> Schema:
    """Return the JSON schema of a table that components are part of, as of `tribo.Case`.

    Each kind of component has a definition of its name, as ``#/$defs/wear_law``: the choice among
    those that the registry has. A component that cannot be imported, or whose own schema cannot be
    made, is left out, with a warning that names its plugin.
    """
    known = registry or default_registry()
    import_all(known)
    whole: Schema = model.model_json_schema()
    defs = whole.setdefault("$defs", {})
    waiting = list(_places(whole))
    for place in waiting:
        kind = place.pop(KIND)
        place["$ref"] = f"#/$defs/{kind}"
        if kind in defs:
            continue
        schemas = {
            name: schema
            for name in known.names(kind)
            if (schema := _schema(known, kind, name)) is not None
        }
        defs |= schemas
        defs[kind] = _choice(schemas)
        for schema in schemas.values():
            waiting += _places(schema)
    return whole


def _choice(schemas: dict[str, Schema]) -> Schema:
    """Return a choice by type, or by name alone of components that need no keys."""
    if not schemas:
        return {"not": {}}
    mapping = {name: f"#/$defs/{name}" for name in schemas}
    choice = {
        "oneOf": [{"$ref": ref} for ref in mapping.values()],
        "discriminator": {"propertyName": "type", "mapping": mapping},
    }
    short = [name for name, schema in schemas.items() if schema["required"] == ["type"]]
    return {"anyOf": [choice, {"type": "string", "enum": short}]} if short else choice


def _schema(registry: Registry, kind: str, name: str) -> Schema | None:
    cls = registry.components[name]
    try:
        schema = cls.model_json_schema(ref_template=f"#/$defs/{name}/$defs/{{model}}")
        json.dumps(schema, allow_nan=False)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        (plugin,) = registry.claimants(name)
        warn(
            f"{kind.replace('_', ' ')} {name!r} of {plugin} is left out: making the schema of its "
            f"configuration raised {said(error)}",
        )
        return None
    schema["required"] = ["type", *(key for key in schema.get("required", []) if key != "type")]
    return schema


def _places(schema: Any) -> Iterator[Schema]:
    """Yield the places in a schema that take any component of a kind."""
    if isinstance(schema, dict):
        if KIND in schema:
            yield schema
        for part in list(schema.values()):
            yield from _places(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from _places(part)
