"""Everything a plugin needs, in one import; the rest of tribo is not part of the contract.

A plugin is a module with hooks that return its classes::

    from tribo.plugin import WearLaw, WearLawConfig, WearRate, hookimpl

and entry points that declare their names (see the page *Write a plugin*).
"""

from tribo.config.table import Table
from tribo.contact.bounded import solve_bounded
from tribo.contact.conditions import residuals
from tribo.contact.love import nyquist_compliance
from tribo.contact.operator import HalfSpace, Operator
from tribo.core.arrays import Array
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    Residuals,
    WearCompliance,
)
from tribo.core.errors import CaseError, NumericalError, TriboError, TriboWarning
from tribo.core.fields import ContactConditions, Field, LocalConditions, WearRate
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import BodyMeasures, Measures
from tribo.core.state import BodyInfo, BodyState, RunInfo, Snapshot, State
from tribo.core.units import Quantity
from tribo.interfaces.component import Component, ComponentConfig
from tribo.interfaces.contact import ContactSolver, ContactSolverConfig
from tribo.interfaces.effect import Effect, EffectConfig
from tribo.interfaces.exposure import Exposure, Stationary, Track
from tribo.interfaces.kinematics import Kinematics, KinematicsConfig
from tribo.interfaces.observer import Observer, ObserverConfig
from tribo.interfaces.surface import Surface, SurfaceConfig
from tribo.interfaces.wear import WearLaw, WearLawConfig
from tribo.registry.contributions import CaseTemplate, ExportFormat, LabRow
from tribo.registry.hookspecs import hookimpl
from tribo.results.read import Result

__all__ = [
    "Array",
    "BodyInfo",
    "BodyMeasures",
    "BodyState",
    "CaseError",
    "CaseTemplate",
    "Component",
    "ComponentConfig",
    "ContactConditions",
    "ContactProblem",
    "ContactSolution",
    "ContactSolver",
    "ContactSolverConfig",
    "ContactSystem",
    "Effect",
    "EffectConfig",
    "ExportFormat",
    "Exposure",
    "Field",
    "Grid",
    "HalfSpace",
    "Kinematics",
    "KinematicsConfig",
    "LabRow",
    "LocalConditions",
    "Material",
    "Measures",
    "NumericalError",
    "Observer",
    "ObserverConfig",
    "Operator",
    "Quantity",
    "Residuals",
    "Result",
    "RunInfo",
    "Snapshot",
    "State",
    "Stationary",
    "Surface",
    "SurfaceConfig",
    "Table",
    "Track",
    "TriboError",
    "TriboWarning",
    "WearCompliance",
    "WearLaw",
    "WearLawConfig",
    "WearRate",
    "hookimpl",
    "nyquist_compliance",
    "residuals",
    "solve_bounded",
]
