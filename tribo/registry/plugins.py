"""The plugins that are at hand; none that is installed is imported here."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from importlib import metadata
from typing import Literal

from packaging.requirements import Requirement

from tribo.core.distributions import applies, with_entry_points
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
        ``broken`` (it raised, or does not hold to the contract) or
        ``incompatible`` (what its distribution requires is not there); in
        lists, a name that another claims too is in ``conflict``.
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
        """Whether anything of it can be used, as far as is known."""
        return self.status not in ("disabled", "broken", "incompatible")

    @property
    def facts(self) -> dict[str, str]:
        """What is known, as plain data."""
        return {key: value for key, value in vars(self).items() if key not in ("names", "load")}

    @property
    def summary(self) -> str:
        """What its distribution says it is about; empty if nothing."""
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
    """Return a plugin that is at hand: a module, or any object that carries hooks."""
    name = str(getattr(plugin, "__name__", type(plugin).__name__))
    version = str(getattr(plugin, "__version__", ""))
    return Plugin(name, version, name, "given", "loaded", load=lambda: plugin)


def installed() -> list[Plugin]:
    """Return the plugins of installed distributions, sorted.

    An entry point ``acme.fretting = "acme_tribo"`` in the group ``tribo`` says
    that the module ``acme_tribo`` hands over a component of that name. The
    entry points of one module are one plugin.
    """
    found: list[Plugin] = []
    for distribution, points in with_entry_points(f"[{PROJECT}]"):
        modules: dict[str, list[metadata.EntryPoint]] = {}
        for point in points:
            if point.group == PROJECT:
                modules.setdefault(point.value, []).append(point)
        for module, ours in modules.items():
            names = tuple(point.name for point in ours)
            plugin = Plugin(
                distribution.name,
                distribution.version,
                module,
                "installed",
                names=names,
                load=ours[0].load,
            )
            if bare := [name for name in names if "." not in name]:
                reason = (
                    f"{bare[0]!r} needs a prefix, as in 'acme.fretting'; others are tribo's own"
                )
                plugin = replace(plugin, status="broken", reason=reason)
            found.append(plugin)
    return sorted(found, key=lambda plugin: (plugin.distribution, plugin.entry_point))


def undeclared() -> list[str]:
    """Return a hint for each distribution that requires tribo and declares no plugin."""
    found = set()
    for distribution in metadata.distributions():
        with suppress(Exception):
            needs = {
                Requirement(text).name.lower()
                for text in filter(applies, distribution.requires or ())
            }
            if PROJECT in needs and not distribution.entry_points.select(group=PROJECT):
                found.add(f"{distribution.name} {distribution.version}")
    return [
        f"{which} requires tribo but declares no plugin; if it is one, add an entry point to the "
        f"group {PROJECT!r}, and reinstall it"
        for which in sorted(found)
    ]
