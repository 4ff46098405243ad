"""Finding plugins without importing them, and importing one without trusting it."""

from __future__ import annotations

import os
import re
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, redirect_stdout, suppress
from dataclasses import dataclass, replace
from importlib import import_module, metadata

import numpy as np

from tribo.core.distributions import with_entry_points
from tribo.core.words import said
from tribo.registry.kinds import KINDS
from tribo.registry.names import name_fault
from tribo.registry.offers import offers
from tribo.registry.records import ComponentRecord, Name, PluginRecord

API = 1
"""Version of the interfaces, which entry-point groups carry."""

_GROUP = re.compile(r"tribo\.v(?P<api>\d+)(?:\.(?P<kind>.*))?")


def group(kind: str) -> str:
    """Return the entry-point group of a kind, as ``tribo.v1.wear_law``."""
    return f"tribo.v{API}.{kind}"


def is_group(name: str) -> bool:
    """Return whether an entry-point group is one of plugins, of whatever interface version."""
    return bool(_GROUP.fullmatch(name))


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
    of that name. The entry points of one module are one plugin. Groups of
    other versions of the interfaces count only where a distribution has none
    of this version: then it is incompatible.
    """
    found: list[Source] = []
    for distribution, points in with_entry_points("tribo.v"):
        ours = [point for point in points if is_group(point.group)]
        if ours:
            found += _sources(distribution.name, distribution.version, ours)
    return sorted(found, key=lambda source: (source.record.distribution, source.record.entry_point))


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


def load(source: Source) -> tuple[PluginRecord, tuple[ComponentRecord, ...]]:
    """Import a plugin and collect what it offers.

    Whatever it raises, `SystemExit` included, marks it as broken; a broken
    plugin offers nothing. So does a hook that tribo does not know, and a
    difference between what the entry points declare and the hooks offer.
    What it prints goes to stderr: stdout belongs to the command. The working
    directory, the warning filters and numpy's treatment of errors stay as
    they are, whatever it sets.
    """
    record = replace(source.record, status="loaded")
    try:
        with _process_kept():
            return record, offers(source.load(), record, source.declared)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        return replace(record, status="broken", reason=said(error)), ()


@contextmanager
def _process_kept() -> Iterator[None]:
    with ExitStack() as kept, redirect_stdout(sys.stderr), warnings.catch_warnings(), np.errstate():
        # A directory that was deleted cannot be gone back to.
        with suppress(FileNotFoundError):
            kept.callback(os.chdir, os.getcwd())
        yield


def _sources(
    distribution: str, version: str, points: list[metadata.EntryPoint]
) -> Iterator[Source]:
    current = [point for point in points if _api_and_kind(point)[0] == API]
    modules: dict[str, list[metadata.EntryPoint]] = {}
    for point in current or points:
        modules.setdefault(point.value, []).append(point)
    for module in sorted(modules):
        record = PluginRecord(distribution, version, module, "installed", status="available")
        if not current:
            record = replace(record, status="incompatible", reason=_incompatible(points))
        yield _source(record, modules[module])


def _source(record: PluginRecord, points: list[metadata.EntryPoint]) -> Source:
    declared = tuple(dict.fromkeys((_api_and_kind(point)[1], point.name) for point in points))
    if record.status == "available":
        for kind, name in declared:
            reason = name_fault(name)
            if kind not in KINDS:
                unknown = group(kind).rstrip(".")
                reason = f"entry-point group {unknown!r} is unknown; use one of {_groups()}"
            if reason:
                record = replace(record, status="broken", reason=reason)
    return Source(record, declared, points[0].load)


def _incompatible(points: list[metadata.EntryPoint]) -> str:
    versions = sorted({_api_and_kind(point)[0] for point in points})
    newer = "a newer tribo" if versions[-1] > API else "a newer version of it"
    made = " and ".join(map(str, versions))
    return f"made for interface version {made}, this tribo has {API}; install {newer}"


def _api_and_kind(point: metadata.EntryPoint) -> tuple[int, str]:
    match = _GROUP.fullmatch(point.group)
    assert match is not None
    return int(match["api"]), match["kind"] or ""


def _groups() -> str:
    return ", ".join(group(kind) for kind in KINDS)
