"""The surface and the wear law of a body, held to the contract."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, PluginError
from tribo.core.fields import name_fault
from tribo.core.grid import Grid
from tribo.interfaces.exposure import Exposure
from tribo.interfaces.wear import WearLaw, WearLawConfig
from tribo.simulation import answers
from tribo.simulation.calling import calling, named
from tribo.simulation.model import Body


def surface_height(body: Body, grid: Grid) -> Array:
    """Return the height of a body's surface before it wears, shape (nx, ny), in m."""
    with calling(body.surface, body.name):
        answer = body.surface.height(grid)
    return answers.field(named(body.surface, body.name), "a height map", answer, grid.cells)[0]


def check_sliding(body: Body, height: Array, exposure: Exposure) -> None:
    """Raise `CaseError` if the motion moves a shape that would not stay as it is."""
    if not exposure.shape_stays and np.any(height != height[:1]):
        raise CaseError(
            f"body {body.name!r} is swept along x, so its surface must not vary along x, as "
            f"{body.surface.type_name()!r} does; let kinematics.swept name the other body, or use "
            "a 'flat' or a 'cylinder' with axis = 'x'"
        )


def check_law(law: WearLaw[WearLawConfig], body: Body) -> None:
    """Refuse a law that does not suit its body, or whose state is not as it declares it."""
    with calling(law, body.name):
        law.check(body.material)
        given = law.initial_state()
    who = named(law, body.name)
    if fault := name_fault(law.state_fields):
        raise PluginError(f"{who}, state_fields: {fault}")
    declared = {field.name for field in law.state_fields}
    if not isinstance(given, Mapping) or set(given) != declared:
        raise PluginError(
            f"{who} declares the state fields {sorted(declared)}, but starts with {given!r:.80}"
        )
    for name, value in given.items():
        answers.number(who, f"an initial {name!r}", value)


def curvature(bodies: Sequence[Body]) -> tuple[float, float] | None:
    """Return the curvature of the gap along x and y, in 1/m; None if a surface states none."""
    known = [curvature_of(body) for body in bodies]
    if any(c is None for c in known):
        return None
    return sum(c[0] for c in known if c), sum(c[1] for c in known if c)


def curvature_of(body: Body) -> tuple[float, float] | None:
    """Return the curvature of a body's surface along x and y, in 1/m, if it states one."""
    with calling(body.surface, body.name):
        answer = body.surface.curvature
    if answer is None:
        return None
    who = named(body.surface, body.name)
    along, across = answers.field(who, "a curvature", answer, (2,))[0]
    return float(along), float(across)


def laws_of(bodies: Sequence[Body]) -> list[WearLaw[WearLawConfig]]:
    """Return the wear laws of those that wear."""
    return [body.wear for body in bodies if body.wear is not None]
