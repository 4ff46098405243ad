"""The base of every table in a case."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import pairwise
from textwrap import dedent
from typing import TYPE_CHECKING, Any, ClassVar, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    ModelWrapValidatorHandler,
    ValidationError,
    ValidationInfo,
    model_validator,
)

from tribo.core.errors import CaseError
from tribo.core.explain import case_error, explained
from tribo.core.units import quantities, stated

if TYPE_CHECKING:
    from pydantic._internal._model_construction import ModelMetaclass
else:
    ModelMetaclass = type(BaseModel)


class _TableClass(ModelMetaclass):
    """The class of tables: made in Python, they word errors as for a case."""

    def __call__(self, *values: Any, **named: Any) -> Any:
        made: Any = self
        if values and not made.in_order:
            name, key = made.__name__, next(iter(made.model_fields), "key")
            raise TypeError(f"give each value of {name} by its name, as {name}({key}=…)")
        try:
            return super().__call__(**dict(zip(made.model_fields, values, strict=False)), **named)
        except ValidationError as error:
            raise case_error(error) from None


class Table(BaseModel, metaclass=_TableClass):
    """A frozen table that refuses unknown keys, and explains errors in the words of a case.

    Examples
    --------
    >>> class Spring(tribo.Table):
    ...     stiffness: float
    >>> try:
    ...     Spring(stifness=2.0)
    ... except tribo.CaseError as error:
    ...     print(error)
    stifness: unknown key; did you mean 'stiffness'? Allowed: stiffness
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    in_order: ClassVar[bool] = False
    """Whether it may be made of values without their names, in the order of its fields."""

    @model_validator(mode="wrap")
    @classmethod
    def _in_plain_words(
        cls, data: Any, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo
    ) -> Self:
        try:
            return handler(data)
        except ValidationError as error:
            raise explained(error, cls, data, info) from None

    @classmethod
    def hint(cls, info: ValidationInfo) -> str:
        """Return the keys that it needs, as the end of a message."""
        needed = [name for name, field in cls.model_fields.items() if field.is_required()]
        return f"a table with {' and '.join(needed)} is needed"

    def __setattr__(self, name: str, value: Any) -> None:
        try:
            super().__setattr__(name, value)
        except ValidationError:
            raise CaseError("stays; make another case by with_values", name) from None

    def __repr_args__(self) -> Iterator[tuple[str | None, Any]]:
        """Yield the fields that are not at their defaults."""
        yield from given(self).items()


def given(table: BaseModel) -> dict[str, Any]:
    """Return the values of a table that are not at their defaults, by field."""
    fields = type(table).model_fields
    return {name: value for name, value in table if value != fields[name].default}


def about(cls: type) -> str:
    """Return the docstring of a class without its example in Python; empty if it has none."""
    text = inspect.cleandoc(cls.__doc__) if isinstance(cls.__doc__, str) else ""
    return text.partition("\n\nExamples\n---")[0]


def descriptions(table: type[BaseModel]) -> dict[str, str]:
    """Return the descriptions of fields by name, given to `Field` or as docstrings.

    Docstrings of fields are read from the source on demand: pydantic would read the source of every
    class when it is made, which takes long.
    """
    texts: dict[str, str] = {}
    for base in reversed(table.__mro__):
        if issubclass(base, BaseModel):
            texts |= _docstrings(base)
    for name, field in table.model_fields.items():
        if field.description:
            texts[name] = field.description
    return {name: texts[name] for name in table.model_fields if texts.get(name)}


@cache
def _docstrings(cls: type) -> dict[str, str]:
    """Return the docstrings of the fields that a class declares; empty for one without any."""
    try:
        (declaration,) = ast.parse(dedent(inspect.getsource(cls))).body
    except (OSError, TypeError, SyntaxError, ValueError):
        return {}
    assert isinstance(declaration, ast.ClassDef)
    texts = {}
    for declared, after in pairwise([*declaration.body, ast.Pass()]):
        if isinstance(declared, ast.AnnAssign) and isinstance(declared.target, ast.Name):
            texts[declared.target.id] = ""
            match after:
                case ast.Expr(ast.Constant(str(text))):
                    texts[declared.target.id] = inspect.cleandoc(text)
    return texts


def tree(table: BaseModel) -> str:
    """Return a table as lines: its numbers beside its name, the tables in it indented below."""
    return "\n".join(_lines(type(table).__name__, table))


def _lines(name: str, value: Any, depth: int = 0) -> Iterator[str]:
    inside: dict[str, Any] = {}
    beside = [value.type] if hasattr(value, "type") else []
    if isinstance(value, BaseModel):
        fields = type(value).model_fields
        for key, inner in given(value).items():
            if _is_table(inner):
                inside[key] = inner
            else:
                beside.append(f"{key} {_text(inner, fields[key])}")
    else:
        pairs = value.items() if isinstance(value, Mapping) else enumerate(value, 1)
        inside = {str(key): inner for key, inner in pairs}
    yield "  " * depth + f"{name}: {', '.join(beside)}".removesuffix(": ")
    for key, inner in inside.items():
        yield from _lines(key, inner, depth + 1)


def _is_table(value: Any) -> bool:
    if isinstance(value, Mapping):
        return True
    inner = value[:1] if isinstance(value, tuple) else (value,)
    return any(isinstance(each, BaseModel) for each in inner)


def _text(value: Any, field: Any) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(_text(each, field) for each in value)}]"
    unit = next((mark.unit for mark in quantities(field)), "1")
    return stated(value, unit) if isinstance(value, float) else str(value)
