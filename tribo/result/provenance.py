"""Which versions, which classes and which plugins made a result."""

from __future__ import annotations

import json
import platform
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from hashlib import sha256
from importlib import metadata
from os.path import commonprefix
from pathlib import Path
from typing import Any

from tribo.component import Component
from tribo.core.compiled import compiled
from tribo.core.distributions import entry_points

_IDENTITY = ("class", "distribution", "version", "code", "facts")
PACKAGES = ("tribo", "numpy", "scipy", "h5py", "pydantic", "pluggy")


@cache
def environment() -> Mapping[str, object]:
    """Return the versions of Python, the platform and the packages that matter."""
    fast = compiled()
    packages = {name: metadata.version(name) for name in PACKAGES}
    return {
        "python": platform.python_version(),
        "platform": platform.platform(),
        "packages": packages | (fast.versions() if fast else {}),
    }


def changed_components(
    before: Mapping[str, Any], now: Mapping[str, Any]
) -> list[tuple[str, str, str]]:
    """Return the components that have changed: place, before, now.

    `before` and `now` are provenance of results. A component is compared by its class,
    distribution, version, source code and stated facts; its configuration with the whole case.
    """
    old, new = before["components"], now["components"]
    changes = []
    for place in {**old, **new}:
        was, is_now = old.get(place, {}), new.get(place, {})
        differing = [key for key in _IDENTITY if was.get(key) != is_now.get(key)]
        if differing:
            changes.append((place, _words(was, differing), _words(is_now, differing)))
    return changes


def _words(origin: Mapping[str, Any], differing: Sequence[str]) -> str:
    """Return what differs in the origin of a component."""
    if not origin:
        return "not there"
    stated = "; ".join(f"{name} {text}" for name, text in origin["facts"].items())
    shown = {**origin, "code": origin["code"][:10], "facts": stated}
    return ", ".join(f"{key} {shown[key] or 'unknown'}" for key in differing)


def origin(component: Component) -> dict[str, object]:
    """Return where a component came from and how it is configured, as plain data."""
    cls = type(component)
    return {
        "type": cls.type,
        "class": f"{cls.__module__}.{cls.__qualname__}",
        **_installed(cls.__module__),
        # The version says nothing of what is edited in place.
        "code": _code(cls.__module__.split(".")[0]),
        "config": component.model_dump(mode="json"),
        "facts": {name: str(text) for name, text in component.facts().items()},
    }


@cache
def _installed(module: str) -> Mapping[str, object]:
    """Return the distribution that a module came with, its version, and how it was installed."""
    distribution = _distribution(module)
    if distribution is None:
        return {"distribution": "", "version": "", "editable": False}
    source = json.loads(distribution.read_text("direct_url.json") or "{}")
    commit = {"commit": source["vcs_info"].get("commit_id", "")} if "vcs_info" in source else {}
    return {
        "distribution": distribution.name,
        "version": distribution.version,
        "editable": bool(source.get("dir_info", {}).get("editable")),
        **commit,
    }


@cache
def _code(package: str) -> str:
    """Return a hash of the source files of a top-level package or module that is imported.

    Empty where there are none to read, as of what is typed in or piped to Python.
    """
    module = sys.modules.get(package)
    files = [
        path
        for folder in getattr(module, "__path__", ())
        for path in sorted(Path(folder).rglob("*.py"))
    ]
    file = getattr(module, "__file__", None)
    if not files and file:
        files = [Path(file)]
    digest = sha256()
    try:
        for path in files:
            digest.update(path.read_bytes())
    except OSError:
        return ""
    return digest.hexdigest() if files else ""


@cache
def _named_modules() -> tuple[tuple[list[str], metadata.Distribution], ...]:
    """Return the modules that entry points name, in parts, each with its distribution."""
    return tuple(
        (point.value.split(":")[0].strip().split("."), distribution)
        for group in ("tribo", "console_scripts")
        for distribution, point in entry_points(group)
    )


@cache
def _packages() -> Mapping[str, list[str]]:
    """Return the distributions of every installed package; to read their lists takes 0.3 s."""
    return metadata.packages_distributions()


def _distribution(module: str) -> metadata.Distribution | None:
    # An editable installation lists no packages, but its entry points name modules. Of
    # distributions that share a namespace, the longest common path is meant.
    parts = module.split(".")
    named = [each for each in _named_modules() if each[0][0] == parts[0]]
    if named:
        # Of parts, not of characters.
        return max(named, key=lambda each: len(commonprefix([each[0], parts])))[1]  # noqa: RUF071
    names = _packages().get(parts[0], [])
    return metadata.distribution(names[0]) if names else None
