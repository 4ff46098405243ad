"""Ask all installed plugins, none of which may end this process."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import Any

from tribo.core.errors import CaseError, warn
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.probe import probe_all
from tribo.registry.registry import Registry, default_registry


def choose(hook: str, name: str, words: str, own: Iterable[str] = ()) -> Any:
    """Return the format or template of this name that a plugin offers by `hook`.

    `words` names its sort in messages: ``"format"`` or ``"template"``; `own` are tribo's own names,
    which do not include this one.
    """
    known = {each.name: each for each in from_all_plugins(hook)}
    if name not in known:
        names = [*own, *known]
        meant = suggestion(did_you_mean(name, names))
        raise CaseError(f"no {words} is called {name!r}{meant} Known: {', '.join(names)}")
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
    usable = [plugin for plugin in registry.plugins if plugin.usable]
    # Where no process can be started, as in a browser, they are imported untried.
    with suppress(OSError):
        for plugin, tried in zip(usable, probe_all(usable), strict=True):
            if not tried.usable:
                plugin.status, plugin.reason = tried.status, tried.reason
    registry.load_all()
    for plugin in registry.plugins:
        if not plugin.usable and plugin.status != "disabled":
            warn(f"{plugin} is left out: {plugin.reason}")
