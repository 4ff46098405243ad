"""Lists and descriptions of the components in a registry."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from contextlib import suppress

from pydantic import BaseModel

from tribo.component import Component
from tribo.core.errors import CaseError
from tribo.core.table import about, descriptions
from tribo.core.units import quantities
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.kinds import KINDS
from tribo.registry.plugins import Plugin
from tribo.registry.registry import Registry

FACTS = (
    *("requires", "provides", "state_fields", "material_properties"),
    *("accepts_wear_compliance", "honours_cap", "takes_cap_map", "takes_coatings", "periodic"),
)
"""Attributes in the description of a class."""


def catalogue(registry: Registry) -> list[dict[str, str]]:
    """Return a row for every component, and for every plugin that cannot be used.

    No plugin is imported: for a component of a plugin not imported yet, kind and summary are empty.
    """
    known, owners = registry.components, registry.owners
    names = [name for kind in KINDS for name in registry.names(kind)] + registry.waiting
    rows = [_row(name, owners[name], known.get(name)) for name in names]
    return rows + [_row("", plugin) for plugin in registry.plugins if not plugin.usable]


def matching(registry: Registry, name: str) -> list[str]:
    """Return the names of the component called `name`, or of the components of the distribution."""
    known = [*registry.components, *registry.waiting]
    if name in known:
        return [name]
    owners = registry.owners
    found = [each for each in known if owners[each].distribution == name]
    if found:
        return found
    for plugin in registry.plugins:
        if name in (plugin.distribution, *plugin.names):
            raise CaseError(f"plugin {plugin} is {plugin.status}: {plugin.reason or 'it is empty'}")
    meant = suggestion(did_you_mean(name, known))
    raise CaseError(
        f"no component or distribution is called {name!r}{meant} See tribo plugins list"
    )


def describe(cls: type[Component], plugin: Plugin) -> str:
    """Return the description of a component: its docstring, parameters and fields."""
    text = about(cls) or "(it has no description)"
    lines = [f"{cls.type}: {_words(cls)} from {plugin}", "", text]
    if parameters := list(_parameters(cls)):
        lines += ["", "Parameters", "----------", *parameters]
    lines.append("")
    for attribute in FACTS:
        value = getattr(cls, attribute, ())
        if isinstance(value, bool) or (value and not isinstance(value, property)):
            shown = value if isinstance(value, bool) else "; ".join(map(str, value))
            lines.append(f"{attribute}: {shown}")
    lines.append(f"Class: {cls.__module__}.{cls.__qualname__}")
    with suppress(TypeError, OSError):
        lines.append(f"File: {inspect.getfile(cls)}")
    return "\n".join(lines)


def _words(cls: type[Component]) -> str:
    return cls.kind().replace("_", " ")


def _row(name: str, plugin: Plugin, cls: type[Component] | None = None) -> dict[str, str]:
    facts = {key: plugin.facts[key] for key in ("distribution", "version", "status", "reason")}
    kind, summary = "", ""
    if cls is not None:
        kind, summary = _words(cls), about(cls).partition("\n")[0]
    return {"name": name, "kind": kind, **facts, "summary": summary}


def _parameters(table: type[BaseModel]) -> Iterator[str]:
    """Yield a line for each key of a table."""
    texts = descriptions(table)
    for name, field in table.model_fields.items():
        unit = next((f" [{mark.unit}]" for mark in quantities(field)), "")
        needed = "needed" if field.is_required() else f"default {field.default!r}"
        if field.default is None or field.default_factory is not None:
            needed = "optional"
        yield f"{name}{unit} ({needed}): {texts.get(name, 'no description')}"
