"""Finding plugins and loading them, without letting one of them stop the program."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from importlib import import_module, metadata
from typing import Any

import pluggy

from tribo.interfaces.component import ComponentConfig
from tribo.registry import hookspecs
from tribo.registry.kinds import KINDS, Kind
from tribo.registry.records import ComponentRecord, PluginRecord

GROUP = "tribo.v1"
"""Entry-point group of plugins; it carries the version of the interfaces."""

Outcome = tuple[PluginRecord, tuple[ComponentRecord, ...]]


@dataclass(frozen=True)
class Source:
    """A plugin that was found; its code has not been imported yet.

    Parameters
    ----------
    record : PluginRecord
        What is known about it, as if it could be loaded.
    load : callable
        Imports it and returns the object that carries the hooks.
    """

    record: PluginRecord
    load: Callable[[], object]


def builtin() -> Source:
    """Return the plugin that offers the components of tribo itself."""
    module = "tribo.registry.builtin"
    try:
        version = metadata.version("tribo")
    except metadata.PackageNotFoundError:
        version = ""
    record = PluginRecord("tribo", version, module, "built-in")
    return Source(record, lambda: import_module(module))


def installed() -> list[Source]:
    """Return the plugins that installed distributions declare, sorted by name."""
    sources = []
    for point in metadata.entry_points(group=GROUP):
        distribution, version = (point.dist.name, point.dist.version) if point.dist else ("", "")
        where = f"{point.name} = {point.value}"
        sources.append(Source(PluginRecord(distribution, version, where, "installed"), point.load))
    return sorted(sources, key=lambda s: (s.record.distribution, s.record.entry_point))


def given(plugin: object) -> Source:
    """Return a plugin that is at hand: a module, or any object that carries hooks."""
    name = str(getattr(plugin, "__name__", type(plugin).__name__))
    version = str(getattr(plugin, "__version__", ""))
    return Source(PluginRecord(name, version, name, "given"), lambda: plugin)


def load(sources: Iterable[Source]) -> list[Outcome]:
    """Load plugins and collect what each offers.

    Whatever a plugin raises, `SystemExit` included, marks that plugin as
    broken and leaves the others alone.

    Returns
    -------
    list of (PluginRecord, tuple of ComponentRecord)
        One entry a source, in order; a broken plugin offers nothing.
    """
    manager = pluggy.PluginManager(hookspecs.PROJECT)
    manager.add_hookspecs(hookspecs)
    return [_load(manager, source) for source in sources]


def _load(manager: pluggy.PluginManager, source: Source) -> Outcome:
    record = source.record
    # Not the entry point's name alone: two distributions may use the same one.
    name = f"{record.distribution}:{record.entry_point}"
    plugin = None
    try:
        plugin = source.load()
        if manager.register(plugin, name) is None:
            return replace(record, status="disabled", reason="blocked"), ()
        manager.check_pending()
        return record, tuple(_offered(manager, plugin, record))
    except (Exception, SystemExit) as error:
        if manager.get_plugin(name) is not None:
            manager.unregister(name=name)
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        return replace(record, status="broken", reason=reason), ()


def _offered(
    manager: pluggy.PluginManager, plugin: object, record: PluginRecord
) -> Iterable[ComponentRecord]:
    seen: set[tuple[str, str]] = set()
    for kind in KINDS.values():
        # Not through the hook caller: there, one plugin that raises ends the call for all.
        for implementation in getattr(manager.hook, kind.hook).get_hookimpls():
            if implementation.plugin is plugin:
                for cls in implementation.function():
                    offer = ComponentRecord(kind.name, _name(cls, kind), cls, record)
                    if (offer.kind, offer.name) in seen:
                        raise ValueError(f"{kind.hook} returns {offer.name!r} twice")
                    seen.add((offer.kind, offer.name))
                    yield offer


def _name(cls: Any, kind: Kind) -> str:
    """Return the name of `cls` in a case; raise TypeError if it is not of this kind."""
    shown = getattr(cls, "__qualname__", repr(cls))
    if not (inspect.isclass(cls) and issubclass(cls, kind.interface)):
        raise TypeError(f"{kind.hook} returns {shown}, not a subclass of {_of(kind.interface)}")
    if inspect.isabstract(cls):
        missing = ", ".join(sorted(cls.__abstractmethods__))
        raise TypeError(f"{shown} does not define {missing}")
    config = getattr(cls, "Config", None)
    if not (inspect.isclass(config) and issubclass(config, ComponentConfig)):
        raise TypeError(f"{shown}.Config is not a subclass of {_of(ComponentConfig)}")
    name = config.model_fields["type"].default
    if not (isinstance(name, str) and name):
        raise TypeError(f'{config.__qualname__} needs a line: type: Literal["NAME"] = "NAME"')
    return name


def _of(cls: type) -> str:
    return f"{cls.__module__}.{cls.__qualname__}"
