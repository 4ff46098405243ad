"""The field of a configuration that any plugin's model may fill."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationError
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, InitErrorDetails, PydanticCustomError, core_schema
from pydantic_core.core_schema import SerializationInfo, ValidationInfo

from tribo.component import Component
from tribo.config.schema import slot_schema
from tribo.core.errors import CaseError
from tribo.core.words import said
from tribo.registry.kinds import KINDS
from tribo.registry.registry import Registry, default_registry


@dataclass(frozen=True)
class Slot:
    """Marks a field that takes the configuration of any component of a kind.

    Used as ``Annotated[WearLaw, Slot("wear_law")]``. The field takes a
    configuration, a table whose ``type`` names a component, or that name
    alone. Names are looked up, at validation time, in
    ``context={"registry": …}`` or else in the default registry.

    Parameters
    ----------
    kind : str
        The kind of component, as in `tribo.registry.kinds.KINDS`.
    """

    kind: str

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Return how pydantic validates and serialises the field."""
        words = KINDS[self.kind].words

        def validate(value: object, info: ValidationInfo) -> Component:
            if isinstance(value, source):
                return value  # type: ignore[no-any-return]
            registry = (info.context or {}).get("registry") or default_registry()
            if isinstance(value, str):
                value = {"type": value}
            if not isinstance(value, Mapping):
                text = f"a {words} is needed, as a table with its type; {_choose(registry, self)}"
                raise _error(text)
            config = _config(registry, self, value)
            try:
                return config.__pydantic_validator__.validate_python(  # type: ignore[no-any-return]
                    dict(value), context=info.context
                )
            except (ValidationError, PydanticCustomError, KeyboardInterrupt):
                raise
            except BaseException as error:
                text = f"{value['type']!r} could not read its keys: {said(error)}"
                raise _error(text) from error

        return core_schema.with_info_plain_validator_function(
            validate,
            serialization=core_schema.plain_serializer_function_ser_schema(_dump, info_arg=True),
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Return the choice among the components that the registry has now."""
        return slot_schema(self.kind, handler)


def _config(registry: Registry, slot: Slot, value: Mapping[Any, object]) -> type[Component]:
    if "type" not in value:
        raise _at_type(f"type is missing; {_choose(registry, slot)}", value)
    name = value["type"]
    if not isinstance(name, str):
        raise _at_type(f"type must be text; {_choose(registry, slot)}", name)
    try:
        return registry.lookup(slot.kind, name)
    except CaseError as error:
        raise _at_type(str(error), name) from None


def _choose(registry: Registry, slot: Slot) -> str:
    return f"installed: {registry.choices(slot.kind)}"


def _error(text: str) -> PydanticCustomError:
    return PydanticCustomError("slot", "{message}", {"message": text})


def _at_type(text: str, value: object) -> ValidationError:
    details = InitErrorDetails(type=_error(text), loc=("type",), input=value)
    return ValidationError.from_exception_data("Slot", [details])


def _dump(value: Component, info: SerializationInfo) -> dict[str, Any]:
    return value.model_dump(
        mode=info.mode,
        include=info.include,  # type: ignore[arg-type]
        exclude=info.exclude,  # type: ignore[arg-type]
        context=info.context,
        by_alias=info.by_alias,
        exclude_unset=info.exclude_unset,
        exclude_defaults=info.exclude_defaults,
        exclude_none=info.exclude_none,
        round_trip=info.round_trip,
    )
