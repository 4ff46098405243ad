"""Ask all installed plugins, none of which may end this process."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tribo.core.errors import CaseError, warn
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.probe import import_all
from tribo.registry.registry import default_registry


def choose(hook: str, name: str, words: str, own: Mapping[str, str] | None = None) -> Any:
    """Return the format or template of this name that a plugin offers by `hook`.

    `words` is what it is, for the message: ``"format"`` or ``"template"``; `own` are those of tribo
    itself, none of them called so, with what each is.
    """
    known = {each.name: each for each in from_all_plugins(hook)}
    if name not in known:
        summaries = {**(own or {}), **{each.name: each.summary for each in known.values()}}
        listed = "; ".join(f"{each} ({said.rstrip('.')})" for each, said in summaries.items())
        meant = suggestion(did_you_mean(name, summaries))
        raise CaseError(f"no {words} is called {name!r}{meant} Known: {listed}")
    return known[name]


def from_all_plugins(hook: str, own: object = None) -> list[Any]:
    """Return the items that `own` and all installed plugins answer to a hook; see `Registry.ask`.

    One that is broken is named.
    """
    registry = default_registry()
    for plugin in import_all(registry):
        warn(f"{plugin} is left out: {plugin.reason}")
    return registry.ask(hook, own)
