"""Which component a name in a case stands for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from typing import Any

from tribo.core.errors import CaseError
from tribo.core.words import did_you_mean, suggestion
from tribo.interfaces.component import Component
from tribo.registry.kinds import KINDS
from tribo.registry.loader import Source, builtin, given, installed, load
from tribo.registry.records import ComponentRecord, PluginRecord


class Registry:
    """The components that a set of plugins offers, by kind and name.

    A name that two plugins claim belongs to neither.

    Parameters
    ----------
    sources : iterable of Source
        The plugins; they are loaded now.

    Attributes
    ----------
    plugins : tuple of PluginRecord
        Every plugin, also those that could not be loaded.
    """

    def __init__(self, sources: Iterable[Source]) -> None:
        plugins: list[PluginRecord] = []
        self._claims: dict[tuple[str, str], list[ComponentRecord]] = {}
        for plugin, offers in load(sources):
            plugins.append(plugin)
            for offer in offers:
                self._claims.setdefault((offer.kind, offer.name), []).append(offer)
        self.plugins = tuple(self._with_conflicts(plugin) for plugin in plugins)

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

    def names(self, kind: str) -> list[str]:
        """Return the usable names of one kind, sorted."""
        return sorted(
            n for (k, n), claims in self._claims.items() if k == kind and len(claims) == 1
        )

    def classes(self, kind: str) -> list[type[Component[Any]]]:
        """Return the usable classes of one kind, sorted by name."""
        return [self.lookup(kind, name) for name in self.names(kind)]

    def lookup(self, kind: str, name: str) -> type[Component[Any]]:
        """Return the class that `name` stands for; raises as `record` does."""
        return self.record(kind, name).cls

    def record(self, kind: str, name: str) -> ComponentRecord:
        """Return what is known about a component.

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
            If no plugin, or more than one, offers `name`.
        """
        claims = self._claims.get((kind, name), [])
        if len(claims) == 1:
            return claims[0]
        words = KINDS[kind].words
        if claims:
            owners = " and ".join(str(claim.plugin) for claim in claims)
            raise CaseError(
                f"{words} {name!r} is offered by {owners}, so that it is not clear which is"
                " meant; uninstall or disable one of them"
            )
        raise CaseError(f"unknown {words} {name!r}{self._instead(kind, name)}")

    def choices(self, kind: str) -> str:
        """Return the usable names of one kind as text, with who provides them."""
        by_plugin: dict[str, list[str]] = {}
        for name in self.names(kind):
            by_plugin.setdefault(str(self.record(kind, name).plugin), []).append(name)
        listed = (f"{', '.join(names)} ({plugin})" for plugin, names in by_plugin.items())
        return "; ".join(listed) or "none"

    def _instead(self, kind: str, name: str) -> str:
        text = suggestion(did_you_mean(name, self.names(kind)))
        text += f" Installed: {self.choices(kind)}"
        for plugin in self.plugins:
            if plugin.status in ("broken", "incompatible", "disabled"):
                text += f". {plugin} is {plugin.status}: {plugin.reason}"
        return text

    def _with_conflicts(self, plugin: PluginRecord) -> PluginRecord:
        reasons = []
        for (kind, name), claims in self._claims.items():
            others = [str(c.plugin) for c in claims if c.plugin != plugin]
            if others and len(others) < len(claims):
                reasons.append(f"{KINDS[kind].words} {name!r} also from {', '.join(others)}")
        return replace(plugin, status="conflict", reason="; ".join(reasons)) if reasons else plugin


@cache
def default_registry() -> Registry:
    """Return the registry of the built-in and the installed plugins.

    They are loaded when it is asked for the first time.
    """
    return Registry([builtin(), *installed()])
