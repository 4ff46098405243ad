"""Values so far from the usual that a slip of units is more likely than what they say."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from tribo.config.case import GridConfig, LoadConfig
from tribo.config.usual import unusual
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.simulation.model import Model

DEEP = 0.1
"""Wear depth, relative to the radius of curvature, from which on it is doubted."""


def asked_of(model: Model) -> list[str]:
    """Ask about each value in `model` that is out of its usual range."""
    grid = GridConfig.model_construct(size=model.grid.size, cells=model.grid.cells)
    load = LoadConfig.model_construct(normal=model.load)
    materials = {f"bodies.{body.name}.material": body.material for body in model.bodies}
    configs = {place: component.config for place, component in model.components()}
    return unusual({"grid": grid, "load": load, **materials, **configs})


@contextmanager
def doubting(asked: Callable[[], list[str]]) -> Iterator[None]:
    """Add to the error of a failing calculation what is asked about its input."""
    try:
        yield
    except PluginError:
        raise
    except (CaseError, NumericalError) as error:
        doubts = asked()
        if doubts:
            error.args = (f"{error}. {' '.join(doubts)}",)
        raise


def too_deep(system: ContactSystem, depths: Mapping[str, float]) -> list[str]:
    """Ask about each body whose wear depth, in m, is implausible for the contact's curvature."""
    curvature = max(system.curvature or (0.0, 0.0))
    return [
        f"{name} would wear about {1e3 * depth:.3g} mm deep, which is {depth * curvature:.3g} "
        f"times the radius of curvature of {1e3 / curvature:.3g} mm: is its wear coefficient in "
        "the unit that was meant? A bare k is in 1/Pa; write '1e-6 mm^3/(N m)' for that unit"
        for name, depth in depths.items()
        if depth * curvature > DEEP
    ]
