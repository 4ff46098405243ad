"""Write reference pages from the models, the registry and the commands themselves."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator, Mapping
from importlib import import_module
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import click
from annotated_types import Ge, Gt, Le, Lt
from click.testing import CliRunner
from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from tribo.case import Body, Case
from tribo.cli.commands import imported, offered
from tribo.cli.main import tribo as command_line
from tribo.component import Component
from tribo.contract import ANSWERS
from tribo.core.errors import (
    CaseError,
    Interrupted,
    NumericalError,
    OutputError,
    PluginError,
    ReaderGone,
)
from tribo.core.table import descriptions
from tribo.core.units import _KINDS, _SYMBOLS, _UNPREFIXED, PREFIXES, Quantity
from tribo.packages import COMMANDS
from tribo.registry import hookspecs
from tribo.registry.kinds import KINDS
from tribo.registry.registry import Registry
from tribo.result.columns import BODY_COLUMNS, COLUMNS
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit

PLUGINS = Path(__file__).parents[2] / "plugins"


def write(folder: Path) -> None:
    """Write every generated page to `folder`."""
    folder.mkdir(exist_ok=True)
    pages = {
        "case": "\n".join(case_page(Registry.with_plugins())),
        "plugin_keys": "\n".join(plugin_keys()),
        "units": "\n".join(units_table()),
        "commands": "\n".join(commands_page()),
        "exit_codes": "\n".join(exit_codes()),
        "columns": "\n".join(columns_table()),
        "hooks": "\n".join(hooks_table()),
        "kinds": "\n".join(kinds_table()),
    }
    for name, text in pages.items():
        (folder / f"{name}.md").write_text(text + "\n", encoding="utf-8")


def case_page(registry: Registry) -> Iterator[str]:
    """Yield the reference of a case: each table, then each component that may stand in it."""
    plain = {n: f for n, f in Case.model_fields.items() if not _is_table(f)}
    if plain:
        yield "## Keys before any table\n"
        yield from _rows(Case, plain)
    for name, field in Case.model_fields.items():
        if name in plain:
            continue
        path = "bodies.NAME" if name == "bodies" else name
        kind = _component_kind(field)
        many = "[[{}]]" if get_origin(field.annotation) is tuple else "[{}]"
        yield f"## `{many.format(path)}`\n"
        yield from _about(name, field)
        if name == "bodies":
            yield from _table(Body)
            yield f"### `[{path}.material]`\n"
            material = Body.model_fields["material"].annotation
            yield f"{_summary(material)}\n"
            yield from _table(material)
            for slot in ("surface", "wear"):
                yield f"### `[{path}.{slot}]`\n"
                yield f"{descriptions(Body)[slot]}\n"
                yield from _components(registry, _component_kind(Body.model_fields[slot]), "####")
        elif name == "stepping":
            for config in (Implicit, Explicit):
                yield f'### `type = "{config.model_fields["type"].default}"`\n'
                yield f"{_summary(config)}\n"
                yield from _table(config)
        elif kind:
            yield from _components(registry, kind, "###")
        else:
            model = _model(field.annotation)
            yield f"{_summary(model)}\n"
            yield from _table(model)


def plugin_keys() -> Iterator[str]:
    """Yield the components of the packages in `plugins`, with their keys."""
    built_in = set(Registry.with_plugins().components)
    for folder in sorted(PLUGINS.iterdir()):
        package = folder.name.replace("-", "_")
        source = str(folder / "src")
        if not Path(source, package, "plugin.py").is_file():
            continue
        yield f"## {folder.name}\n"
        sys.path.insert(0, source)
        try:
            registry = Registry.with_plugins(import_module(f"{package}.plugin"))
        except ImportError as error:
            yield f"It was not installed with what it needs where this page was built: {error}.\n"
            continue
        finally:
            sys.path.remove(source)
        for name in sorted(set(registry.components) - built_in):
            cls = registry.components[name]
            yield f'### `type = "{cls.type}"`\n'
            kind = cls.kind().replace("_", " ")
            yield f"{'An' if kind[0] in 'aeo' else 'A'} {kind}. {_prose(cls)}\n"
            yield from _table(cls)


def units_table() -> Iterator[str]:
    """Yield the kinds of quantity with an example of each, and the known symbols."""
    yield "| Quantity | SI unit | Example |\n| --- | --- | --- |"
    for unit, (name, example) in _KINDS.items():
        yield f'| {name.removeprefix("an ").removeprefix("a ")} | {unit} | `"{example}"` |'
    symbols = ", ".join(f"`{symbol}`" for symbol in _SYMBOLS)
    plain = ", ".join(f"`{symbol}`" for symbol in _UNPREFIXED if symbol != "1")
    prefixes = ", ".join(f"`{p}` (10{_superscript(e)})" for p, e in PREFIXES.items())
    yield f"\nSymbols that take a prefix: {symbols}. Without a prefix: {plain}; and `degC`, alone."
    yield f"Prefixes: {prefixes}; `µ` stands for `u`."


def commands_page() -> Iterator[str]:
    """Yield the help of every command."""
    for name, entry in offered().items():
        command = imported(entry)
        yield f"## `tribo {name}`\n"
        if name in COMMANDS:
            yield f"It comes with {COMMANDS[name][0]}.\n"
        parts = [[name]]
        if isinstance(command, click.Group):
            parts += [[name, part] for part in command.commands]
        for words in parts:
            yield f"```text\n$ tribo {' '.join(words)} --help\n{_help(words)}```\n"


def exit_codes() -> Iterator[str]:
    """Yield the exit codes, from the errors that have them."""
    yield "| Code | Raised as | Meaning |\n| --- | --- | --- |"
    yield "| 0 | | Done. |"
    yield "| 1 | any other exception | A fault in tribo, or in a command of a package. |"
    for error in (CaseError, NumericalError, PluginError, OutputError, Interrupted):
        yield f"| {error.exit_code} | `{error.__name__}` | {_summary(error)} |"
    yield f"| {ReaderGone.exit_code} | | {_summary(ReaderGone)} |"


def columns_table() -> Iterator[str]:
    """Yield the scalars of each save and each step."""
    yield "| Variable | Unit | Meaning |\n| --- | --- | --- |"
    for column in COLUMNS:
        yield f"| `{column.name}` | {column.unit} | {column.description}. |"
    for part in BODY_COLUMNS:
        yield f"| `{part.name}` of a body | {part.unit} | {part.description}. |"


def hooks_table() -> Iterator[str]:
    """Yield the hooks with what they return."""
    yield "| Hook | What it does |\n| --- | --- |"
    for name, hook in vars(hookspecs).items():
        if name.startswith("tribo_"):
            arguments = ", ".join(inspect.signature(hook).parameters)
            yield f"| `{name}({arguments})` | {_summary(hook)} |"


def kinds_table() -> Iterator[str]:
    """Yield the base classes of components with the subject of each."""
    yield "| Base class | What it is |\n| --- | --- |"
    for base in KINDS.values():
        module = inspect.getmodule(base)
        subject = (inspect.getdoc(module) or "").splitlines()[0]
        yield f"| `{base.__name__}` | {subject} |"


def answers_tables() -> Iterator[str]:
    """Yield what a component of each kind must answer, as the guard in a run holds it."""
    for kind, answers in ANSWERS.items():
        yield f"`{KINDS[kind].__name__}`\n"
        yield "| Answer | Meaning | Unit | Shape | Limits |\n| --- | --- | --- | --- | --- |"
        for answer in answers:
            shape = f"broadcasts to {answer.shape}" if answer.spreads else answer.shape
            cells = (answer.description, answer.unit, shape or "a number", answer.limits)
            yield f"| `{answer.name}` | {' | '.join(cells)} |"
        yield ""


def _help(words: list[str]) -> str:
    result = CliRunner().invoke(
        command_line, [*words, "--help"], prog_name="tribo", terminal_width=88
    )
    assert result.exit_code == 0, result.output
    return result.output


def _components(registry: Registry, kind: str, heading: str) -> Iterator[str]:
    names = registry.names(kind)
    if not names:
        words = kind.replace("_", " ")
        yield f"No {words} comes with tribo; a [plugin](../howto/write_law.md) may offer one.\n"
    for name in names:
        cls = registry.lookup(kind, name)
        yield f'{heading} `type = "{name}"`\n'
        yield f"{_prose(cls)}\n"
        yield from _table(cls)


def _about(name: str, field: FieldInfo) -> Iterator[str]:
    if text := descriptions(Case).get(name):
        yield f"{text}\n"
    if not field.is_required():
        default = field.default
        if isinstance(default, Component | Implicit):
            yield f'Optional; `type = "{default.type}"` if left out.\n'
        elif isinstance(default, str):
            yield f'Optional; `type = "{default}"` if left out.\n'
        else:
            yield "Optional.\n"


def _rows(model: Any, fields: dict[str, FieldInfo]) -> Iterator[str]:
    if not fields:
        yield "It has no keys of its own.\n"
        return
    yield "| Key | Value | Default | Meaning |\n| --- | --- | --- | --- |"
    texts = descriptions(model)
    for name, field in fields.items():
        text = " ".join(texts.get(name, "").replace("|", "\\|").split())
        yield f"| `{name}` | {_kind(*_typed(field))} | {_default(field)} | {text} |"
    yield ""


def _table(model: Any) -> Iterator[str]:
    yield from _rows(model, {n: f for n, f in model.model_fields.items() if n != "type"})
    for field in model.model_fields.values():
        inner = _model(field.annotation)
        if inner is not None and not issubclass(inner, Component) and inner is not model:
            if inner.__name__ == "Material":
                continue
            name = next(n for n, f in model.model_fields.items() if f is field)
            yield f"`{name}`: {_summary(inner)}\n"
            yield from _table(inner)


def _kind(annotation: Any, metadata: tuple[Any, ...]) -> str:
    """Return what a value must be, in words."""
    for mark in metadata:
        if isinstance(mark, Quantity):
            return _quantity(mark)
    origin = get_origin(annotation)
    if origin is Annotated:
        inner, *marks = get_args(annotation)
        return _kind(inner, tuple(marks))
    if origin in (Union, UnionType):
        kinds = [_kind(part, metadata) for part in get_args(annotation) if part is not NoneType]
        return " or ".join(kinds)
    if origin is Literal:
        return " or ".join(f'`"{value}"`' for value in get_args(annotation))
    if inspect.isclass(origin) and issubclass(origin, Mapping):
        return f"table: by name, each {_kind(get_args(annotation)[1], ())}"
    if origin is tuple:
        parts = get_args(annotation)
        one = _kind(parts[0], ())
        return f"list: each {one}" if parts[-1] is Ellipsis else f"one or a pair: {one}"
    if inspect.isclass(annotation) and issubclass(annotation, Component):
        return f"a {annotation.kind().replace('_', ' ')}, by its `type`"
    if inspect.isclass(annotation) and issubclass(annotation, BaseModel):
        return "table"
    names = {bool: "`true` or `false`", int: "whole number", float: "number", str: "text"}
    names |= {Path: "path", Any: "quantity"}
    return names.get(annotation, str(annotation)) + _bounds(metadata)


def _quantity(mark: Quantity) -> str:
    unit = "number" if mark.unit == "1" else mark.unit
    bounds = [
        f"{sign} {bound:g}"
        for sign, bound in (
            (">", mark.above),
            ("≥", mark.at_least),
            ("<", mark.below),
            ("≤", mark.at_most),
        )
        if bound is not None
    ]
    return ", ".join([unit, *bounds])


def _bounds(metadata: tuple[Any, ...]) -> str:
    signs = {Gt: (">", "gt"), Ge: ("≥", "ge"), Lt: ("<", "lt"), Le: ("≤", "le")}
    text = ""
    for mark in metadata:
        for inner in (mark, *getattr(mark, "metadata", ())):
            if type(inner) in signs:
                sign, attribute = signs[type(inner)]
                text += f", {sign} {getattr(inner, attribute):g}"
    return text


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    if field.default is None or field.default is PydanticUndefined:
        return "–"
    if isinstance(field.default, bool):
        return f"`{str(field.default).lower()}`"
    if isinstance(field.default, tuple) and not field.default:
        return "`[]`"
    if isinstance(field.default, float):
        return f"`{field.default:g}`"
    return f"`{field.default}`" if isinstance(field.default, int) else f'`"{field.default}"`'


def _summary(thing: Any) -> str:
    return " ".join((inspect.getdoc(thing) or "").split("\n\n")[0].split())


def _prose(cls: type[Component]) -> str:
    """Return a docstring up to its first numpydoc section."""
    lines = (inspect.getdoc(cls) or "").splitlines()
    end = next((i - 1 for i, line in enumerate(lines) if line and set(line) == {"-"}), len(lines))
    return "\n".join(lines[:end]).strip().replace("::\n", ":\n")


def _typed(field: FieldInfo) -> tuple[Any, tuple[Any, ...]]:
    return field.annotation, tuple(field.metadata)


def _component_kind(field: FieldInfo) -> str:
    """Return the kind of component that a field takes; empty if it takes none."""
    model = _model(field.annotation)
    return model.kind() if model is not None and issubclass(model, Component) else ""


def _is_table(field: FieldInfo) -> bool:
    return _model(field.annotation) is not None


def _model(annotation: Any) -> Any:
    if inspect.isclass(annotation) and issubclass(annotation, BaseModel):
        return annotation
    for part in get_args(annotation):
        model = _model(part)
        if model is not None:
            return model
    return None


def _superscript(exponent: int) -> str:
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
