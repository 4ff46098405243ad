"""Find the plugins that are installed, without importing them."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from importlib import metadata
from typing import Literal

from packaging.requirements import Requirement

from tribo.core.distributions import applies, entry_points
from tribo.registry.hookspecs import PROJECT

Status = Literal["available", "loaded", "disabled", "broken", "incompatible", "conflict"]


@dataclass(frozen=True)
class Plugin:
    """What is known about a plugin.

    Parameters
    ----------
    distribution : str
        The distribution it came with.
    version : str
        Version of the distribution; empty if it states none.
    entry_point : str
        The module it lies in, as ``"acme_tribo.plugin"``.
    origin : str
        How it was found: ``"built-in"``, ``"installed"`` or ``"given"``.
    status : str
        ``available`` (not imported yet), ``loaded``, ``disabled`` by the user,
        ``broken`` (it raised, or breaks the contract of plugins) or
        ``incompatible`` (a requirement of its distribution is not met); in
        lists, a name that two plugins declare is in ``conflict``.
    reason : str
        Why it cannot be used; empty if it can.
    names : tuple of str
        The names that its entry points declare.
    load : callable
        Imports it and returns the object that carries the hooks.
    """

    distribution: str
    version: str
    entry_point: str
    origin: Literal["built-in", "installed", "given"]
    status: Status = "available"
    reason: str = ""
    names: tuple[str, ...] = ()
    load: Callable[[], object] = field(default=lambda: None, repr=False)

    def __str__(self) -> str:
        return f"{self.distribution} {self.version}".rstrip()

    @property
    def usable(self) -> bool:
        """Whether it can be used, as far as is known."""
        return self.status not in ("disabled", "broken", "incompatible")

    @property
    def facts(self) -> dict[str, str]:
        """All but its names, as plain data."""
        return {key: value for key, value in vars(self).items() if key not in ("names", "load")}

    @property
    def summary(self) -> str:
        """The summary of its distribution; empty if it has none."""
        with suppress(metadata.PackageNotFoundError, KeyError, ValueError):
            return metadata.metadata(self.distribution)["Summary"] or ""
        return ""


def builtin() -> Plugin:
    """Return the plugin that offers the components of tribo itself."""
    from tribo.registry import builtin as module

    version = ""
    with suppress(metadata.PackageNotFoundError):
        version = metadata.version("tribo")
    return Plugin("tribo", version, module.__name__, "built-in", "loaded", load=lambda: module)


def given(plugin: object) -> Plugin:
    """Return the record of a module, or any other object, that implements hooks."""
    name = str(getattr(plugin, "__name__", type(plugin).__name__))
    version = str(getattr(plugin, "__version__", ""))
    return Plugin(name, version, name, "given", "loaded", load=lambda: plugin)


def installed() -> list[Plugin]:
    """Return the plugins of installed distributions, sorted; imports none.

    An entry point ``acme.fretting = "acme_tribo"`` in the group ``tribo``
    declares that the module ``acme_tribo`` offers a component of that name.
    The entry points of one module make one plugin.
    """
    found: dict[tuple[str, str], Plugin] = {}
    for distribution, point in entry_points(PROJECT):
        key = distribution.name, point.value
        plugin = found.get(key) or Plugin(
            distribution.name, distribution.version, point.value, "installed", load=point.load
        )
        if "." not in point.name:
            reason = f"{point.name!r} needs a prefix, as in 'acme.fretting'; others are tribo's own"
            plugin = replace(plugin, status="broken", reason=plugin.reason or reason)
        found[key] = replace(plugin, names=(*plugin.names, point.name))
    return [found[key] for key in sorted(found)]


def undeclared() -> list[str]:
    """Return a hint for each distribution that requires tribo and declares no plugin."""
    found = set()
    for distribution in metadata.distributions():
        with suppress(Exception):
            needed = [Requirement(text) for text in distribution.requires or () if applies(text)]
            requires_us = PROJECT in [requirement.name.lower() for requirement in needed]
            if requires_us and not distribution.entry_points.select(group=PROJECT):
                found.add(f"{distribution.name} {distribution.version}")
    return [
        f"{which} requires tribo but declares no plugin; if it is one, add an entry point to the "
        f"group {PROJECT!r}, and reinstall it"
        for which in sorted(found)
    ]
