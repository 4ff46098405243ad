"""What a registry holds, for people: lists and descriptions."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.units import Quantity
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.kinds import KINDS
from tribo.registry.loader import distribution_summary
from tribo.registry.records import ComponentRecord, Name, PluginRecord
from tribo.registry.registry import Registry


def catalogue(registry: Registry) -> list[dict[str, str]]:
    """Return a row for every component, and for every plugin that cannot be used.

    Nothing is imported that has not been: the summary of a component of a
    plugin not imported yet is that of its distribution, and says so. A name
    that more than one plugin claims has a row for each, in conflict.

    Returns
    -------
    list of dict
        With ``name``, ``kind``, ``distribution``, ``version``, ``status``,
        ``reason`` and ``summary``.
    """
    rows = []
    for kind in KINDS.values():
        for name in registry.names(kind.name):
            (plugin,) = registry.claimants(kind.name, name)
            rows.append(_row(name, kind.words, plugin, registry.summary(kind.name, name)))
    for key, reason in registry.conflicts().items():
        for plugin in registry.claimants(*key):
            contested = replace(plugin, status="conflict", reason=reason)
            words = KINDS[key[0]].words
            rows.append(_row(key[1], words, contested, distribution_summary(plugin)))
    rows += [
        _row("", "", plugin, distribution_summary(plugin))
        for plugin in registry.plugins
        if not plugin.usable
    ]
    return rows


def find(registry: Registry, name: str) -> list[Name]:
    """Return kind and name of the component, or of all of the distribution, called `name`.

    Names that more than one plugin claims are found too, and come last.

    Raises
    ------
    CaseError
        If there is none.
    """
    usable = [(kind, known) for kind in KINDS for known in registry.names(kind)]
    known = [*usable, *registry.conflicts()]
    found = [key for key in known if key[1] == name]
    found = found or [
        key for key in known if name in [p.distribution for p in registry.claimants(*key)]
    ]
    if found:
        return found
    refusals = [
        f"plugin {plugin} is {plugin.status}: {plugin.reason or 'it is empty'}"
        for plugin in registry.plugins
        if plugin.distribution == name
    ]
    refusals = refusals or registry.refusals(name)
    if refusals:
        raise CaseError("; ".join(refusals))
    meant = suggestion(did_you_mean(name, [key[1] for key in known]))
    raise CaseError(
        f"no component or distribution is called {name!r}{meant} See tribo plugins list"
    )


def describe(component: ComponentRecord) -> str:
    """Return what a user should know of a component, as text."""
    cls = component.cls
    words = KINDS[component.kind].words
    lines = [f"{component.name}: {words} from {component.plugin}", ""]
    lines += [component.description or "(it has no description)", ""]
    parameters = list(_parameters(cls))
    if parameters:
        lines += ["Parameters", "----------", *parameters, ""]
    lines += _facts(cls)
    lines.append(f"Class: {cls.__module__}.{cls.__qualname__}")
    with suppress(TypeError, OSError):
        lines.append(f"File: {inspect.getfile(cls)}")
    return "\n".join(lines)


def _row(name: str, kind: str, plugin: PluginRecord, summary: str) -> dict[str, str]:
    return {
        "name": name,
        "kind": kind,
        "distribution": plugin.distribution,
        "version": plugin.version,
        "status": plugin.status,
        "reason": plugin.reason,
        "summary": summary,
    }


def _parameters(table: type[BaseModel], within: tuple[type[BaseModel], ...] = ()) -> Iterator[str]:
    """Yield a line for each key of a table, and indented below it those of the tables it holds."""
    within = (*within, table)
    for name, field in table.model_fields.items():
        yield _parameter(name, field)
        for part in _parts(field):
            if inspect.isclass(part) and issubclass(part, BaseModel) and part not in within:
                yield from (f"    {line}" for line in _parameters(part, within))


def _parameter(name: str, field: FieldInfo) -> str:
    unit = next((f" [{q.unit}]" for q in _parts(field) if isinstance(q, Quantity)), "")
    needed = "needed" if field.is_required() else f"default {field.default!r}"
    if field.default is None or field.default_factory is not None:
        needed = "optional"
    return f"{name}{unit} ({needed}): {field.description or 'no description'}"


def _parts(field: FieldInfo) -> Iterator[Any]:
    """Yield the types in a field's annotation and what annotates them, however deep."""
    waiting = [*field.metadata, field.annotation]
    while waiting:
        part = waiting.pop(0)
        yield part
        waiting += [*get_args(part), *getattr(part, "__metadata__", ())]


def _facts(cls: type[Any]) -> list[str]:
    facts = []
    for attribute, words in (
        ("requires", "Requires"),
        ("provides", "Provides"),
        ("state_fields", "Keeps per point"),
    ):
        values = getattr(cls, attribute, ())
        if values:
            facts.append(f"{words}: " + "; ".join(map(_field, values)))
    for attribute, words in (
        ("accepts_wear_compliance", "Takes a wear compliance (implicit steps)"),
        ("honours_cap", "Limits the pressure to a hardness"),
        ("periodic", "Repeats with the window"),
    ):
        if hasattr(cls, attribute):
            facts.append(f"{words}: {'yes' if getattr(cls, attribute) else 'no'}")
    return facts


def _field(field: Field | str) -> str:
    if isinstance(field, str):
        return field
    return f"{field.name} [{field.unit}] {field.description}"
