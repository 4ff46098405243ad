"""All problems with a known answer."""

from __future__ import annotations

from tribo.core.errors import PluginError
from tribo.registry.registry import from_all_plugins
from tribo.verification import codes, contacts, formulas, plasticity, punches, strokes, wear
from tribo.verification.reference import Reference

_MODULES = (contacts, plasticity, wear, punches, strokes, formulas)
_FOUND = (value for module in _MODULES for value in vars(module).values())

REFERENCES = (*(known for known in _FOUND if isinstance(known, Reference)), *codes.REFERENCES)


def references() -> list[Reference]:
    """Return tribo's own problems and those of the installed plugins.

    `PluginError` if one of those is no `Reference`.
    """
    others = from_all_plugins("tribo_cases")
    for other in others:
        if not isinstance(other, Reference):
            raise PluginError(f"a plugin's tribo_cases returns {other!r}, which is no Reference")
    return [*REFERENCES, *others]
