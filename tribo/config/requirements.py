"""Check that the distributions a case requires are installed and usable."""

from __future__ import annotations

from collections.abc import Iterable

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tribo.core.distributions import applies, lacking
from tribo.core.errors import CaseError
from tribo.registry.plugins import Plugin


def check_requirements(requires: Iterable[str], plugins: Iterable[Plugin] = ()) -> None:
    """Raise `CaseError` unless every requirement, as ``"acme-tribo>=1.2"``, is met.

    One whose marker does not hold here is skipped. A distribution whose plugins are all disabled,
    broken or incompatible does not meet a requirement.
    """
    known = list(plugins)
    for text in filter(applies, requires):
        if lack := lacking(text):
            raise CaseError(f"{text!r} is needed, but {lack}; install it with pip", "requires")
        name = canonicalize_name(Requirement(text).name)
        found = [plugin for plugin in known if canonicalize_name(plugin.distribution) == name]
        if found and not any(plugin.usable for plugin in found):
            reason = f"the plugin {found[0]} is {found[0].status}: {found[0].reason}"
            raise CaseError(f"{text!r} is needed, but {reason}", "requires")
