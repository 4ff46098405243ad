"""What a plugin hands over, held to the contract."""

from __future__ import annotations

from collections.abc import Iterable

from tribo.component import Component
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
            if "provides" in kind_of(cls).interface.__annotations__ and not hasattr(
                cls, "provides"
            ):
                raise TypeError(
                    f"{cls.__qualname__} does not define provides, a tuple of Field, as in "
                    '(Field("name", "m", "What it means."),)'
                )
            if cls.type in found:
                raise ValueError(f"tribo_components returns {cls.type!r} twice")
            found[cls.type] = cls
    return found
