"""tribo: simulate wear, with every model a plugin.

Names are imported when first used, so that ``import tribo`` stays fast.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tribo.case import Body as Body
    from tribo.case import Case as Case
    from tribo.case import Friction as Friction
    from tribo.case import Load as Load
    from tribo.case import Output as Output
    from tribo.config.load import load_case as load_case
    from tribo.config.stop import Stop as Stop
    from tribo.contact.dcfft import DcFft as DcFft
    from tribo.contact.periodic import Periodic as Periodic
    from tribo.contact.solver import ContactSolver as ContactSolver
    from tribo.contact.winkler import Winkler as Winkler
    from tribo.core.errors import CaseError as CaseError
    from tribo.core.errors import Interrupted as Interrupted
    from tribo.core.errors import NumericalError as NumericalError
    from tribo.core.errors import TriboError as TriboError
    from tribo.core.errors import TriboWarning as TriboWarning
    from tribo.core.fields import Field as Field
    from tribo.core.fields import WearRate as WearRate
    from tribo.core.grid import Grid as Grid
    from tribo.core.material import Material as Material
    from tribo.core.units import Quantity as Quantity
    from tribo.effects.effect import Effect as Effect
    from tribo.motion.kinematics import Kinematics as Kinematics
    from tribo.motion.reciprocating import Reciprocating as Reciprocating
    from tribo.motion.unidirectional import Unidirectional as Unidirectional
    from tribo.observers.observer import Observer as Observer
    from tribo.registry.hookspecs import hookimpl as hookimpl
    from tribo.registry.registry import Registry as Registry
    from tribo.result.read import Result as Result
    from tribo.simulation.run import Simulation as Simulation
    from tribo.stepping.explicit import Explicit as Explicit
    from tribo.stepping.implicit import Implicit as Implicit
    from tribo.study.comparison import Comparison as Comparison
    from tribo.study.comparison import compare as compare
    from tribo.study.sweeping.sweep import Sweep as Sweep
    from tribo.study.sweeping.sweep import sweep as sweep
    from tribo.surfaces.cylinder import Cylinder as Cylinder
    from tribo.surfaces.flat import Flat as Flat
    from tribo.surfaces.paraboloid import Paraboloid as Paraboloid
    from tribo.surfaces.sphere import Sphere as Sphere
    from tribo.surfaces.surface import Surface as Surface
    from tribo.units import GPa as GPa
    from tribo.units import Hz as Hz
    from tribo.units import MPa as MPa
    from tribo.units import N as N
    from tribo.units import Pa as Pa
    from tribo.units import hour as hour
    from tribo.units import kg as kg
    from tribo.units import kHz as kHz
    from tribo.units import km as km
    from tribo.units import kN as kN
    from tribo.units import kPa as kPa
    from tribo.units import mg as mg
    from tribo.units import minute as minute
    from tribo.units import mm as mm
    from tribo.units import mN as mN
    from tribo.units import ms as ms
    from tribo.units import nm as nm
    from tribo.units import um as um
    from tribo.wear.archard import Archard as Archard
    from tribo.wear.law import WearLaw as WearLaw
    from tribo.wear.power import Power as Power

_HOME = {
    "Archard": "tribo.wear.archard",
    "Body": "tribo.case",
    "Case": "tribo.case",
    "CaseError": "tribo.core.errors",
    "Comparison": "tribo.study.comparison",
    "ContactSolver": "tribo.contact.solver",
    "Cylinder": "tribo.surfaces.cylinder",
    "DcFft": "tribo.contact.dcfft",
    "Effect": "tribo.effects.effect",
    "Explicit": "tribo.stepping.explicit",
    "Field": "tribo.core.fields",
    "Flat": "tribo.surfaces.flat",
    "Friction": "tribo.case",
    "Grid": "tribo.core.grid",
    "Implicit": "tribo.stepping.implicit",
    "Interrupted": "tribo.core.errors",
    "Kinematics": "tribo.motion.kinematics",
    "Load": "tribo.case",
    "Material": "tribo.core.material",
    "NumericalError": "tribo.core.errors",
    "Observer": "tribo.observers.observer",
    "Output": "tribo.case",
    "Paraboloid": "tribo.surfaces.paraboloid",
    "Periodic": "tribo.contact.periodic",
    "Power": "tribo.wear.power",
    "Quantity": "tribo.core.units",
    "Reciprocating": "tribo.motion.reciprocating",
    "Registry": "tribo.registry.registry",
    "Result": "tribo.result.read",
    "Simulation": "tribo.simulation.run",
    "Sphere": "tribo.surfaces.sphere",
    "Stop": "tribo.config.stop",
    "Surface": "tribo.surfaces.surface",
    "Sweep": "tribo.study.sweeping.sweep",
    "TriboError": "tribo.core.errors",
    "TriboWarning": "tribo.core.errors",
    "Unidirectional": "tribo.motion.unidirectional",
    "WearLaw": "tribo.wear.law",
    "WearRate": "tribo.core.fields",
    "Winkler": "tribo.contact.winkler",
    "compare": "tribo.study.comparison",
    "hookimpl": "tribo.registry.hookspecs",
    "load_case": "tribo.config.load",
    "sweep": "tribo.study.sweeping.sweep",
}
_UNITS = (
    "GPa",
    "Hz",
    "MPa",
    "N",
    "Pa",
    "hour",
    "kHz",
    "kN",
    "kPa",
    "kg",
    "km",
    "mN",
    "mg",
    "minute",
    "mm",
    "ms",
    "nm",
    "um",
)
_HOME.update(dict.fromkeys(_UNITS, "tribo.units"))

__all__ = [*_HOME]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'tribo' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_HOME)
