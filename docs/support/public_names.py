"""Write the page of all public names as plain text, from signatures and docstrings."""

from __future__ import annotations

import ast
import dataclasses
import inspect
from collections.abc import Iterator
from functools import cached_property
from importlib import import_module
from itertools import groupby, pairwise
from pathlib import Path
from textwrap import indent
from typing import Any

import reference

import tribo
import tribo.units
from tribo.core.lazy import homes
from tribo.core.table import _docstrings

PAGE = Path(__file__).parents[1] / "reference" / "plugin_api.md"
COMMAND = "python docs/support/public_names.py"
WIDTH = 96
SPECIAL = ("__call__", "__getitem__")
INTRODUCTION = f"""\
<!-- `{COMMAND}` writes this page. -->

# What a plugin may use

Everything that a plugin needs is a name of the package `tribo`, and all of them are here. What
lies in its modules is not part of [the contract](contract.md) and can change without notice.
Examples assume `import numpy as np` and `import tribo`, and the files of the repository.

## Hooks

{{hooks}}

## Kinds of component

{{kinds}}

## Answers of a component

A run holds components to these answers, and `tribo plugins check` tries them. All numbers are
finite. Fields of an effect and states keep the limits of their declaration; where the pressure is
0, a law's depth and the rates of its state are 0; the pressure of a solver carries the load.

{{answers}}
"""


def page() -> Iterator[str]:
    """Yield the page: hooks, kinds and answers in tables, then each public name."""
    yield INTRODUCTION.format(
        hooks="\n".join(reference.hooks_table()),
        kinds="\n".join(reference.kinds_table()),
        answers="\n".join(reference.answers_tables()).rstrip(),
    )
    units = [name for name in tribo.__all__ if hasattr(tribo.units, name)]
    yield f"## Units\n\nFactors to SI: {', '.join(f'`{name}`' for name in units)}.\n"
    places = homes(tribo.__file__)
    names = [name for name in tribo.__all__ if name not in units]
    for module, here in groupby(names, key=places.__getitem__):
        subject = (inspect.getdoc(import_module(module)) or "").splitlines()[0].rstrip(".:")
        yield f"## {subject[0].upper()}{subject[1:]}\n"
        for name in here:
            text = "\n\n".join(described(name, inspect.unwrap(getattr(tribo, name)), module))
            yield f"### `{name}`\n\n```text\n{text}\n```\n"


def described(name: str, thing: Any, module: str) -> Iterator[str]:
    """Yield the signature and the docstring of a name, then those of its members."""
    if inspect.isfunction(thing):
        yield f"{name}{signature(thing)}"
        yield _doc(thing)
    elif not inspect.isclass(thing) or not thing.__module__.startswith("tribo."):
        yield from filter(None, declared(name, module))
    else:
        yield f"class {_header(name, thing)}"
        yield indent(_doc(thing), "    ")
        for text in members(thing):
            yield indent(text, "    ")


def declared(name: str, module: str) -> tuple[str, str]:
    """Return the line of a module that defines a value or a type, and the docstring below it."""
    text = Path(inspect.getfile(import_module(module))).read_text(encoding="utf-8")
    for line, after in pairwise([*ast.parse(text).body, ast.Pass()]):
        if isinstance(line, ast.Assign) and ast.unparse(line.targets[0]) == name:
            below = after.value.value if isinstance(after, ast.Expr) else ""
            return ast.get_source_segment(text, line) or "", inspect.cleandoc(below)
    raise LookupError(f"{module} does not define {name}")


def members(cls: type) -> Iterator[str]:
    """Yield the attributes, properties and methods of a class, and of its bases without a name."""
    bases = [
        base
        for base in reversed(cls.__mro__)
        if base is cls or (base.__module__.startswith("tribo.") and base.__name__ not in NAMES)
    ]
    for number, base in enumerate(bases):
        later = {name for each in bases[number + 1 :] for name in _own_names(each)}
        texts = (
            {} if dataclasses.is_dataclass(base) or issubclass(base, tuple) else _docstrings(base)
        )
        for name, text in texts.items():
            if not name.startswith("_") and text and name not in later:
                yield f"{name}: {base.__annotations__[name]}{_default(base, name)}\n{_body(text)}"
        for name, member in vars(base).items():
            if (name.startswith("_") and name not in SPECIAL) or name in later:
                continue
            if isinstance(member, property | cached_property):
                get = member.fget if isinstance(member, property) else member.func
                yield f"{name}: {get.__annotations__['return']}\n{_body(_doc(get))}"
                continue
            function = getattr(member, "__func__", member)
            kernel = "Model" in getattr(function, "__annotations__", {}).values()
            if inspect.isfunction(function) and _doc(function) and not kernel:
                yield f"{name}{signature(function)}\n{_body(_doc(function))}"


def _own_names(cls: type) -> set[str]:
    return {*vars(cls), *inspect.get_annotations(cls)}


NAMES = frozenset(tribo.__all__)


def signature(function: Any) -> str:
    """Return the signature of a function, a parameter a line if it is long."""
    found = inspect.signature(function)
    parts = [
        each.replace(annotation=_bare(each.annotation), default=_bare(each.default, text=False))
        for each in found.parameters.values()
        if each.name not in ("self", "cls")
    ]
    found = found.replace(parameters=parts, return_annotation=_bare(found.return_annotation))
    text = str(found)
    if len(text) <= WIDTH - 30:
        return text
    lines, star = [], False
    for part in parts:
        if part.kind is part.KEYWORD_ONLY and not star:
            star = True
            lines.append("    *,")
        lines.append(f"    {part},")
    end = text[text.rindex(")") :] if ") -> " in text else ")"
    return "\n".join(["(", *lines, f"){end[1:]}"])


class Bare(str):
    """The text of an annotation or a default, which stands in a signature without quotes."""

    __repr__ = str.__str__


def _bare(value: Any, *, text: bool = True) -> Any:
    """Return what prints as the text of an annotation, or as the name of a function."""
    if inspect.isclass(value) and value is not inspect.Parameter.empty:
        return Bare(value.__name__)
    if inspect.isfunction(value) or repr(value) == "<factory>":
        return Bare("…")
    value = getattr(value, "__forward_arg__", value)
    return Bare(value) if isinstance(value, str) and text else value


def _header(name: str, cls: type) -> str:
    if dataclasses.is_dataclass(cls) or issubclass(cls, tuple):
        return f"{name}{signature(cls).removesuffix(' -> None')}"
    if getattr(vars(cls).get("__init__"), "__module__", "").startswith("tribo."):
        return f"{name}{signature(cls.__init__).removesuffix(' -> None')}"
    base = next((base.__name__ for base in cls.__mro__[1:] if base.__name__ in NAMES), "")
    return f"{name}({base})" if base else name


def _default(cls: Any, name: str) -> str:
    field = getattr(cls, "model_fields", {}).get(name)
    if field is not None:
        if field.is_required() or field.default_factory is not None:
            return ""
        return f" = {field.default!r}"
    value = vars(cls).get(name, dataclasses.MISSING)
    return "" if value is dataclasses.MISSING or callable(value) else f" = {value!r}"


def _doc(thing: Any) -> str:
    return inspect.getdoc(thing) or ""


def _body(text: str) -> str:
    return indent(text, "    ")


if __name__ == "__main__":
    PAGE.write_text("\n".join(page()), encoding="utf-8")
