"""Look up the class that a name in a case stands for."""

from __future__ import annotations

import os
import re
import sys
import warnings
from collections import defaultdict
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, redirect_stdout, suppress
from dataclasses import replace
from functools import cache
from traceback import walk_tb
from typing import Any

import numpy as np
import pluggy

from tribo.component import Component
from tribo.core.distributions import unmet
from tribo.core.errors import CaseError, PluginError
from tribo.core.words import did_you_mean, said, suggestion
from tribo.registry import hookspecs
from tribo.registry.kinds import Classes, offered
from tribo.registry.plugins import Plugin, builtin, given, installed
from tribo.registry.selection import selected


class Registry:
    """The components that a set of plugins offers, by name.

    An installed plugin is imported only when a name that its entry points
    declare is looked up. A name that two plugins claim cannot be used.

    Parameters
    ----------
    plugins : iterable of Plugin
        The plugins.

    Raises
    ------
    TypeError, ValueError
        If one that was given as an object breaks the contract.
    """

    def __init__(self, plugins: Iterable[Plugin]) -> None:
        self._manager = pluggy.PluginManager(hookspecs.PROJECT)
        self._manager.add_hookspecs(hookspecs)
        self._plugins = {f"{p.distribution}:{p.entry_point}:{i}": p for i, p in enumerate(plugins)}
        self._classes: dict[str, Classes] = {}
        self._claims: defaultdict[str, list[str]] = defaultdict(list)
        for key, plugin in self._plugins.items():
            if plugin.origin != "installed":
                self._classes[key] = self._register(key)
            if plugin.status == "disabled":
                self._manager.set_blocked(key)
            elif plugin.usable:
                for name in plugin.names or self._classes[key]:
                    self._claims[name].append(key)
        self._conflicts = {name: keys for name, keys in self._claims.items() if len(keys) > 1}

    @classmethod
    def with_plugins(cls, *plugins: object) -> Registry:
        """Return a registry of the built-in components and those of `plugins` only.

        Parameters
        ----------
        *plugins : object
            Modules, or other objects, that carry hook implementations.
        """
        return cls([builtin(), *map(given, plugins)])

    @property
    def plugins(self) -> tuple[Plugin, ...]:
        """Every plugin that was found, with its present status."""
        return tuple(self._plugins.values())

    @property
    def components(self) -> Classes:
        """The usable classes of the plugins that were imported, by name."""
        return {
            name: cls
            for classes in self._classes.values()
            for name, cls in sorted(classes.items())
            if name not in self._conflicts
        }

    @property
    def waiting(self) -> list[str]:
        """The usable names of the plugins not imported yet, sorted; their kinds are unknown."""
        claims = sorted(self._claims.items())
        return [n for n, keys in claims if len(keys) == 1 and keys[0] not in self._classes]

    @property
    def conflicts(self) -> dict[str, str]:
        """The names that more than one plugin claims, and what to do about each."""
        return {
            name: f"{name!r} is offered by {' and '.join(map(str, self.claimants(name)))}, so that "
            "it is not clear which is meant; uninstall or disable one of them"
            for name in self._conflicts
        }

    def names(self, kind: str) -> list[str]:
        """Return the usable names of one kind, sorted, of the plugins that were imported."""
        return sorted(name for name, cls in self.components.items() if cls.kind() == kind)

    def claimants(self, name: str) -> list[Plugin]:
        """Return the plugins that claim a name; imports nothing."""
        return [self._plugins[key] for key in self._claims.get(name, ())]

    def lookup(self, kind: str, name: str) -> type[Component]:
        """Return the class that `name` stands for, importing its plugin if need be.

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
            If no plugin, or more than one, offers `name`, the one that does
            cannot be used, or it is of another kind.
        """
        words = kind.replace("_", " ")
        cls = self.find(name, words)
        if cls is None:
            meant = suggestion(did_you_mean(name, [*self.names(kind), *self.waiting]))
            raise CaseError(f"unknown {words} {name!r}{meant} Installed: {self.choices(kind)}")
        if cls.kind() != kind:
            other = cls.kind().replace("_", " ")
            article = "an" if other[0] in "aeiou" else "a"
            raise CaseError(f"unknown {words} {name!r}: it is {article} {other}")
        return cls

    def find(self, name: str, words: str = "component") -> type[Component] | None:
        """Return the class of any kind that `name` stands for, or None.

        Raises
        ------
        CaseError
            If more than one plugin offers it, or the one that does cannot be used.
        """
        if name in self._conflicts:
            raise CaseError(f"{words} {self.conflicts[name]}")
        cls = self._load(self._claims[name][0]).get(name) if name in self._claims else None
        refused = [p for p in self.plugins if name in p.names and not p.usable]
        if cls is None and refused:
            why = "; ".join(f"{plugin} is {plugin.status}: {plugin.reason}" for plugin in refused)
            raise CaseError(f"{words} {name!r} cannot be used: {why}")
        return cls

    def load_all(self) -> list[Plugin]:
        """Import every plugin that is not disabled, and return those that cannot be used."""
        usable = [key for key, plugin in self._plugins.items() if plugin.usable]
        return [self._plugins[key] for key in usable if not self._load(key)]

    def providers(self, fields: Iterable[str]) -> list[str]:
        """Return the effects of imported plugins that provide any of `fields`, as text."""
        wanted = set(fields)
        return [
            f"{name!r} ({self.claimants(name)[0]})"
            for name in self.names("effect")
            if wanted & {field.name for field in getattr(self.components[name], "provides", ())}
        ]

    def ask(self, hook: str, **arguments: object) -> list[Any]:
        """Return the answers of the imported plugins to a hook, in the order of the plugins.

        Raises
        ------
        PluginError
            If one of them raises; the message has its file and line.
        """
        try:
            with _process_kept():
                answers: list[Any] = getattr(self._manager.hook, hook)(**arguments)
        except Exception as error:
            packages = [each.entry_point for each in self.plugins if each.origin != "built-in"]
            raise PluginError(
                f"a plugin's {hook} raised {said(error)}{_place(error, *packages)}; --no-plugin "
                "leaves that plugin out"
            ) from error
        return answers[::-1]

    def choices(self, kind: str) -> str:
        """Return the usable names of one kind as text, each with its plugin."""
        text = self._by_plugin(self.names(kind)) or "none"
        waiting = self._by_plugin(self.waiting)
        return f"{text}; of plugins not imported yet: {waiting}" if waiting else text

    def _by_plugin(self, names: Iterable[str]) -> str:
        by_plugin = defaultdict(list)
        for name in names:
            by_plugin[str(self.claimants(name)[0])].append(name)
        return "; ".join(f"{', '.join(own)} ({plugin})" for plugin, own in by_plugin.items())

    def _load(self, key: str) -> Classes:
        """Import a plugin once, and return its classes; none if that fails."""
        if key in self._classes:
            return self._classes[key]
        plugin, self._classes[key] = self._plugins[key], {}
        try:
            if lacks := unmet(plugin.distribution):
                self._plugins[key] = replace(plugin, status="incompatible", reason=lacks)
                return {}
            with _process_kept():
                self._classes[key] = self._register(key)
            self._plugins[key] = replace(plugin, status="loaded")
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            self._manager.unregister(name=key)
            reason = said(error) + _place(error, plugin.entry_point)
            self._plugins[key] = replace(plugin, status="broken", reason=reason)
        return self._classes[key]

    def _register(self, key: str) -> Classes:
        """Register a plugin with the plugin manager, and return the classes that it offers."""
        plugin = self._plugins[key].load()
        self._manager.register(plugin, key)
        self._manager.check_pending()
        others = [other for other in self._manager.get_plugins() if other is not plugin]
        classes = offered(self._manager.subset_hook_caller("tribo_components", others)())
        names = self._plugins[key].names
        if names and set(names) != set(classes):
            raise ValueError(
                f"its entry points declare {', '.join(names)}, but its hook tribo_components, "
                f"marked with @hookimpl, returns {', '.join(classes) or 'nothing'}"
            )
        return classes


@cache
def default_registry() -> Registry:
    """Return the registry of the built-in and the installed plugins."""
    return Registry([builtin(), *selected(installed())])


def _place(error: BaseException, *entry_points: str) -> str:
    """Return file and line of the innermost call in a plugin, as text; empty if there is none."""
    if isinstance(error, SyntaxError):
        return ""  # Its message has its place.
    packages = {re.split("[.:]", entry_point)[0] for entry_point in entry_points}
    places = [
        (frame.f_code.co_filename, line)
        for frame, line in walk_tb(error.__traceback__)
        if str(frame.f_globals.get("__name__")).partition(".")[0] in packages
    ]
    return f" ({places[-1][0]}, line {places[-1][1]})" if places else ""


@contextmanager
def _process_kept() -> Iterator[None]:
    """Restore folder, warning filters and numpy's errors afterwards; print to stderr meanwhile."""
    with ExitStack() as kept, redirect_stdout(sys.stderr), warnings.catch_warnings(), np.errstate():
        # The folder may have been deleted.
        with suppress(FileNotFoundError):
            kept.callback(os.chdir, os.getcwd())
        yield
