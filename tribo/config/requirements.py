"""Are the distributions that a case asks for installed, and their plugins at hand?"""

from __future__ import annotations

from collections.abc import Iterable
from importlib import metadata

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tribo.core.errors import CaseError
from tribo.registry.records import PluginRecord


def check_requirements(requires: Iterable[str], plugins: Iterable[PluginRecord] = ()) -> None:
    """Raise `CaseError` unless every requirement, as ``"acme-tribo>=1.2"``, is met.

    One whose marker, as ``; python_version < "3.12"``, does not hold here is none. A plugin
    of which nothing is usable (disabled, broken or incompatible) does not meet one.
    """
    found_as: dict[str, PluginRecord] = {}
    # Of the modules of a distribution, one that is usable counts.
    for plugin in sorted(plugins, key=lambda plugin: plugin.usable):
        found_as[canonicalize_name(plugin.distribution)] = plugin
    for text in requires:
        requirement = Requirement(text)
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        try:
            version = metadata.version(requirement.name)
        except metadata.PackageNotFoundError:
            found = "is not installed"
        else:
            if requirement.specifier.contains(version, prereleases=True):
                _check_usable(text, found_as.get(canonicalize_name(requirement.name)))
                continue
            found = f"is installed in version {version}"
        raise CaseError(
            f"{text!r} is needed, but {requirement.name} {found}; install it with pip", "requires"
        )


def _check_usable(text: str, plugin: PluginRecord | None) -> None:
    if plugin is not None and not plugin.usable:
        raise CaseError(
            f"{text!r} is needed, but the plugin {plugin} is {plugin.status}: {plugin.reason}",
            "requires",
        )
