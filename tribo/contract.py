"""The contract of a component's answers, for the guard in a run, the kit and the docs."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from tribo.component import Component
from tribo.core.fields import FRICTION_COEFFICIENT, LOAD_SHARE, LOCAL_SLIP, Field


@dataclass(frozen=True)
class Answer(Field):
    """The declaration of one value that a component answers with: finite, and within its limits.

    Parameters
    ----------
    shape : str, optional
        Its shape, in words; empty for a number.
    spreads : bool, optional
        Whether an array that broadcasts to this shape will do.
    above : float, optional
        A limit that its values exceed.
    like : str, optional
        An array of its shape in what the component is given.
    """

    shape: str = ""
    spreads: bool = False
    above: float | None = None
    like: str = ""

    @cached_property
    def range(self) -> tuple[float, float]:
        """The least and the largest of the numbers that are allowed."""
        most = sys.float_info.max
        least = -most if self.at_least is None else max(-most, self.at_least)
        if self.above is not None:
            least = math.nextafter(self.above, math.inf)
        return least, most if self.at_most is None else min(most, self.at_most)

    @property
    def limits(self) -> str:
        """Its limits, in words; empty if it has none."""
        bounds = ((">", self.above), ("≥", self.at_least), ("≤", self.at_most))
        return ", ".join(f"{sign} {bound:g}" for sign, bound in bounds if bound is not None)

    def needed(self, shape: tuple[int, ...] | None = None) -> str:
        """Return what is allowed, in words: its shape where one is given, else its values."""
        unit = "" if self.unit == "1" else f"in {self.unit}"
        shapes = " = ".join(filter(None, dict.fromkeys((self.shape, str(shape)))))
        rules = (f"of shape {shapes}",) if shape else (unit, self.limits)
        allowed = ", ".join(filter(None, ("it must be real and finite", *rules)))
        return f"{allowed}; compute it from {self.like}" if shape and self.like else allowed


_WINDOW = "(nx, ny)"
_CYCLE = "(positions, nx, ny)"
_OWN = "(rows, ny)"
_OF_LAW = Answer("", "1", "", shape=_CYCLE, spreads=True, like="local.pressure")
_OF_EFFECT = Answer("", "1", "", shape=_WINDOW, spreads=True, like="contact.pressure")

ANSWERS: Mapping[str, Sequence[Answer]] = {
    "surface": (
        Answer("height", "m", "Height outward from the body.", shape=_WINDOW, like="grid.mesh"),
        Answer("curvature", "1/m", "Curvature along x and y, or None.", shape="(2,)"),
    ),
    "wear_law": (
        replace(_OF_LAW, name="depth_rate", description="Depth per metre.", at_least=0.0),
        replace(_OF_LAW, name="depth_slope", unit="1/Pa", description="Its slope, or None."),
    ),
    "effect": (Answer("load_factor", "1", "Of the normal load.", above=0.0),),
    "contact_solver": (
        Answer("pressure", "Pa", "Contact pressure.", 0.0, shape=_WINDOW, like="problem.gap"),
        Answer("overlap", "m", "Plastic displacement.", 0.0, shape=_WINDOW, like="problem.gap"),
        Answer("approach", "m", "Rigid approach."),
        Answer("iterations", "1", "Iterations on the full grid."),
        Answer("residuals", "1", "Errors in the conditions of contact.", shape="(3,)"),
        Answer("smallest_compliance", "m/Pa", "Of K, or None.", above=0.0),
    ),
    "kinematics": (
        Answer("end_time", "s", "When the motion ends.", above=0.0),
        Answer("distance_at", "m", "Sliding distance at a time."),
        Answer("time_at", "s", "Time at a distance: the inverse of `distance_at`."),
        Answer("edges", "s", "Each time at which the speed jumps."),
        Answer("share", "1", "Part of the path at a position of the cycle.", 0.0),
        Answer("speeds", "m/s", "Speeds there, with shares; or None.", 0.0, shape="(n, 2)"),
        Answer("rest", "s/m", "Time at rest there, per metre of the path.", 0.0),
        Answer("reach", "1", "Relative distance, or None.", shape=_WINDOW, above=0.0),
        Answer("heading", "1", "Which way the body that passes moves there.", shape="(2,)"),
        Answer("starts", "1", "First row of the window on the body there, or None."),
        Answer("across", "1", "First column of the window on the body there, or None."),
        Answer("length", "m", "Length of a track.", above=0.0),
        Answer("average", "m", "Depth that each point of a body sees.", 0.0, shape=_OWN),
        Answer("envelope", "m", "Largest depth that each point meets.", shape=_OWN),
        Answer("volume", "m^3", "Volume of a depth on the body."),
        Answer("local", "1/Pa", "Depth per metre and pressure.", 0.0, shape=_WINDOW),
        Answer("swept", "1/(Pa m)", "Depth per metre and line load.", 0.0, shape="(ny,)"),
    ),
}
"""The values that components answer with, by kind."""

LIMITED = {field.name: field for field in (FRICTION_COEFFICIENT, LOAD_SHARE, LOCAL_SLIP)}
"""Fields that a run itself acts on, whose limits are its own."""


def answers_of(component: Component) -> dict[str, Answer]:
    """Return the answers of a component by name: its kind's, its fields' and its states'."""
    kind = type(component).kind()
    found = {answer.name: answer for answer in ANSWERS.get(kind, ())}
    spread = _OF_LAW if kind == "wear_law" else _OF_EFFECT
    uniform = replace(spread, shape="(1, 1)", like="")
    for field in getattr(component, "provides", ()):
        known = LIMITED.get(field.name, field)
        limits = {"at_least": known.at_least, "at_most": known.at_most}
        found[field.name] = replace(spread, name=field.name, unit=field.unit, **limits)
    for field in getattr(component, "state_fields", ()):
        first, rate = initial(field.name), rate_of(field.name)
        per = "m" if kind == "wear_law" else "s"
        found[first] = Answer(first, field.unit, "", field.at_least, field.at_most)
        found[rate] = replace(
            uniform if field.uniform else spread, name=rate, unit=f"{field.unit}/{per}"
        )
    return found


def initial(name: str) -> str:
    """Return the name of the initial value of a state field."""
    return f"initial {name}"


def rate_of(name: str) -> str:
    """Return the name of the rate of a state field."""
    return f"rate of {name}"
