"""Ask all installed plugins, none of which may end this process."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from tribo.core.errors import CaseError, warn
from tribo.core.words import unknown
from tribo.registry.child import in_child
from tribo.registry.plugins import Plugin
from tribo.registry.registry import Registry, default_registry


def choose(hook: str, name: str, words: str, own: Iterable[str] = ()) -> Any:
    """Return the format or template of this name that a plugin offers by `hook`.

    `words` names its sort in messages: ``"format"`` or ``"template"``; `own` are tribo's own names,
    which do not include this one.
    """
    known = {each.name: each for each in from_all_plugins(hook)}
    if name not in known:
        raise CaseError(unknown(words, name, [*own, *known]))
    return known[name]


def from_all_plugins(hook: str, own: object = None) -> list[Any]:
    """Return the items that `own` and all installed plugins answer to a hook; see `Registry.ask`.

    A warning names broken plugins.
    """
    registry = default_registry()
    import_all(registry)
    return registry.ask(hook, own)


def import_all(registry: Registry) -> None:
    """Import every plugin that can be imported, and warn of each that cannot be used.

    A child process imports them first; a plugin that ends it is not imported here.
    """
    try_out(registry.plugins)
    registry.load_all()
    for plugin in registry.plugins:
        if not plugin.usable and plugin.status != "disabled":
            warn(f"{plugin} is left out: {plugin.reason}")


def try_out(plugins: Iterable[Plugin]) -> None:
    """Import plugins in one child process, and mark those ``broken`` that fail there.

    If that process does not finish, each plugin has a process of its own; see `in_child` for its
    limits.
    """
    waiting = [plugin for plugin in plugins if plugin.status == "available"]
    reasons, ended = in_child(_imported, [(plugin,) for plugin in waiting])
    if ended and len(waiting) > 1:
        for plugin in waiting:
            try_out([plugin])
        return
    for plugin, reason in zip(waiting, [f"its import {ended}"] if ended else reasons, strict=True):
        if reason:
            plugin.status, plugin.reason = "broken", reason


def _imported(plugin: Plugin) -> str:
    """Import a plugin; return why it cannot be used, empty if it can."""
    tried = replace(plugin)
    Registry([tried]).load_all()
    return tried.reason
