"""The surface and the wear law of a body, held to the contract."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, PluginError
from tribo.core.fields import name_fault
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.motion.exposure import Exposure
from tribo.simulation import answers
from tribo.simulation.calling import calling, named
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw


def surface_height(body: str, surface: Surface, grid: Grid) -> Array:
    """Return the height of a body's surface before it wears, shape (nx, ny), in m."""
    with calling(surface, body):
        answer = surface.height(grid)
    return answers.field(named(surface, body), "a height map", answer, grid.cells)[0]


def check_sliding(body: str, surface: Surface, height: Array, exposure: Exposure) -> None:
    """Raise `CaseError` if the motion moves a shape that would not stay as it is."""
    if not exposure.shape_stays and np.any(height != height[:1]):
        raise CaseError(
            f"body {body!r} is swept along x, so its surface must not vary along x, as "
            f"{surface.type!r} does; let kinematics.swept name the other body, or use "
            "a 'flat' or a 'cylinder' with axis = 'x'"
        )


def check_law(body: str, law: WearLaw, material: Material) -> None:
    """Refuse a law that does not suit its body, or whose state is not as it declares it."""
    with calling(law, body):
        law.check(material)
        given = law.initial_state()
    who = named(law, body)
    if fault := name_fault(law.state_fields):
        raise PluginError(f"{who}, state_fields: {fault}")
    declared = {field.name for field in law.state_fields}
    if not isinstance(given, Mapping) or set(given) != declared:
        raise PluginError(
            f"{who} declares the state fields {sorted(declared)}, but starts with {given!r:.80}"
        )
    for name, value in given.items():
        answers.number(who, f"an initial {name!r}", value)


def curvature(surfaces: Mapping[str, Surface]) -> tuple[float, float] | None:
    """Return the curvature of the gap along x and y, in 1/m; None if a surface states none."""
    known = [curvature_of(body, surface) for body, surface in surfaces.items()]
    if any(c is None for c in known):
        return None
    return sum(c[0] for c in known if c), sum(c[1] for c in known if c)


def curvature_of(body: str, surface: Surface) -> tuple[float, float] | None:
    """Return the curvature of a body's surface along x and y, in 1/m, if it states one."""
    with calling(surface, body):
        answer = surface.curvature
    if answer is None:
        return None
    who = named(surface, body)
    along, across = answers.field(who, "a curvature", answer, (2,))[0]
    return float(along), float(across)
