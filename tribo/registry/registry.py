"""Look up the class that a name in a case stands for."""

from __future__ import annotations

import os
import re
import sys
import warnings
from collections.abc import Iterable, Iterator, Mapping, Set
from contextlib import ExitStack, contextmanager, redirect_stdout, suppress
from functools import cache, partial
from importlib.util import find_spec
from pathlib import Path
from traceback import walk_tb
from typing import TYPE_CHECKING, Any

import numpy as np
import pluggy
from pydantic import BaseModel

from tribo.component import Component, components
from tribo.core.errors import CaseError, warn
from tribo.core.words import did_you_mean, said, suggestion
from tribo.registry import hookspecs
from tribo.registry.kinds import offered
from tribo.registry.plugins import Plugin, builtin, given, installed

if TYPE_CHECKING:
    from tribo.result.read import Result


class Registry:
    """The components that a set of plugins offers, by name.

    An installed plugin is imported only when a name that its entry points
    declare is looked up. Each name belongs to one plugin.

    Parameters
    ----------
    plugins : iterable of Plugin
        The plugins; the attribute `plugins` has their records, each with its
        present status.

    Raises
    ------
    TypeError, ValueError
        If a plugin given as an object breaks the contract.

    Examples
    --------
    >>> registry = tribo.Registry.with_plugins()
    >>> registry.lookup("wear_law", "archard")
    <class 'tribo.wear.archard.Archard'>
    >>> registry.names("contact_solver")
    ['dcfft', 'periodic', 'winkler']
    """

    def __init__(self, plugins: Iterable[Plugin]) -> None:
        self.plugins: tuple[Plugin, ...] = ()
        self._manager = pluggy.PluginManager(hookspecs.PROJECT)
        self._manager.add_hookspecs(hookspecs)
        self._own: dict[str, type[Component]] = {}
        self._records: dict[object, Plugin] = {}
        for plugin in plugins:
            self.add(plugin)

    def add(self, plugin: Plugin) -> None:
        """Let one more plugin take part; `ValueError` if it offers a name that another has."""
        if plugin.origin != "installed":
            self._register(plugin)
        self.plugins += (plugin,)

    def know(self, cls: type[Component]) -> None:
        """Let a class that no plugin offers take part, in place of an earlier one of its name."""
        name = cls.type
        if (other := self.find(name)) and not self.is_own(other) and other is not cls:
            raise CaseError(
                f"the class {cls.__qualname__} has the type {name!r} of {other.__module__}."
                f"{other.__qualname__}; give it a type of its own, as 'my.{name}'"
            )
        if other is None or self.is_own(other):
            self._own[name] = cls

    def know_all(self, case: BaseModel) -> None:
        """Let every class in a case take part; see `know`."""
        for _, component in components(case):
            self.know(type(component))

    def is_own(self, cls: type[Component]) -> bool:
        """Whether a class takes part that no plugin offers."""
        return self._own.get(cls.type) is cls

    @classmethod
    def with_plugins(cls, *plugins: object) -> Registry:
        """Return a registry of the built-in components and the components of `plugins` only.

        Parameters
        ----------
        *plugins : object
            Modules, or other objects, that carry hook implementations.
        """
        return cls([builtin(), *map(given, plugins)])

    @property
    def components(self) -> dict[str, type[Component]]:
        """The usable classes of the plugins that were imported, by name."""
        return {
            name: cls for plugin in self.plugins for name, cls in sorted(plugin.classes.items())
        }

    @property
    def waiting(self) -> list[str]:
        """The usable names of the plugins not imported yet, sorted; their kinds are unknown."""
        return sorted(n for p in self.plugins if p.status == "available" for n in p.names)

    def names(self, kind: str) -> list[str]:
        """Return the usable names of one kind, sorted, of the plugins that were imported."""
        return sorted(name for name, cls in self.components.items() if cls.kind() == kind)

    @property
    def owners(self) -> dict[str, Plugin]:
        """The plugin that offers each name; of several, a usable plugin."""
        plugins = sorted(self.plugins, key=lambda plugin: plugin.usable)
        return {name: plugin for plugin in plugins for name in plugin.names}

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
            If no plugin offers `name`, its plugin cannot be used, or it is of
            another kind.
        """
        words = kind.replace("_", " ")
        cls = self.find(name, words)
        if cls is None:
            known = [*self.names(kind), *self.waiting]
            meant = suggestion(did_you_mean(name, known))
            package, dot, _ = name.partition(".")
            if dot and not any(each.startswith(package + dot) for each in known):
                meant = f"; no installed package provides {package!r}."
            raise CaseError(f"unknown {words} {name!r}{meant} Installed: {self.choices(kind)}")
        if cls.kind() != kind:
            other = cls.kind().replace("_", " ")
            raise CaseError(
                f"a {words} is needed, {name!r} is of kind {other}. Installed: {self.choices(kind)}"
            )
        return cls

    def find(self, name: str, words: str = "component") -> type[Component] | None:
        """Return the class of any kind that `name` stands for; None if no plugin offers it."""
        plugin = self.owners.get(name)
        if plugin is not None:
            self.load(plugin)
            if name in plugin.classes:
                return plugin.classes[name]
        if plugin is None or name in self._own:
            return self._own.get(name)
        raise CaseError(
            f"{words} {name!r} cannot be used: {plugin} is {plugin.status}: {plugin.reason}"
        )

    def load_all(self) -> None:
        """Import every plugin that is not disabled."""
        for plugin in self.plugins:
            self.load(plugin)

    def ask(
        self, hook: str, own: object = None, types: Set[str] | None = None, **arguments: object
    ) -> list[Any]:
        """Return the items that a module of the kernel and the imported plugins answer to a hook.

        That module, `own`, comes first. With `types`, a plugin that has components is asked only
        if it has one of these. A plugin that raises, or answers with something else, is left out
        with a warning.
        """
        if own is not None and not self._manager.is_registered(own):
            self._manager.register(own)
        packages = [each.entry_point for each in self.plugins if each.origin != "built-in"]
        items: list[Any] = []
        for each in getattr(self._manager.hook, hook).get_hookimpls():
            names = self._records[each.plugin].names if each.plugin in self._records else ()
            if names and types is not None and types.isdisjoint(names):
                continue
            try:
                with process_kept():
                    answer = each.function(*(arguments[name] for name in each.argnames))
                    answered = answer.items() if isinstance(answer, Mapping) else answer or ()
                    items += map(partial(_item, hook), answered)
            except (Exception, SystemExit) as error:
                warn(
                    f"{hook} of {each.plugin_name} is left out: it raised {said(error)}"
                    f"{place(error, *packages)}; TRIBO_DISABLE_PLUGINS leaves a plugin out",
                )
        return items

    def choices(self, kind: str) -> str:
        """Return the usable names of one kind as text."""
        # Which are of this kind is not known before they are imported.
        names = ", ".join(self.names(kind)) or "none"
        return f"{names}; more: tribo plugins list" if self.waiting else names

    def load(self, plugin: Plugin) -> None:
        """Import a plugin once; its status says whether that succeeded."""
        if plugin.status != "available":
            return
        plugin.status = "loaded"
        try:
            with process_kept():
                self._register(plugin)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            plugin.status = "broken"
            plugin.reason = fault(error, plugin.entry_point)

    def _register(self, plugin: Plugin) -> None:
        """Register a plugin with the plugin manager, and ask it for its components."""
        module = plugin.load()
        self._manager.register(module)
        try:
            self._manager.check_pending()
            others = self._manager.get_plugins() - {module}
            classes = offered(self._manager.subset_hook_caller("tribo_components", others)())
            if plugin.origin != "installed" and (taken := self.owners.keys() & classes):
                name = min(taken)
                raise ValueError(f"{name!r} is offered by {self.owners[name]} already")
            if plugin.origin == "installed" and set(plugin.names) != set(classes):
                raise ValueError(
                    f"its entry points declare {', '.join(plugin.names) or 'none'}, but its hook "
                    "tribo_components, marked with @hookimpl, returns "
                    f"{', '.join(classes) or 'nothing'}"
                )
        except BaseException:
            self._manager.unregister(module)
            raise
        plugin.names, plugin.classes = tuple(classes), classes
        self._records[module] = plugin


@cache
def default_registry() -> Registry:
    """Return the registry of the built-in and the installed plugins."""
    return Registry([builtin(), *installed()])


def material_files() -> list[Path]:
    """Return the files ``materials.toml`` of installed packages, none of which is imported."""
    usable = (p for p in default_registry().plugins if p.usable and p.origin == "installed")
    specs = map(find_spec, sorted({plugin.entry_point.partition(".")[0] for plugin in usable}))
    files = (
        Path(spec.origin).with_name("materials.toml") for spec in specs if spec and spec.origin
    )
    return [file for file in files if file.is_file()]


def _item(hook: str, item: object) -> object:
    """Return an item of an answer to a hook, if it is of the class that the hook asks for."""
    kind = hookspecs.ITEMS.get(hook)
    if kind is not None and not isinstance(item, kind):
        raise TypeError(f"it answered with a {type(item).__name__}, not a {kind.__name__}")
    return item


def from_packages(hook: str, own: object = None, **asked: Any) -> list[Any]:
    """Return answers of `own`, of imported plugins and of plugins with hooks alone; see `ask`."""
    registry = default_registry()
    for plugin in registry.plugins:
        if plugin.usable and not plugin.names:
            registry.load(plugin)
    return registry.ask(hook, own, **asked)


def from_plugins_of(result: Result, hook: str) -> list[Any]:
    """Return answers of the plugins of a result's models and of plugins with hooks alone.

    Plugins that are not installed are left out; see `ask`.
    """
    types = {str(made["type"]) for made in result.provenance["components"].values()}
    for name in sorted(types):
        with suppress(CaseError):
            default_registry().find(name)
    return from_packages(hook, types=types, result=result)


def place(error: BaseException, *entry_points: str) -> str:
    """Return file and line of the innermost call in plugins, as text; empty if there is none."""
    if isinstance(error, SyntaxError) and error.filename:
        return f" ({error.filename}, line {error.lineno})"
    packages = {re.split("[.:]", entry_point)[0] for entry_point in entry_points}
    places = [
        (frame.f_code.co_filename, line)
        for frame, line in walk_tb(error.__traceback__)
        if str(frame.f_globals.get("__name__")).partition(".")[0] in packages
    ]
    return f" ({places[-1][0]}, line {places[-1][1]})" if places else ""


def fault(error: BaseException, *entry_points: str) -> str:
    """Return the message of an error, with its type and place if a plugin raised it."""
    where = place(error, *entry_points)
    return said(error) + where if where else " ".join(str(error).split())


@contextmanager
def process_kept() -> Iterator[None]:
    """Restore folder, warning filters and numpy's errors afterwards; print to stderr meanwhile."""
    with ExitStack() as kept, redirect_stdout(sys.stderr), warnings.catch_warnings(), np.errstate():
        # The folder may have been deleted.
        with suppress(FileNotFoundError):
            kept.callback(os.chdir, os.getcwd())
        yield
