"""Which versions, which classes and which plugins made a result."""

from __future__ import annotations

import json
import platform
import sys
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from hashlib import sha256
from importlib import metadata
from itertools import takewhile
from pathlib import Path

from tribo.core.distributions import entry_points
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
    at = origin.get("commit") or origin.get("code") or ""
    state = f" (code {at[:10]})" if at else ""
    return f"{origin['class']} of {origin['distribution']} {origin['version']}{state}".strip()


def _origin(component: Component[ComponentConfig]) -> dict[str, object]:
    cls = type(component)
    distribution = _distribution(cls.__module__)
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
        if origin["editable"]:
            # The version says nothing of what is edited in place.
            origin["code"] = _code(cls.__module__.split(".")[0])
        if "vcs_info" in source:
            origin["commit"] = source["vcs_info"].get("commit_id", "")
    return origin


@cache
def _code(package: str) -> str:
    """Return a hash of the source files of a top-level package that is imported."""
    digest = sha256()
    for folder in getattr(sys.modules[package], "__path__", ()):
        for path in sorted(Path(folder).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def _shared(left: Sequence[str], right: Sequence[str]) -> int:
    """Return how many parts two dotted paths share from their beginning."""
    pairs = zip(left, right, strict=False)
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))


@cache
def _named_modules() -> tuple[tuple[list[str], metadata.Distribution], ...]:
    """Return the modules that entry points name, in parts, each with its distribution."""
    return tuple(
        (point.value.split(":")[0].strip().split("."), distribution)
        for distribution, point in entry_points()
        if point.group.startswith("tribo.v") or point.group == "console_scripts"
    )


@cache
def _distribution(module: str) -> metadata.Distribution | None:
    """Return the distribution that a module came with."""
    # An editable installation lists no packages, but its entry points name modules. Of
    # distributions that share a namespace, that of the longest common path is meant.
    parts = module.split(".")
    best: tuple[int, metadata.Distribution | None] = (0, None)
    for named, distribution in _named_modules():
        common = _shared(named, parts)
        if common > best[0]:
            best = common, distribution
    if best[1] is not None:
        return best[1]
    names = metadata.packages_distributions().get(parts[0], [])
    return metadata.distribution(names[0]) if names else None


def _version(distribution: str) -> str:
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return ""
