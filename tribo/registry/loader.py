"""Finding plugins without importing them, and importing one without trusting it."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from importlib import import_module, metadata
from typing import Any

import pluggy

from tribo.core.distributions import entry_points
from tribo.core.fields import Field
from tribo.interfaces.component import ComponentConfig
from tribo.registry import hookspecs
from tribo.registry.kinds import KINDS, Kind
from tribo.registry.records import ComponentRecord, PluginRecord

API = 1
"""Version of the interfaces, which entry-point groups carry."""

_GROUP = re.compile(r"tribo\.v(?P<api>\d+)(?:\.(?P<kind>.*))?")

Name = tuple[str, str]
"""Kind and name of a component."""


def group(kind: str) -> str:
    """Return the entry-point group of a kind, as ``tribo.v1.wear_law``."""
    return f"tribo.v{API}.{kind}"


@dataclass(frozen=True)
class Source:
    """A plugin that was found; its code has not been imported yet.

    Parameters
    ----------
    record : PluginRecord
        What is known about it so far.
    declared : tuple of (str, str) or None
        Kind and name of what it offers, as its entry points say; None where
        only its hooks can tell.
    load : callable
        Imports it and returns the object that carries the hooks.
    """

    record: PluginRecord
    declared: tuple[Name, ...] | None
    load: Callable[[], object]


def builtin() -> Source:
    """Return the plugin that offers the components of tribo itself."""
    module = "tribo.registry.builtin"
    try:
        version = metadata.version("tribo")
    except metadata.PackageNotFoundError:
        version = ""
    record = PluginRecord("tribo", version, module, "built-in")
    return Source(record, None, lambda: import_module(module))


def installed() -> list[Source]:
    """Return the plugins that installed distributions declare, sorted by distribution.

    An entry point ``acme.fretting = "acme_tribo"`` in the group
    ``tribo.v1.wear_law`` says that the module ``acme_tribo`` offers a wear law
    of that name. The entry points of one module are one plugin.
    """
    points: dict[tuple[str, str, str], list[metadata.EntryPoint]] = {}
    for distribution, point in entry_points():
        if _GROUP.fullmatch(point.group):
            key = (distribution.name, distribution.version, point.value)
            points.setdefault(key, []).append(point)
    return [_source(*key, points[key]) for key in sorted(points)]


def given(plugin: object) -> Source:
    """Return a plugin that is at hand: a module, or any object that carries hooks."""
    name = str(getattr(plugin, "__name__", type(plugin).__name__))
    version = str(getattr(plugin, "__version__", ""))
    return Source(PluginRecord(name, version, name, "given"), None, lambda: plugin)


def distribution_summary(plugin: PluginRecord) -> str:
    """Return what the plugin's distribution says it is about; empty if nothing."""
    try:
        return metadata.metadata(plugin.distribution)["Summary"] or ""
    except (metadata.PackageNotFoundError, KeyError, ValueError):
        return ""


def _source(
    distribution: str, version: str, module: str, points: list[metadata.EntryPoint]
) -> Source:
    record = PluginRecord(distribution, version, module, "installed", status="available")
    declared: list[Name] = []
    for point in points:
        match = _GROUP.fullmatch(point.group)
        assert match is not None
        kind, api = match["kind"], int(match["api"])
        if api != API:
            newer = "a newer tribo" if api > API else "a newer version of it"
            reason = f"made for interface version {api}, this tribo has {API}; install {newer}"
            record = replace(record, status="incompatible", reason=reason)
        elif kind not in KINDS:
            reason = f"entry-point group {point.group!r} is unknown; use one of {_groups()}"
            record = replace(record, status="broken", reason=reason)
        elif "." not in point.name:
            reason = (
                f"{point.name!r} needs a prefix, as in 'acme.{point.name}': names without one are "
                "tribo's own"
            )
            record = replace(record, status="broken", reason=reason)
        else:
            declared.append((kind, point.name))
    return Source(record, tuple(declared), lambda: points[0].load())


def _groups() -> str:
    return ", ".join(group(kind) for kind in KINDS)


def load(source: Source) -> tuple[PluginRecord, tuple[ComponentRecord, ...]]:
    """Import a plugin and collect what it offers.

    Whatever it raises, `SystemExit` included, marks it as broken; a broken
    plugin offers nothing. So does a hook that tribo does not know, and a
    difference between what the entry points declare and the hooks offer.
    """
    record = replace(source.record, status="loaded")
    manager = pluggy.PluginManager(hookspecs.PROJECT)
    manager.add_hookspecs(hookspecs)
    try:
        plugin = source.load()
        manager.register(plugin, record.entry_point)
        manager.check_pending()
        offers = tuple(_offered(manager, record))
        if source.declared is not None:
            _check_declared(source.declared, offers)
        return record, offers
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        return replace(record, status="broken", reason=_said(error)), ()


def _said(error: BaseException) -> str:
    try:
        text = " ".join(str(error).split())
    except Exception:
        text = "(its message cannot be shown)"
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _check_declared(declared: tuple[Name, ...], offers: tuple[ComponentRecord, ...]) -> None:
    offered = {(offer.kind, offer.name) for offer in offers}
    for kind, name in sorted(set(declared) - offered):
        hook = KINDS[kind].hook
        raise ValueError(
            f"its entry points declare the {KINDS[kind].words} {name!r}, but its hook {hook} does "
            "not return it"
        )
    for kind, name in sorted(offered - set(declared)):
        raise ValueError(
            f"its hooks return the {KINDS[kind].words} {name!r}, which no entry point in "
            f"{group(kind)!r} declares"
        )


def _offered(manager: pluggy.PluginManager, record: PluginRecord) -> Iterable[ComponentRecord]:
    seen: set[Name] = set()
    for kind in KINDS.values():
        for implementation in getattr(manager.hook, kind.hook).get_hookimpls():
            returned = implementation.function()
            if not isinstance(returned, Iterable):
                raise TypeError(
                    f"{kind.hook} returns {returned!r}; it must return a list of classes"
                )
            for cls in returned:
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
    _check_declarations(cls, shown)
    name = config.model_fields["type"].default
    if not (isinstance(name, str) and name):
        raise TypeError(f'{config.__qualname__} needs a line: type: Literal["NAME"] = "NAME"')
    return name


def _check_declarations(cls: type, shown: str) -> None:
    """Raise TypeError unless what a class declares of fields is declared as it must be."""
    for attribute in ("state_fields", "provides"):
        fields = getattr(cls, attribute, ())
        if not (isinstance(fields, tuple | list) and all(isinstance(f, Field) for f in fields)):
            raise TypeError(
                f"{shown}.{attribute} is {fields!r}; it must be a tuple of Field, as in "
                '(Field("name", "m", "What it means."),)'
            )
    names = getattr(cls, "requires", ())
    if not (isinstance(names, tuple | list) and all(isinstance(name, str) for name in names)):
        raise TypeError(
            f'{shown}.requires is {names!r}; it must be a tuple of names, as in ("temperature",)'
        )


def _of(cls: type) -> str:
    return f"{cls.__module__}.{cls.__qualname__}"
