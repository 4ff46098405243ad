"""The base of every model, and the look-up of its class by the name in a case."""

from __future__ import annotations

import re
from abc import ABC
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import (
    BaseModel,
    GetCoreSchemaHandler,
    SerializerFunctionWrapHandler,
    ValidationError,
    ValidationInfo,
    model_serializer,
    model_validator,
)
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from tribo.core.column import Column
from tribo.core.errors import CaseError
from tribo.core.explain import refused, told
from tribo.core.fields import Field, check_declared
from tribo.core.shorthand import call
from tribo.core.table import Table
from tribo.core.words import said

if TYPE_CHECKING:
    from tribo.core.findings import Finding
    from tribo.core.state import Snapshot


class Component(Table, ABC):
    """A model: its fields are its configuration, its methods its physics.

    It is frozen and refuses unknown keys. It may cache values in private attributes, but never
    keeps what evolves in a run.

    A field declared as one of the interfaces (`WearLaw`, `Surface`, …) takes any component of that
    kind: an object, a table whose ``type`` names its class, or that name alone. Names are looked up
    in ``context={"registry": …}`` of the validation, or else among the installed plugins.

    Examples
    --------
    >>> law = tribo.Archard(k="1e-6 mm^3/(N m)")
    >>> law.kind(), law.type, law.k  # k in 1/Pa
    ('wear_law', 'archard', 1e-15)
    """

    type: ClassVar[str]
    """The name that stands for the class in a case; its own in snake case if left out."""

    material_properties: ClassVar[tuple[Field, ...]] = ()
    """What it needs of its body's material, or of both materials if it belongs to no body. Each is
    the name of a key of `Material`, or of one of its `properties`, which a case then gives."""

    examples: ClassVar[Sequence[Mapping[str, Any]]] = ()
    """Configurations with which the conformance kit tries it."""

    columns: ClassVar[Sequence[Column]] = ()
    """Numbers that the result has at each step and save beside its own, read off a `Snapshot`."""

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        """Check its fields, and name a class that has no name after itself, as ``hot_wear``."""
        check_declared(cls, cls.__qualname__)
        if Component not in cls.__bases__ and not hasattr(cls, "type"):
            cls.type = _snake_case(cls.__name__)

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
    def kind(cls) -> str:
        """Return its kind: the name of its interface in snake case, as ``"wear_law"``."""
        interface = next(base for base in cls.__mro__ if Component in base.__bases__)
        return _snake_case(interface.__name__)

    @classmethod
    def hint(cls, info: ValidationInfo) -> str:
        """Return the names of the installed components of its kind, as text."""
        return f"installed: {registry_of(info).choices(cls.kind())}"

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Let an interface take any component of its kind."""
        # Component itself does not exist yet where this is first asked.
        if Table in cls.__bases__ or Component not in cls.__bases__:
            return handler(source)
        return core_schema.with_info_plain_validator_function(cls._find)

    @classmethod
    def _find(cls, value: object, info: ValidationInfo) -> Component:
        if isinstance(value, cls):
            return value
        table = {"type": value} if isinstance(value, str) else value
        if not isinstance(table, Mapping):
            words = cls.kind().replace("_", " ")
            raise told(f"give the {words} as a table with its type; {cls.hint(info)}")
        name = table.get("type")
        if not isinstance(name, str):
            fault = "must be text" if "type" in table else "missing"
            raise refused((("type",), f"{fault}; {cls.hint(info)}", name))
        try:
            found = registry_of(info).lookup(cls.kind(), name)
        except CaseError as error:
            if isinstance(value, str):
                raise told(str(error)) from None
            raise refused((("type",), str(error), name)) from None
        try:
            return found.__pydantic_validator__.validate_python(  # type: ignore[no-any-return]
                dict(table), context=info.context
            )
        except (ValidationError, PydanticCustomError, KeyboardInterrupt):
            raise
        except BaseException as error:
            raise told(f"{name!r} could not read its keys: {said(error)}") from error

    def __eq__(self, other: object) -> bool:
        """Whether class and configuration are the same; caches do not count."""
        return type(self) is type(other) and dict(self) == dict(other)

    def __hash__(self) -> int:
        return hash((type(self), *(value for _, value in self)))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).model_validate, (dict(self),)

    def facts(self) -> Mapping[str, str]:
        """Return facts that a user should see before a run, such as how a file was read.

        They are texts by name, as in ``{"size": "1.24 × 0.94 mm"}``. ``tribo check`` shows them,
        every result keeps them, and a run does not resume where they have changed.
        """
        return {}

    def findings(self, snapshot: Snapshot) -> Sequence[Finding]:
        """Return findings on an accepted step, such as a limit that is passed.

        Each kind is said once, with the time and place from which on it holds: as a warning on the
        terminal, and in the findings of the result. One of the kind ``"stop"`` ends the run after
        this step.

        Parameters
        ----------
        snapshot : Snapshot
            The state, its scalars and the fields of the effects.
        """
        return ()


def components(table: BaseModel) -> Iterator[tuple[str, Component]]:
    """Yield every component in a table with its place there, those within others too."""
    for name, value in table:
        parts = {name: value}
        if isinstance(value, Mapping):
            parts = {f"{name}.{key}": part for key, part in value.items()}
        elif isinstance(value, tuple | list):
            parts = {f"{name}.{at}": part for at, part in enumerate(value, 1)}
        for place, part in parts.items():
            if isinstance(part, Component):
                yield place, part
            if isinstance(part, BaseModel):
                yield from ((f"{place}.{inner}", each) for inner, each in components(part))


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def registry_of(info: ValidationInfo) -> Any:
    """Return the registry of a validation, or else the registry of the installed plugins."""
    context = info.context if isinstance(info.context, Mapping) else {}
    return context.get("registry") or call("registry")
