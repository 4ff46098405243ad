"""Values so far from the usual that a wrong or missing unit is likely."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from tribo.case import Case
from tribo.config.overrides import leaves
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.explain import path
from tribo.core.measures import BodyMeasures
from tribo.core.units import stated

DEEP = 0.1
"""Wear depth, relative to the radius of curvature, from which on it is doubted."""
HARDNESSES = (3e-4, 0.2)
"""Hardness over Young's modulus beyond which one is doubted: indium has 8e-4, diamond 0.1."""


def unusual(case: Case) -> list[str]:
    """Ask about each quantity of a case that is out of its usual range, by place."""
    found: dict[str, str] = {}
    for place, value, mark in leaves(case):
        doubt = mark.doubt(value) if mark and isinstance(value, float) else None
        if doubt is not None:
            while isinstance(place[-1], int):
                # A pair may be written as one value.
                place = place[:-1]
            found[path(place)] = f"is {doubt}"
    for name, body in case.bodies.items():
        (low, high), layers = HARDNESSES, range(len(body.layers))
        parts = [*(f"layers.{i}" for i in layers), "material"]
        for part, material in zip(parts, body.materials(), strict=True):
            young, hardness, at = material.young, material.hardness, f"bodies.{name}.{part}"
            if hardness is None or {f"{at}.young", f"{at}.hardness"} & found.keys():
                continue
            if not low <= hardness / young <= high:
                found[f"{at}.hardness"] = (
                    f"is {stated(hardness, 'Pa')}, {hardness / young:.2g} of young "
                    f"({stated(young, 'Pa')}), usual are {low:g} to {high:g}: is a unit wrong?"
                )
    return [f"{place} {doubt}" for place, doubt in found.items()]


@contextmanager
def doubting(case: Case) -> Iterator[None]:
    """Begin the error of a failing calculation with each value of the case that is unusual."""
    try:
        yield
    except PluginError:
        raise
    except (CaseError, NumericalError) as error:
        doubts = unusual(case)
        if doubts:
            # First: what follows from a wrong unit has remedies that mislead.
            error.args = (f"{' '.join(doubts)} {error}",)
        raise


def too_deep(system: ContactSystem, bodies: Mapping[str, BodyMeasures]) -> list[str]:
    """Ask about each body whose wear depth is implausible for the contact's curvature."""
    curvature = max(system.curvature or (0.0, 0.0))
    return [
        f"{name} would wear about {1e3 * worn.max_wear_depth:.3g} mm deep, which is "
        f"{worn.max_wear_depth * curvature:.3g} "
        f"times the radius of curvature of {1e3 / curvature:.3g} mm: is its wear coefficient in "
        "the unit that was meant? A bare k is in 1/Pa; write '1e-6 mm^3/(N m)' for that unit"
        for name, worn in bodies.items()
        if worn.max_wear_depth * curvature > DEEP
    ]
