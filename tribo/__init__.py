"""tribo: simulate wear, with every model a plugin.

Everything that a user types and a plugin needs is a name of this package; what
lies in its modules is not part of the contract. Names are imported when first
used, so that ``import tribo`` stays fast.
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
    from tribo.case import Stop as Stop
    from tribo.component import Component as Component
    from tribo.config.load import load_case as load_case
    from tribo.contact.bounded_cg import solve_bounded as solve_bounded
    from tribo.contact.dcfft import DcFft as DcFft
    from tribo.contact.love import nyquist_compliance as nyquist_compliance
    from tribo.contact.operator import HalfSpace as HalfSpace
    from tribo.contact.operator import Operator as Operator
    from tribo.contact.periodic import Periodic as Periodic
    from tribo.contact.residuals import residuals as residuals
    from tribo.contact.solver import ContactSolver as ContactSolver
    from tribo.contact.winkler import Winkler as Winkler
    from tribo.core.arrays import Array as Array
    from tribo.core.contact import ContactProblem as ContactProblem
    from tribo.core.contact import ContactSolution as ContactSolution
    from tribo.core.contact import ContactSystem as ContactSystem
    from tribo.core.contact import Residuals as Residuals
    from tribo.core.contact import WearCompliance as WearCompliance
    from tribo.core.errors import CaseError as CaseError
    from tribo.core.errors import Interrupted as Interrupted
    from tribo.core.errors import NumericalError as NumericalError
    from tribo.core.errors import TriboError as TriboError
    from tribo.core.errors import TriboWarning as TriboWarning
    from tribo.core.fields import ContactConditions as ContactConditions
    from tribo.core.fields import Field as Field
    from tribo.core.fields import LocalConditions as LocalConditions
    from tribo.core.fields import WearRate as WearRate
    from tribo.core.grid import Grid as Grid
    from tribo.core.material import Material as Material
    from tribo.core.measures import BodyMeasures as BodyMeasures
    from tribo.core.measures import Measures as Measures
    from tribo.core.state import BodyInfo as BodyInfo
    from tribo.core.state import BodyState as BodyState
    from tribo.core.state import RunInfo as RunInfo
    from tribo.core.state import Snapshot as Snapshot
    from tribo.core.state import State as State
    from tribo.core.table import Table as Table
    from tribo.core.units import Quantity as Quantity
    from tribo.effects.effect import Effect as Effect
    from tribo.motion.exposure import Exposure as Exposure
    from tribo.motion.exposure import Stationary as Stationary
    from tribo.motion.exposure import Track as Track
    from tribo.motion.kinematics import Kinematics as Kinematics
    from tribo.motion.reciprocating import Reciprocating as Reciprocating
    from tribo.motion.unidirectional import Unidirectional as Unidirectional
    from tribo.observers.observer import Observer as Observer
    from tribo.registry.contributions import CaseTemplate as CaseTemplate
    from tribo.registry.contributions import ExportFormat as ExportFormat
    from tribo.registry.contributions import LabRow as LabRow
    from tribo.registry.hookspecs import hookimpl as hookimpl
    from tribo.registry.registry import Registry as Registry
    from tribo.result.read import Result as Result
    from tribo.result.read import open as open
    from tribo.simulation.run import Simulation as Simulation
    from tribo.stepping.explicit import Explicit as Explicit
    from tribo.stepping.implicit import Implicit as Implicit
    from tribo.study.calibration.calibrate import calibrate as calibrate
    from tribo.study.calibration.outcome import Calibration as Calibration
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

_NAMES = {
    "tribo.case": "Body Case Friction Load Output Stop",
    "tribo.component": "Component",
    "tribo.config.load": "load_case",
    "tribo.contact.bounded_cg": "solve_bounded",
    "tribo.contact.dcfft": "DcFft",
    "tribo.contact.love": "nyquist_compliance",
    "tribo.contact.operator": "HalfSpace Operator",
    "tribo.contact.periodic": "Periodic",
    "tribo.contact.residuals": "residuals",
    "tribo.contact.solver": "ContactSolver",
    "tribo.contact.winkler": "Winkler",
    "tribo.core.arrays": "Array",
    "tribo.core.contact": "ContactProblem ContactSolution ContactSystem Residuals WearCompliance",
    "tribo.core.errors": "CaseError Interrupted NumericalError TriboError TriboWarning",
    "tribo.core.fields": "ContactConditions Field LocalConditions WearRate",
    "tribo.core.grid": "Grid",
    "tribo.core.material": "Material",
    "tribo.core.measures": "BodyMeasures Measures",
    "tribo.core.state": "BodyInfo BodyState RunInfo Snapshot State",
    "tribo.core.table": "Table",
    "tribo.core.units": "Quantity",
    "tribo.effects.effect": "Effect",
    "tribo.motion.exposure": "Exposure Stationary Track",
    "tribo.motion.kinematics": "Kinematics",
    "tribo.motion.reciprocating": "Reciprocating",
    "tribo.motion.unidirectional": "Unidirectional",
    "tribo.observers.observer": "Observer",
    "tribo.registry.contributions": "CaseTemplate ExportFormat LabRow",
    "tribo.registry.hookspecs": "hookimpl",
    "tribo.registry.registry": "Registry",
    "tribo.result.read": "Result open",
    "tribo.simulation.run": "Simulation",
    "tribo.stepping.explicit": "Explicit",
    "tribo.stepping.implicit": "Implicit",
    "tribo.study.calibration.calibrate": "calibrate",
    "tribo.study.calibration.outcome": "Calibration",
    "tribo.study.comparison": "Comparison compare",
    "tribo.study.sweeping.sweep": "Sweep sweep",
    "tribo.surfaces.cylinder": "Cylinder",
    "tribo.surfaces.flat": "Flat",
    "tribo.surfaces.paraboloid": "Paraboloid",
    "tribo.surfaces.sphere": "Sphere",
    "tribo.surfaces.surface": "Surface",
    "tribo.units": "GPa Hz MPa N Pa hour kHz kN kPa kg km mN mg minute mm ms nm um",
    "tribo.wear.archard": "Archard",
    "tribo.wear.law": "WearLaw",
    "tribo.wear.power": "Power",
}
_HOME = {name: module for module, names in _NAMES.items() for name in names.split()}

__all__ = [*_HOME]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'tribo' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_HOME)
