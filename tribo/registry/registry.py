"""Which component a name in a case stands for."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from dataclasses import replace
from functools import cache

from tribo.core.errors import CaseError, TriboWarning
from tribo.core.words import did_you_mean, suggestion
from tribo.interfaces.component import Component
from tribo.registry.kinds import KINDS
from tribo.registry.loader import (
    Source,
    builtin,
    distribution_summary,
    given,
    installed,
    load,
)
from tribo.registry.probe import probe
from tribo.registry.records import ComponentRecord, Name, PluginRecord
from tribo.registry.selection import selected
from tribo.registry.verdicts import shown_to_import


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
            if not source.record.usable:
                continue
            declared = source.declared
            if declared is None:
                declared = tuple((o.kind, o.name) for o in self._load(number))
            for name in declared:
                self._claims.setdefault(name, []).append(number)

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
        """Every plugin that was found, with what is known of it by now.

        One that could be used but for a name that another claims too is in
        ``conflict``; its other names are usable.
        """
        return tuple(self._with_conflicts(number) for number in range(len(self._records)))

    def names(self, kind: str) -> list[str]:
        """Return the usable names of one kind, sorted; imports nothing."""
        return sorted(
            name
            for (k, name), claims in self._claims.items()
            if k == kind and len(claims) == 1 and self._records[claims[0]].status != "broken"
        )

    def conflicts(self) -> dict[Name, str]:
        """Return the names that more than one plugin claims, and what to do about each."""
        found = {}
        for (kind, name), claims in self._claims.items():
            if len(claims) > 1:
                owners = " and ".join(str(self._records[number]) for number in claims)
                found[kind, name] = (
                    f"{KINDS[kind].words} {name!r} is offered by {owners}, so that it is not clear "
                    "which is meant; uninstall or disable one of them"
                )
        return found

    def claimants(self, kind: str, name: str) -> list[PluginRecord]:
        """Return the plugins that claim a name; imports nothing."""
        return [self._records[number] for number in self._claims.get((kind, name), ())]

    def summary(self, kind: str, name: str) -> str:
        """Return what a usable name is about, in a line; imports nothing."""
        number = self._claims[kind, name][0]
        for offer in self._offers.get(number, ()):
            if (offer.kind, offer.name) == (kind, name):
                return offer.description.split("\n")[0]
        plugin = self._records[number]
        return f"(all of {plugin.distribution}) {distribution_summary(plugin)}".rstrip()

    def classes(self, kind: str) -> list[type[Component]]:
        """Return the usable classes of one kind, sorted by name; imports their plugins."""
        return [self.lookup(kind, name) for name in self.names(kind)]

    def lookup(self, kind: str, name: str) -> type[Component]:
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
            raise CaseError(self.conflicts()[kind, name])
        if not claims:
            refused = self._refused(name, declared=True)
            if refused:
                raise CaseError(f"{words} {name!r} cannot be used: {'; '.join(refused)}")
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
        """Return the effects that provide any of `fields`, each with its plugin.

        Only those of plugins that have been imported are known; imports nothing.
        """
        wanted = set(fields)
        return [
            f"{offer.name!r} ({offer.plugin})"
            for found in self._offers.values()
            for offer in found
            if offer.name in self.names("effect")
            and wanted & {field.name for field in getattr(offer.cls, "provides", ())}
        ]

    def choices(self, kind: str) -> str:
        """Return the usable names of one kind as text, with who provides them."""
        by_plugin: dict[str, list[str]] = {}
        for name in self.names(kind):
            (plugin,) = self.claimants(kind, name)
            by_plugin.setdefault(str(plugin), []).append(name)
        listed = (f"{', '.join(names)} ({plugin})" for plugin, names in by_plugin.items())
        return "; ".join(listed) or "none"

    def _load(self, number: int) -> tuple[ComponentRecord, ...]:
        if number not in self._offers:
            source = self._sources[number]
            record = source.record
            if record.status == "available" and not shown_to_import(record):
                # An import that never ends or crashes does so in a process of its own first.
                source = probe(source)
            if source.record.status == "broken":
                self._records[number], self._offers[number] = source.record, ()
            else:
                self._records[number], self._offers[number] = load(source)
        return self._offers[number]

    def refusals(self, name: str) -> list[str]:
        """Return why plugins that may offer a component called `name` cannot be used.

        Those of the plugins that declare this very name, if there are any.
        """
        return self._refused(name, declared=True) or self._refused(name, declared=False)

    def _refused(self, name: str, *, declared: bool) -> list[str]:
        """Return why plugins that declare `name`, or do not say what they offer, are unusable."""
        return [
            f"{plugin} is {plugin.status}: {plugin.reason}"
            for source, plugin in zip(self._sources, self._records, strict=True)
            if not plugin.usable
            and (name in [n for _, n in source.declared or ()] if declared else not source.declared)
        ]

    def _instead(self, kind: str, name: str) -> str:
        text = suggestion(did_you_mean(name, self.names(kind)))
        text += f" Installed: {self.choices(kind)}"
        return ". ".join([text, *self.refusals(name)])

    def _with_conflicts(self, number: int) -> PluginRecord:
        record = self._records[number]
        if not record.usable:
            return record
        reasons = []
        for (kind, name), claims in self._claims.items():
            others = [str(self._records[other]) for other in claims if other != number]
            if others and number in claims:
                reasons.append(f"{KINDS[kind].words} {name!r} also from {', '.join(others)}")
        return replace(record, status="conflict", reason="; ".join(reasons)) if reasons else record


@cache
def default_registry() -> Registry:
    """Return the registry of the built-in and the installed plugins.

    A plugin that is seen at once to be unusable is warned of, once, and so is
    a name that two plugins claim.
    """
    registry = Registry([builtin(), *selected(installed())])
    messages = [
        f"plugin {plugin} is left out, {plugin.status}: {plugin.reason}"
        for plugin in registry.plugins
        if plugin.status in ("broken", "incompatible")
    ]
    for message in (*messages, *registry.conflicts().values()):
        warnings.warn(message, TriboWarning, stacklevel=2)
    return registry
