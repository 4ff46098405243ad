"""Which versions, which classes and which plugins made a result."""

from __future__ import annotations

import json
import platform
from collections.abc import Iterable, Mapping
from functools import cache
from importlib import metadata

from tribo.interfaces.component import Component, ComponentConfig

PACKAGES = ("tribo", "numpy", "scipy", "h5py", "pydantic", "pluggy")


def provenance(
    components: Iterable[tuple[str, Component[ComponentConfig]]],
    plugins: Iterable[Mapping[str, object]] = (),
) -> dict[str, object]:
    """Return versions, and for each component its class, distribution and version.

    Parameters
    ----------
    components : iterable of (str, Component)
        Each with its place in the case.
    plugins : iterable of Mapping
        Every plugin that was found, loaded or not, as plain data.

    Returns
    -------
    dict
        Plain data, ready for JSON.
    """
    return {
        **environment(),
        "components": {place: _origin(component) for place, component in components},
        "plugins": [dict(plugin) for plugin in plugins],
    }


def environment() -> dict[str, object]:
    """Return the versions of Python, the platform and the packages that matter."""
    return {
        "python": platform.python_version(),
        "platform": platform.platform(),
        "packages": {name: _version(name) for name in PACKAGES},
    }


def changed_components(
    before: Mapping[str, object], now: Mapping[str, object]
) -> list[tuple[str, str, str]]:
    """Return the components whose class or version differ: place, before, now.

    Parameters
    ----------
    before, now : Mapping
        What `provenance` returned.
    """
    old, new = before["components"], now["components"]
    assert isinstance(old, dict)
    assert isinstance(new, dict)
    places = [place for place in {**old, **new} if old.get(place) != new.get(place)]
    return [(place, _words(old.get(place)), _words(new.get(place))) for place in places]


def _words(origin: dict[str, str] | None) -> str:
    if origin is None:
        return "nothing"
    commit = f" at {origin['commit'][:10]}" if origin.get("commit") else ""
    return f"{origin['class']} of {origin['distribution']} {origin['version']}{commit}".strip()


def _origin(component: Component[ComponentConfig]) -> dict[str, object]:
    cls = type(component)
    distribution = _distribution(cls.__module__.split(".")[0])
    origin: dict[str, object] = {
        "type": cls.type_name(),
        "class": f"{cls.__module__}.{cls.__qualname__}",
        "distribution": "",
        "version": "",
        "editable": False,
    }
    if distribution is not None:
        source = json.loads(distribution.read_text("direct_url.json") or "{}")
        origin["distribution"] = distribution.name
        origin["version"] = distribution.version
        origin["editable"] = bool(source.get("dir_info", {}).get("editable"))
        if "vcs_info" in source:
            origin["commit"] = source["vcs_info"].get("commit_id", "")
    return origin


@cache
def _distribution(package: str) -> metadata.Distribution | None:
    """Return the distribution that a top-level package came with."""
    # An editable installation lists no packages, but its entry points name them.
    everything = metadata.entry_points()
    for group in everything.groups:
        if group.startswith("tribo.v") or group == "console_scripts":
            for point in everything.select(group=group):
                if point.module.split(".")[0] == package and point.dist is not None:
                    return metadata.distribution(point.dist.name)
    names = metadata.packages_distributions().get(package, [])
    return metadata.distribution(names[0]) if names else None


def _version(distribution: str) -> str:
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return ""
