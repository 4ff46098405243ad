"""tribo: simulate wear, with every model a plugin.

Names are imported when first used, so that ``import tribo`` stays fast.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tribo.config.case import Body as Body
    from tribo.config.case import Case as Case
    from tribo.config.load import load_case as load_case
    from tribo.core.errors import CaseError as CaseError
    from tribo.core.errors import Interrupted as Interrupted
    from tribo.core.errors import NumericalError as NumericalError
    from tribo.core.errors import TriboError as TriboError
    from tribo.core.errors import TriboWarning as TriboWarning
    from tribo.core.grid import Grid as Grid
    from tribo.core.material import Material as Material
    from tribo.registry.hookspecs import hookimpl as hookimpl
    from tribo.registry.registry import Registry as Registry
    from tribo.results.read import Result as Result
    from tribo.simulation.run import Simulation as Simulation

_HOME = {
    "Body": "tribo.config.case",
    "Case": "tribo.config.case",
    "CaseError": "tribo.core.errors",
    "Grid": "tribo.core.grid",
    "Interrupted": "tribo.core.errors",
    "Material": "tribo.core.material",
    "NumericalError": "tribo.core.errors",
    "Registry": "tribo.registry.registry",
    "Result": "tribo.results.read",
    "Simulation": "tribo.simulation.run",
    "TriboError": "tribo.core.errors",
    "TriboWarning": "tribo.core.errors",
    "hookimpl": "tribo.registry.hookspecs",
    "load_case": "tribo.config.load",
}

__all__ = [*_HOME]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'tribo' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_HOME)
