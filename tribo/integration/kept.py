"""What is integrated along an increment: states with their limits and breaks, and sums."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tribo.core.arrays import Array

Numbers = NDArray[np.intp]
Field = Array | float
Values = list[Array]
Rates = Callable[[Sequence[Array], float], Values]
"""Rates of states, then of sums, at states and at a share of a part."""


@dataclass(frozen=True)
class Kept:
    """The properties of a state that the integrator needs.

    Parameters
    ----------
    name, owner : str
        Its name in messages, and the component that declares it.
    least, most : float
        Its limits, at which its rate vanishes.
    breaks : tuple of float
        Values at which rates jump, rising; at a break itself the rates above it hold.
    place : str
        States that lie at the same place pass breaks together.
    """

    name: str
    owner: str = ""
    least: float = -math.inf
    most: float = math.inf
    breaks: tuple[float, ...] = ()
    place: str = ""

    def __str__(self) -> str:
        return f"{self.name!r} of {self.owner}"

    @cached_property
    def ends(self) -> Array | None:
        """The limits, with the breaks between them; None where there are none."""
        ends = np.array([self.least, *self.breaks, self.most])
        return ends if np.any(np.isfinite(ends)) else None

    def hold(self, values: Array) -> Array:
        """Return values clipped to the limits."""
        return np.clip(values, self.least, self.most)

    def aside(self, values: Array, nudge: Field) -> Array:
        """Return values moved up by a nudge, or down where a limit or a break is in the way."""
        if self.ends is None:
            return values + nudge
        above = self.ends[np.searchsorted(self.breaks, values, side="right") + 1]
        crosses = np.where(above == self.most, values + nudge > above, values + nudge >= above)
        return np.where(crosses, values - nudge, values + nudge)

    def end(self, number: Numbers) -> Array:
        """Return breaks by their numbers; the limits have the numbers before and after them."""
        assert self.ends is not None
        return self.ends[number + 1]

    def reaches(self, values: Array, later: Array) -> bool:
        """Whether a value reaches a limit or a break on its way to a later value."""
        if math.isfinite(self.least) and np.any((later <= self.least) & (values > self.least)):
            return True
        if math.isfinite(self.most) and np.any((later >= self.most) & (values < self.most)):
            return True
        return any(np.any((values < each) != (later < each)) for each in self.breaks)

    def next(self, values: Array, rate: Array, slope: Field) -> tuple[Array, Numbers, Array]:
        """Return the break or limit that each value reaches next, its number, and when.

        The time is infinite where it reaches none. The derivative of the rate in the state is
        `slope`. A value that reaches a break from above ends at the next float below it.
        """
        number = np.searchsorted(self.breaks, values, side="right") - (rate <= 0)
        end = self.end(number)
        inner = (number >= 0) & (number < len(self.breaks))
        room = end - values
        # At a limit a state stays; at a break it may turn down at once.
        ahead = np.where(rate > 0, room >= 0, (rate < 0) & (room <= 0))
        far = np.isfinite(end) & ahead & (inner | (room != 0))
        time = np.divide(room, rate, out=np.full(values.shape, np.inf), where=far)
        if np.ndim(slope):
            with np.errstate(divide="ignore", invalid="ignore"):
                rise = slope * time
                later = np.where(rise > -1, np.log1p(rise) / slope, np.inf)
            time = np.where(far & (np.asarray(slope) < 0), later, time)
        below: Array = np.nextafter(end, -np.inf)
        return np.where(inner & (rate < 0), below, end), number, time


@dataclass(frozen=True)
class Sum:
    """A quantity that is only integrated; its rates hold as long as the rates of states at a place.

    `see` maps values at that place to where the sum lies. Without a place its rates hold for the
    whole step.
    """

    place: str | None = None
    see: Callable[[Array], Array] | None = None

    def span(self, spans: Mapping[str, Field], step: float) -> Field:
        """Return for how long its rates hold."""
        if self.place is None:
            return step
        span = spans.get(self.place, step)
        return self.seen(span) if isinstance(span, np.ndarray) else span

    def seen(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return values at its place, mapped to where the sum lies."""
        return self.see(values) if self.see else values
