"""Which component a name in a case stands for."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from typing import Any

from tribo.core.errors import CaseError, TriboWarning
from tribo.core.words import did_you_mean, suggestion
from tribo.interfaces.component import Component
from tribo.registry.kinds import KINDS
from tribo.registry.loader import (
    Name,
    Source,
    builtin,
    distribution_summary,
    given,
    installed,
    load,
)
from tribo.registry.probe import probe
from tribo.registry.records import ComponentRecord, PluginRecord
from tribo.registry.selection import selected

_UNUSABLE = ("disabled", "broken", "incompatible")


class Registry:
    """The components that a set of plugins offers, by kind and name.

    A plugin whose entry points declare its names is imported only when one of
    them is looked up. A name that two plugins claim belongs to neither.

    Parameters
    ----------
    sources : iterable of Source
        The plugins.
    """

    def __init__(self, sources: Iterable[Source]) -> None:
        self._sources = list(sources)
        self._records = [source.record for source in self._sources]
        self._offers: dict[int, tuple[ComponentRecord, ...]] = {}
        self._claims: dict[Name, list[int]] = {}
        for number, source in enumerate(self._sources):
            if source.record.status in _UNUSABLE:
                continue
            declared = source.declared
            if declared is None:
                declared = tuple((o.kind, o.name) for o in self._load(number))
            for name in declared:
                self._claims.setdefault(name, []).append(number)
        for number in range(len(self._sources)):
            self._records[number] = self._with_conflicts(number)

    @classmethod
    def with_plugins(cls, *plugins: object) -> Registry:
        """Return a registry of the built-in components and those of `plugins`.

        Nothing else that is installed takes part.

        Parameters
        ----------
        *plugins : object
            Modules, or other objects, that carry hook implementations.
        """
        return cls([builtin(), *map(given, plugins)])

    @property
    def plugins(self) -> tuple[PluginRecord, ...]:
        """Every plugin that was found, with what is known of it by now."""
        return tuple(self._records)

    def names(self, kind: str) -> list[str]:
        """Return the usable names of one kind, sorted; imports nothing."""
        return sorted(
            name
            for (k, name), claims in self._claims.items()
            if k == kind and len(claims) == 1 and self._records[claims[0]].status != "broken"
        )

    def owner(self, kind: str, name: str) -> PluginRecord:
        """Return the plugin that offers a usable name; imports nothing."""
        return self._records[self._claims[kind, name][0]]

    def summary(self, kind: str, name: str) -> str:
        """Return what a usable name is about, in a line; imports nothing."""
        number = self._claims[kind, name][0]
        for offer in self._offers.get(number, ()):
            if (offer.kind, offer.name) == (kind, name):
                return (offer.cls.__doc__ or "").strip().split("\n")[0]
        return distribution_summary(self._records[number])

    def classes(self, kind: str) -> list[type[Component[Any]]]:
        """Return the usable classes of one kind, sorted by name; imports their plugins."""
        return [self.lookup(kind, name) for name in self.names(kind)]

    def lookup(self, kind: str, name: str) -> type[Component[Any]]:
        """Return the class that `name` stands for; raises as `record` does."""
        return self.record(kind, name).cls

    def record(self, kind: str, name: str) -> ComponentRecord:
        """Return what is known about a component, importing its plugin if need be.

        Parameters
        ----------
        kind : str
            ``contact_solver``, ``wear_law``, ``kinematics``, ``surface``,
            ``effect`` or ``observer``.
        name : str
            The name in a case.

        Raises
        ------
        CaseError
            If no plugin, or more than one, offers `name`, or the one that
            does cannot be imported.
        """
        words = KINDS[kind].words
        claims = self._claims.get((kind, name), [])
        if len(claims) > 1:
            owners = " and ".join(str(self._records[number]) for number in claims)
            raise CaseError(
                f"{words} {name!r} is offered by {owners}, so that it is not clear which is"
                " meant; uninstall or disable one of them"
            )
        if not claims:
            raise CaseError(f"unknown {words} {name!r}{self._instead(kind, name)}")
        for offer in self._load(claims[0]):
            if (offer.kind, offer.name) == (kind, name):
                return offer
        plugin = self._records[claims[0]]
        raise CaseError(
            f"{words} {name!r} is in {plugin}, which is broken: {plugin.reason}; mend, update or "
            f"reinstall {plugin.distribution}"
        )

    def providers(self, fields: Iterable[str]) -> list[str]:
        """Return the effects that provide any of `fields`, each with its plugin; imports them."""
        wanted = set(fields)
        found = []
        for name in self.names("effect"):
            try:
                component = self.record("effect", name)
            except CaseError:
                continue
            if wanted & {field.name for field in getattr(component.cls, "provides", ())}:
                found.append(f"{name!r} ({component.plugin})")
        return found

    def choices(self, kind: str) -> str:
        """Return the usable names of one kind as text, with who provides them."""
        by_plugin: dict[str, list[str]] = {}
        for name in self.names(kind):
            by_plugin.setdefault(str(self.owner(kind, name)), []).append(name)
        listed = (f"{', '.join(names)} ({plugin})" for plugin, names in by_plugin.items())
        return "; ".join(listed) or "none"

    def _load(self, number: int) -> tuple[ComponentRecord, ...]:
        if number not in self._offers:
            source = self._sources[number]
            if source.record.status == "available":
                # An import that never ends or crashes does so in a process of its own first.
                source = probe(source)
            if source.record.status == "broken":
                self._records[number], self._offers[number] = source.record, ()
            else:
                self._records[number], self._offers[number] = load(source)
        return self._offers[number]

    def _instead(self, kind: str, name: str) -> str:
        text = suggestion(did_you_mean(name, self.names(kind)))
        text += f" Installed: {self.choices(kind)}"
        for source, plugin in zip(self._sources, self._records, strict=True):
            declared = source.declared or ()
            if plugin.status in _UNUSABLE and (not declared or (kind, name) in declared):
                text += f". {plugin} is {plugin.status}: {plugin.reason}"
        return text

    def _with_conflicts(self, number: int) -> PluginRecord:
        reasons = []
        for (kind, name), claims in self._claims.items():
            others = [str(self._records[other]) for other in claims if other != number]
            if others and number in claims:
                reasons.append(f"{KINDS[kind].words} {name!r} also from {', '.join(others)}")
        record = self._records[number]
        return replace(record, status="conflict", reason="; ".join(reasons)) if reasons else record


@cache
def default_registry() -> Registry:
    """Return the registry of the built-in and the installed plugins.

    A plugin that is seen at once to be unusable is warned of, once.
    """
    registry = Registry([builtin(), *selected(installed())])
    for plugin in registry.plugins:
        if plugin.status in ("broken", "incompatible", "conflict"):
            message = f"plugin {plugin} is left out, {plugin.status}: {plugin.reason}"
            warnings.warn(message, TriboWarning, stacklevel=2)
    return registry
