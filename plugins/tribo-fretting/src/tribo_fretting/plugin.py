"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tribo import Column, Component, Result, hookimpl

from tribo_fretting.columns import COLUMNS
from tribo_fretting.figures import loops, slip_map
from tribo_fretting.motion import Fretting
from tribo_fretting.partial_slip import PartialSlip


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer the motion of fretting, and the partial slip that it brings along."""
    return (Fretting, PartialSlip)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)


def _last(column: str, result: Result) -> float:
    return float(result.saves()[-1].get(column, np.nan))


@hookimpl
def tribo_quantities() -> list[Column]:
    """Offer the numbers of the last cycle."""
    return [replace(column, read=partial(_last, column.label)) for column in COLUMNS]


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the loops of force over displacement, and a map of the slip."""
    motion = result.case.kinematics
    if not isinstance(motion, Fretting):
        return {}
    return {
        "fretting_loops": partial(loops, result, motion.frequency),
        "slip_map": partial(slip_map, result),
    }
