"""Values so far from the usual that a wrong or missing unit is likely."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from tribo.case import Case
from tribo.config.overrides import leaves
from tribo.core import findings
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError, NumericalError, PluginError
from tribo.core.explain import path
from tribo.core.findings import Finding
from tribo.core.measures import BodyMeasures
from tribo.core.units import stated

HARDNESSES = (3e-4, 0.2)
"""Hardness over Young's modulus beyond which one is doubted: indium has 8e-4, diamond 0.1."""


def unusual(case: Case) -> list[Finding]:
    """Return a question about each quantity of a case that is out of its usual range."""
    found: dict[str, Finding] = {}
    for place, value, mark in leaves(case):
        if not (mark and mark.usual and isinstance(value, float)):
            continue
        if doubt := mark.doubt(value):
            while isinstance(place[-1], int):
                # A pair may be written as one value.
                place = place[:-1]
            limit = _nearest(value, mark.usual)
            found[path(place)] = findings.unusual(path(place), doubt, value, limit)
    for name, body in case.bodies.items():
        (low, high), layers = HARDNESSES, range(len(body.layers))
        parts = [*(f"layers.{i}" for i in layers), "material"]
        for part, material in zip(parts, body.materials(), strict=True):
            young, hardness, at = material.young, material.hardness, f"bodies.{name}.{part}"
            if hardness is None or {f"{at}.young", f"{at}.hardness"} & found.keys():
                continue
            if not low <= hardness / young <= high:
                limit = _nearest(hardness, (low * young, high * young))
                doubt = (
                    f"{stated(hardness, 'Pa')}, {hardness / young:.2g} of young "
                    f"({stated(young, 'Pa')}), usual are {low:g} to {high:g}: is a unit wrong?"
                )
                found[f"{at}.hardness"] = findings.unusual(f"{at}.hardness", doubt, hardness, limit)
    return [*found.values()]


def _nearest(value: float, usual: tuple[float, float]) -> float:
    return min(usual, key=lambda end: abs(end - value))


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
            error.args = (" ".join([*(doubt.words for doubt in doubts), str(error)]),)
        raise


def too_deep(system: ContactSystem, bodies: Mapping[str, BodyMeasures]) -> list[Finding]:
    """Return a question about each body whose wear depth is implausible for the curvature."""
    curvature = max(system.curvature or (0.0, 0.0))
    return [
        findings.too_deep(name, worn.max_wear_depth, 1 / curvature)
        for name, worn in bodies.items()
        if worn.max_wear_depth * curvature > findings.DEEP
    ]
