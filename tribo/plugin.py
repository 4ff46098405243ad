"""Everything a plugin needs, in one import; the rest of tribo is not part of the contract.

A plugin is a module with hooks that return its classes::

    from tribo.plugin import WearLaw, WearRate, hookimpl

and entry points that declare their names (see the page *Write a plugin*).
"""

from tribo.component import Component
from tribo.contact.bounded import solve_bounded
from tribo.contact.conditions import residuals
from tribo.contact.love import nyquist_compliance
from tribo.contact.operator import HalfSpace, Operator
from tribo.contact.solver import ContactSolver
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
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.effects.effect import Effect
from tribo.motion.exposure import Exposure, Stationary, Track
from tribo.motion.kinematics import Kinematics
from tribo.observers.observer import Observer
from tribo.registry.contributions import CaseTemplate, ExportFormat, LabRow
from tribo.registry.hookspecs import hookimpl
from tribo.result.read import Result
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw

__all__ = [
    "Array",
    "BodyInfo",
    "BodyMeasures",
    "BodyState",
    "CaseError",
    "CaseTemplate",
    "Component",
    "ContactConditions",
    "ContactProblem",
    "ContactSolution",
    "ContactSolver",
    "ContactSystem",
    "Effect",
    "ExportFormat",
    "Exposure",
    "Field",
    "Grid",
    "HalfSpace",
    "Kinematics",
    "LabRow",
    "LocalConditions",
    "Material",
    "Measures",
    "NumericalError",
    "Observer",
    "Operator",
    "Quantity",
    "Residuals",
    "Result",
    "RunInfo",
    "Snapshot",
    "State",
    "Stationary",
    "Surface",
    "Table",
    "Track",
    "TriboError",
    "TriboWarning",
    "WearCompliance",
    "WearLaw",
    "WearRate",
    "hookimpl",
    "nyquist_compliance",
    "residuals",
    "solve_bounded",
]
