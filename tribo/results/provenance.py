"""Which versions and which classes made a result."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Mapping
from importlib.metadata import PackageNotFoundError, packages_distributions, version

from tribo.interfaces.component import Component, ComponentConfig

PACKAGES = ("tribo", "numpy", "scipy", "h5py", "pydantic", "pluggy")


def provenance(
    components: Iterable[tuple[str, Component[ComponentConfig]]],
) -> dict[str, object]:
    """Return versions, and for each component its class, distribution and version.

    Parameters
    ----------
    components : iterable of (str, Component)
        Each with its place in the case.
    """
    owners = packages_distributions()
    return {
        "python": platform.python_version(),
        "platform": platform.platform(),
        "packages": {name: _version(name) for name in PACKAGES},
        "components": {place: _origin(component, owners) for place, component in components},
    }


def _origin(
    component: Component[ComponentConfig], owners: Mapping[str, list[str]]
) -> dict[str, str]:
    cls = type(component)
    package = cls.__module__.split(".")[0]
    # An editable installation lists no packages; its own name is the best guess.
    distribution = owners.get(package, [package])[0]
    return {
        "type": cls.type_name(),
        "class": f"{cls.__module__}.{cls.__qualname__}",
        "distribution": distribution if _version(distribution) else "",
        "version": _version(distribution),
    }


def _version(distribution: str) -> str:
    try:
        return version(distribution)
    except PackageNotFoundError:
        return ""
