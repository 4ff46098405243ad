"""What this package offers to tribo."""

from __future__ import annotations

from math import nan
from pathlib import Path

from tribo import Column, Component, Result, hookimpl

from tribo_film.mixed import RATIO, SHALLOW, Mixed


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer mixed lubrication."""
    return (Mixed,)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)


@hookimpl
def tribo_quantities() -> tuple[Column, ...]:
    """Offer the largest wear depth over the first approach, up to which the film holds."""
    words = f"wear depth over elastic approach (film.mixed holds below {SHALLOW:g})"
    return (Column("wear_depth_over_approach", "1", words, _depth_over_approach),)


def _depth_over_approach(result: Result) -> float:
    if not any(RATIO.name in result.body(name).effects for name in result.body_names):
        return nan
    first, *_, last = result.saves()
    depth = max(body["max_wear_depth_m"] for body in last["bodies"].values())
    return float(depth / first["approach_m"])
