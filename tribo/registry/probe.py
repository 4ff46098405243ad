"""Import plugins in a child process, so that they can neither hang nor crash this one."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from tribo.registry.child import in_child
from tribo.registry.plugins import Plugin
from tribo.registry.registry import Registry


def probe_all(plugins: Iterable[Plugin]) -> list[Plugin]:
    """Return the records of installed plugins after their import in one child process.

    If that process does not finish, each plugin has a process of its own; see `in_child` for its
    limit of time. A plugin that is not ``available`` is returned unchanged.
    """
    plugins = list(plugins)
    waiting = [plugin for plugin in plugins if plugin.status == "available"]
    tried = _tried(waiting) if waiting else []
    return [tried.pop(0) if plugin.status == "available" else plugin for plugin in plugins]


def _tried(plugins: list[Plugin]) -> list[Plugin]:
    facts, ended = in_child(_imported, [(plugin,) for plugin in plugins])
    if not ended:
        return [replace(each, **its) for each, its in zip(plugins, facts, strict=True)]
    if len(plugins) > 1:
        return [tried for plugin in plugins for tried in _tried([plugin])]
    return [replace(plugins[0], status="broken", reason=f"its import {ended}")]


def _imported(plugin: Plugin) -> dict[str, Any]:
    """Return the facts of an installed plugin after its import in this process."""
    Registry([plugin]).load_all()
    return plugin.facts
