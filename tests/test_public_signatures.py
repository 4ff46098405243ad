"""What stands in a public signature is a public name."""

import ast
import builtins
import inspect
import re
from collections.abc import Iterator
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path

import pytest

import tribo
from tribo.kernel_api import Model
from tribo.registry import hookspecs

SPECIAL = ("__init__", "__call__", "__getitem__")
KERNEL = {Model}
"""What packages beside the kernel take from `tribo.kernel_api`: the composed case."""


@cache
def own(module: str) -> dict[str, object]:
    """Return what a module of tribo defines, or imports from another, if only as a type."""
    loaded = import_module(module)
    names = {n: value for n, value in vars(loaded).items() if _module(value) == module}
    for node in ast.walk(ast.parse(Path(loaded.__file__).read_text())):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("tribo."):
            source = import_module(node.module)
            names |= {a.asname or a.name: getattr(source, a.name, None) for a in node.names}
        elif isinstance(node, ast.Assign) and isinstance(target := node.targets[0], ast.Name):
            names[target.id] = getattr(loaded, target.id, None)
    return names


def _module(value: object) -> str:
    return str(getattr(value, "__module__", ""))


def is_a_type(value: object) -> bool:
    """Whether it is a class or a type by name, and not merely a number or a text with its marks."""
    marked = re.search("Annotated|Literal", repr(value))
    return inspect.isclass(value) or (hasattr(value, "__args__") and not marked)


def annotations(thing: object) -> Iterator[tuple[str, str, str]]:
    """Yield place, module and annotation of all in the signatures of a function or class."""
    thing = inspect.unwrap(thing) if callable(thing) else thing
    if inspect.isfunction(thing):
        if _module(thing).startswith("tribo."):
            for key, annotation in thing.__annotations__.items():
                yield f"{thing.__qualname__} ({key})", thing.__module__, annotation
        return
    for cls in thing.__mro__ if inspect.isclass(thing) else ():
        if not cls.__module__.startswith("tribo."):
            continue
        for key, annotation in inspect.get_annotations(cls).items():
            if not key.startswith("_"):
                yield f"{cls.__qualname__}.{key}", cls.__module__, annotation
        for member in members(cls):
            yield from annotations(member)


def members(cls: type) -> Iterator[object]:
    """Yield the functions of the public methods and properties of a class."""
    for key, member in vars(cls).items():
        if isinstance(member, property):
            member = member.fget
        elif isinstance(member, cached_property):
            member = member.func
        if key in SPECIAL or not key.startswith("_"):
            yield getattr(member, "__func__", member)


def hidden(thing: object) -> list[str]:
    """Return each type of tribo in the signatures of a name that is no public name."""
    missing = []
    for place, module, annotation in annotations(thing):
        text = str(getattr(annotation, "__forward_arg__", annotation))
        for node in ast.walk(ast.parse(text)):
            name = getattr(node, "id", "")
            value = own(module).get(name)
            public = value in KERNEL or getattr(tribo, name, None) is value
            if is_a_type(value) and not public:
                missing.append(f"{place}: {name}")
    return missing


def raised(thing: object) -> set[str]:
    """Return the errors that a docstring names under *Raises*."""
    text = inspect.getdoc(thing) or ""
    return {
        name.strip()
        for block in re.findall(r"Raises\n-+\n((?:.+\n?)+)", text)
        for line in block.splitlines()
        if not line.startswith(" ")
        for name in line.split(",")
    }


HOOKS = [name for name in vars(hookspecs) if name.startswith("tribo_")]


@pytest.mark.parametrize("name", [*tribo.__all__, *HOOKS])
def test_what_stands_in_a_public_signature_is_a_public_name(name):
    thing = getattr(hookspecs if name in HOOKS else tribo, name)
    assert hidden(thing) == []
    documented = [thing, *(members(thing) if inspect.isclass(thing) else ())]
    errors = set().union(*map(raised, documented))
    assert errors <= {*tribo.__all__, *dir(builtins)}
