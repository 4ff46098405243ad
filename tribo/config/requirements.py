"""Are the distributions that a case asks for installed, and their plugins at hand?"""

from __future__ import annotations

from collections.abc import Iterable

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tribo.core.distributions import applies, lacking
from tribo.core.errors import CaseError
from tribo.registry.plugins import Plugin


def check_requirements(requires: Iterable[str], plugins: Iterable[Plugin] = ()) -> None:
    """Raise `CaseError` unless every requirement, as ``"acme-tribo>=1.2"``, is met.

    One whose marker, as ``; python_version < "3.12"``, does not hold here is none. A plugin
    of which nothing is usable (disabled, broken or incompatible) does not meet one.
    """
    found_as: dict[str, Plugin] = {}
    # Of the modules of a distribution, one that is usable counts.
    for plugin in sorted(plugins, key=lambda plugin: plugin.usable):
        found_as[canonicalize_name(plugin.distribution)] = plugin
    for text in filter(applies, requires):
        if lack := lacking(text):
            raise CaseError(f"{text!r} is needed, but {lack}; install it with pip", "requires")
        _check_usable(text, found_as.get(canonicalize_name(Requirement(text).name)))


def _check_usable(text: str, plugin: Plugin | None) -> None:
    if plugin is not None and not plugin.usable:
        raise CaseError(
            f"{text!r} is needed, but the plugin {plugin} is {plugin.status}: {plugin.reason}",
            "requires",
        )
