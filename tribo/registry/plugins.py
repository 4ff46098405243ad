"""Find the plugins that are installed, without importing them."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from importlib import metadata
from typing import TYPE_CHECKING, Literal

from packaging.utils import canonicalize_name

from tribo.core.distributions import entry_points
from tribo.core.errors import warn
from tribo.registry.hookspecs import GROUP, PROJECT, api_version

if TYPE_CHECKING:
    from tribo.component import Component

DISABLED = "TRIBO_DISABLE_PLUGINS"
ONLY = "TRIBO_PLUGINS"

Status = Literal["available", "loaded", "disabled", "broken", "incompatible"]


@dataclass(eq=False)
class Plugin:
    """The record of a plugin: where it is from, its status and its components.

    It came with a version of a distribution, or none, and lies in the module `entry_point`. Its
    status is ``available`` (not imported yet), ``loaded``, ``disabled`` by the user, ``broken`` (it
    raised, breaks the contract of plugins, or did not end in time) or ``incompatible`` (it is for
    another contract), the `reason` why it cannot be used. `names` are those that its entry points
    declare, `classes` the components by name once `load`, which returns the object that carries the
    hooks, has imported it.

    Examples
    --------
    >>> own = tribo.Registry.with_plugins().plugins[0]
    >>> own.origin, own.status, "archard" in own.names
    ('built-in', 'loaded', True)
    """

    distribution: str
    version: str
    entry_point: str
    origin: Literal["built-in", "installed", "given", "file"]
    status: Status = "available"
    reason: str = ""
    names: tuple[str, ...] = ()
    load: Callable[[], object] = field(repr=False, kw_only=True)
    classes: dict[str, type[Component]] = field(default_factory=dict, repr=False)

    def __str__(self) -> str:
        return f"{self.distribution} {self.version}".rstrip()

    @property
    def usable(self) -> bool:
        """Whether it can be used, as far as is known."""
        return self.status in ("available", "loaded")

    @property
    def facts(self) -> dict[str, str]:
        """All but its components, as plain data."""
        left_out = ("names", "load", "classes")
        return {key: value for key, value in vars(self).items() if key not in left_out}


def builtin() -> Plugin:
    """Return the plugin that offers the components of tribo itself."""
    from tribo.registry import builtin as models

    version = ""
    with suppress(metadata.PackageNotFoundError):
        version = metadata.version("tribo")
    return Plugin("tribo", version, models.__name__, "built-in", "loaded", load=lambda: models)


def given(plugin: object) -> Plugin:
    """Return the record of a module, or any other object, that implements hooks."""
    name = str(getattr(plugin, "__name__", type(plugin).__name__))
    version = str(getattr(plugin, "__version__", ""))
    return Plugin(name, version, name, "given", "loaded", load=lambda: plugin)


def installed() -> list[Plugin]:
    """Return the plugins of installed distributions, sorted; imports none.

    An entry point ``acme.fretting = "acme_tribo"`` in the group ``tribo.2`` declares that the
    module ``acme_tribo`` offers a component of that name; an entry point named after its
    distribution, as ``acme-tribo = "acme_tribo.hooks"``, that it has hooks and no component. The
    number is the contract's: a distribution that has only other groups is ``incompatible``. Plugins
    that declare the same name are ``broken``. The environment variable TRIBO_DISABLE_PLUGINS lists
    distributions to leave out, ``*`` for all; TRIBO_PLUGINS the only ones that may take part.
    """
    found: dict[tuple[str, str], Plugin] = {}
    declared = list(entry_points(PROJECT))
    compatible = {distribution.name for distribution, point in declared if point.group == GROUP}
    for distribution, point in declared:
        if point.group != GROUP and distribution.name in compatible:
            continue
        plugin = found.setdefault(
            (distribution.name, point.value),
            Plugin(
                distribution.name, distribution.version, point.value, "installed", load=point.load
            ),
        )
        if point.group != GROUP:
            plugin.status = "incompatible"
            plugin.reason = (
                f"its entry points are in the group {point.group!r}; this tribo, of contract "
                f"{api_version}, needs them in {GROUP!r}; see the page "
                "'The contract of plugins'"
            )
        if point.name == distribution.name:
            continue
        plugin.names += (point.name,)
        if plugin.usable and "." not in point.name:
            plugin.status = "broken"
            plugin.reason = (
                f"{point.name!r} needs a prefix, as in 'acme.fretting'; others are tribo's own"
            )
    plugins = [found[key] for key in sorted(found)]
    _choose(plugins)
    claims = Counter(name for plugin in plugins if plugin.usable for name in plugin.names)
    for plugin in plugins:
        if plugin.usable and (name := next((n for n in plugin.names if claims[n] > 1), "")):
            plugin.status = "broken"
            plugin.reason = f"another package offers {name!r} too; uninstall or disable one"
    return plugins


def _choose(plugins: list[Plugin]) -> None:
    """Disable the plugins that the environment turns off, and warn of names that none has."""
    off, only = (
        {canonicalize_name(part.strip()) for part in os.environ.get(variable, "").split(",")}
        for variable in (DISABLED, ONLY)
    )
    names = {canonicalize_name(plugin.distribution) for plugin in plugins}
    for plugin in plugins:
        name = canonicalize_name(plugin.distribution)
        if off & {name, "*"}:
            plugin.status, plugin.reason = "disabled", f"turned off by {DISABLED}"
        elif ONLY in os.environ and name not in only:
            reason = f"not among those that {ONLY} names"
            plugin.status, plugin.reason = "disabled", reason
    for name in sorted((off | only) - names - {"*", ""}):
        warn(f"no plugin is called {name!r}")
