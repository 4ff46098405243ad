"""Which installed plugins may take part: the user's choice."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from dataclasses import replace

from packaging.utils import canonicalize_name

from tribo.core.errors import TriboWarning
from tribo.registry.plugins import Plugin

ONLY = "TRIBO_PLUGINS"
DISABLED = "TRIBO_DISABLE_PLUGINS"


def selected(plugins: Iterable[Plugin]) -> list[Plugin]:
    """Return the plugins; those that the environment turns off are marked as disabled.

    ``TRIBO_DISABLE_PLUGINS`` lists distributions, or names or prefixes of
    components, to leave out, separated by commas; ``*`` stands for all.
    ``TRIBO_PLUGINS`` lists the only ones that may take part. The command
    line's ``--no-plugin`` and ``--plugins`` set them, so that processes
    started from there make the same choice.
    """
    plugins = list(plugins)
    only, off = _listed(ONLY), _listed(DISABLED)
    for name in sorted((only | off).difference({"*"}, *map(_answers_to, plugins))):
        warnings.warn(f"no plugin is called {name!r}", TriboWarning, stacklevel=3)

    def chosen(plugin: Plugin) -> Plugin:
        answers = _answers_to(plugin)
        if off & (answers | {"*"}):
            reason = f"turned off by --no-plugin or {DISABLED}"
        elif ONLY in os.environ and not only & answers:
            reason = f"not among those that --plugins or {ONLY} names"
        else:
            return plugin
        return replace(plugin, status="disabled", reason=reason)

    return [chosen(plugin) for plugin in plugins]


def turn_off(names: Iterable[str]) -> None:
    """Leave these plugins out, in this process and its children."""
    os.environ[DISABLED] = ",".join([*sorted(_listed(DISABLED)), *names])


def keep_only(names: Iterable[str]) -> None:
    """Use these plugins only, in this process and its children."""
    os.environ[ONLY] = ",".join(names)


def _listed(variable: str) -> set[str]:
    parts = os.environ.get(variable, "").split(",")
    return {canonicalize_name(part.strip()) for part in parts if part.strip()}


def _answers_to(plugin: Plugin) -> set[str]:
    prefixes = [name.split(".")[0] for name in plugin.names]
    names = (plugin.distribution, *plugin.names, *prefixes)
    return {canonicalize_name(name) for name in names}
