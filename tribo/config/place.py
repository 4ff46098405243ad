"""Where in a case an error is, and what the models say about that place."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from tribo.component import Component
from tribo.config.slot import Slot
from tribo.core.errors import CaseError
from tribo.registry.registry import Registry

Key = str | int


@dataclass(frozen=True)
class Place:
    """A place in a case.

    Parameters
    ----------
    keys : tuple
        The keys and indices that lead there.
    annotation : object
        The type that is declared for it; Any where that is not known.
    metadata : tuple
        What ``Annotated`` adds to that type.
    table : type, optional
        The model of the table that it is in.
    siblings : frozenset of str
        The keys that are given in that table.
    """

    keys: tuple[Key, ...]
    annotation: Any
    metadata: tuple[Any, ...]
    table: type[BaseModel] | None
    siblings: frozenset[str]

    @classmethod
    def of(
        cls, error: ErrorDetails, model: type[BaseModel], data: object, registry: Registry
    ) -> Place:
        """Return the place of an error that pydantic found in `data`.

        Pydantic's own location also has marks of the alternatives it tried;
        they are left out.
        """
        here = cls((), model, (), None, frozenset())
        value = data
        last = len(error["loc"]) - 1
        for index, key in enumerate(error["loc"]):
            table = _table(here.annotation, here.metadata, value, registry)
            found, inner = _get(value, key)
            if index == last and error["type"] == "slot":
                # Not where a name alone stands for a table with its type.
                belongs = found or isinstance(value, Mapping)
            elif index == last and error["type"] == "missing":
                belongs = True
            else:
                belongs = found or (table is not None and key in _fields(table))
            if not belongs:
                continue
            annotation, metadata = _inside(here.annotation, table, key)
            given = frozenset(map(str, value)) if isinstance(value, Mapping) else frozenset()
            here = cls((*here.keys, key), annotation, metadata, table, given)
            value = inner
        return here

    @property
    def path(self) -> str:
        """The place as text, as ``effects[1].type``."""
        return _path(self.keys)

    @property
    def key(self) -> Key:
        """The last of the keys."""
        return self.keys[-1]

    def beside(self, key: str) -> str:
        """Return the path of another key of the same table."""
        return _path((*self.keys[:-1], key))

    def fields(self) -> list[str]:
        """Return the keys that the table may have."""
        if self.table is None:
            return []
        named = ["type"] if issubclass(self.table, Component) else []
        return [*named, *_fields(self.table)]

    def tags(self) -> list[str]:
        """Return the types among which this place chooses."""
        models = [m for m, _ in _alternatives(self.annotation) if _is_model(m)]
        return [str(model.model_fields["type"].default) for model in models]


def _path(keys: Sequence[Key]) -> str:
    text = ""
    for key in keys:
        if isinstance(key, int):
            text += f"[{key}]"
        else:
            plain = key.replace("_", "").replace("-", "").isalnum()
            text += ("." if text else "") + (key if plain else f'"{key}"')
    return text


def _get(value: object, key: Key) -> tuple[bool, object]:
    if isinstance(value, Mapping) and key in value:
        return True, value[key]
    if isinstance(value, list | tuple) and isinstance(key, int) and key < len(value):
        return True, value[key]
    return False, None


def _fields(table: type[BaseModel]) -> dict[str, FieldInfo]:
    return {field.alias or name: field for name, field in table.model_fields.items()}


def _alternatives(
    annotation: Any, metadata: tuple[Any, ...] = ()
) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """Yield the types that a union or an annotated type consists of, with their metadata."""
    origin = get_origin(annotation)
    if origin is Annotated:
        base, *more = get_args(annotation)
        yield from _alternatives(base, (*metadata, *more))
    elif origin in (Union, UnionType):
        for member in get_args(annotation):
            yield from _alternatives(member, metadata)
    else:
        yield annotation, metadata


def _is_model(annotation: Any) -> bool:
    return inspect.isclass(annotation) and issubclass(annotation, BaseModel)


def _table(
    annotation: Any, metadata: tuple[Any, ...], value: object, registry: Registry
) -> type[BaseModel] | None:
    """Return the model that `value` is validated as, if it is one table."""
    tag = value.get("type") if isinstance(value, Mapping) else value
    models: list[type[BaseModel]] = []
    for member, marks in _alternatives(annotation, metadata):
        slot = next((mark for mark in marks if isinstance(mark, Slot)), None)
        if slot is not None and isinstance(tag, str):
            try:
                return registry.lookup(slot.kind, tag)
            except CaseError:
                return None
        if slot is None and _is_model(member):
            models.append(member)
    if len(models) == 1:
        return models[0]
    for model in models:
        if "type" in model.model_fields and model.model_fields["type"].default == tag:
            return model
    return None


def _inside(
    annotation: Any, table: type[BaseModel] | None, key: Key
) -> tuple[Any, tuple[Any, ...]]:
    """Return the declared type and its metadata of what lies under `key`."""
    if table is not None:
        field = _fields(table).get(str(key))
        return (field.annotation, tuple(field.metadata)) if field else (Any, ())
    for member, _ in _alternatives(annotation):
        origin, inner = get_origin(member), get_args(member)
        if not (inspect.isclass(origin) and inner):
            continue
        if issubclass(origin, Mapping):
            return inner[1], ()
        if issubclass(origin, tuple) and inner[-1] is not Ellipsis:
            return (inner[key], ()) if isinstance(key, int) and key < len(inner) else (Any, ())
        if issubclass(origin, Sequence):
            return inner[0], ()
    return Any, ()
