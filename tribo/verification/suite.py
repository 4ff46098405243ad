"""All problems with a known answer."""

from __future__ import annotations

import sys

from tribo.core.errors import PluginError
from tribo.registry.all_plugins import from_all_plugins
from tribo.registry.hookspecs import hookimpl
from tribo.verification import codes, contacts, formulas, plasticity, punches, strokes, wear
from tribo.verification.reference import Reference

_MODULES = (contacts, plasticity, wear, punches, strokes, formulas)
_FOUND = (value for module in _MODULES for value in vars(module).values())

REFERENCES = (*(known for known in _FOUND if isinstance(known, Reference)), *codes.REFERENCES)


@hookimpl(trylast=True)
def tribo_cases() -> tuple[Reference, ...]:
    """Offer the problems of the kernel."""
    return REFERENCES


def references() -> list[Reference]:
    """Return the problems of the kernel and those of the installed plugins.

    `PluginError` if one of those is no `Reference`.
    """
    found = from_all_plugins("tribo_cases", sys.modules[__name__])
    for each in found:
        if not isinstance(each, Reference):
            raise PluginError(f"a plugin's tribo_cases returns {each!r}, which is no Reference")
    return found
