"""What a plugin hands over, held to the contract."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from tribo.component import Component
from tribo.core.fields import Field, name_fault
from tribo.registry.kinds import kind_of

Classes = dict[str, type[Component]]
"""Classes by the name in a case."""


def offered(answers: Iterable[object]) -> Classes:
    """Return the classes that the answers to `tribo_components` hold, by name.

    Raises
    ------
    TypeError, ValueError
        If an answer is no list, holds what is no component, or a name twice.
    """
    found: Classes = {}
    for answer in answers:
        if not isinstance(answer, Iterable):
            raise TypeError(
                f"tribo_components returns {answer!r}; it must return a list of classes"
            )
        for cls in answer:
            _check_declarations(cls, kind_of(cls).interface)
            if cls.type in found:
                raise ValueError(f"tribo_components returns {cls.type!r} twice")
            found[cls.type] = cls
    return found


def _check_declarations(cls: Any, interface: type) -> None:
    """Raise TypeError unless what a class declares of fields is declared as it must be."""
    shown = cls.__qualname__
    needed = 'a tuple of Field, as in (Field("name", "m", "What it means."),)'
    for attribute in ("state_fields", "provides"):
        if attribute in interface.__annotations__ and not hasattr(cls, attribute):
            raise TypeError(f"{shown} does not define {attribute}, {needed}")
        fields = getattr(cls, attribute, ())
        if not (isinstance(fields, tuple | list) and all(isinstance(f, Field) for f in fields)):
            raise TypeError(f"{shown}.{attribute} is {fields!r}; it must be {needed}")
        if fault := name_fault(fields):
            raise TypeError(f"{shown}.{attribute}: {fault}")
    names = getattr(cls, "requires", ())
    if not (isinstance(names, tuple | list) and all(isinstance(name, str) for name in names)):
        raise TypeError(
            f'{shown}.requires is {names!r}; it must be a tuple of names, as in ("temperature",)'
        )
