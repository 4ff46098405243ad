"""A speed or a frequency that is held, at one value or in stages, and motions by it."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate, pairwise
from math import inf
from typing import Annotated, Any, ClassVar, Self

from pydantic import field_validator, model_validator

from tribo.core.errors import CaseError
from tribo.core.loads import check_times, listed
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity, parse
from tribo.motion.kinematics import Kinematics


@dataclass(frozen=True)
class Held:
    """A rate that is constant in stages, one after the other.

    Parameters
    ----------
    rates : tuple of float
        Per second, 0 for a rest.
    ends : tuple of float, optional
        Time at which each ends, in s; a single rate never ends.
    """

    rates: tuple[float, ...]
    ends: tuple[float, ...] = (inf,)

    @cached_property
    def _begun(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Beginning of each stage, in s, and the amount by then."""
        starts = (0.0, *self.ends[:-1])
        lasted = (end - start for start, end in pairwise(starts))
        return starts, (0.0, *accumulate(r * t for r, t in zip(self.rates, lasted, strict=False)))

    def by(self, time: float) -> float:
        """Return the amount by a time, in s."""
        starts, amounts = self._begun
        now = max(0, bisect_right(starts, time) - 1)
        return amounts[now] + self.rates[now] * (min(time, self.ends[-1]) - starts[now])

    def reached(self, amount: float) -> float:
        """Return the first time at which an amount is reached, in s."""
        starts, amounts = self._begun
        if amount <= 0:
            return 0.0
        now = bisect_left(amounts, amount) - 1
        while not self.rates[now]:
            # Beyond the end it comes no further.
            now -= 1
        return min(starts[now] + (amount - amounts[now]) / self.rates[now], self.ends[-1])

    def end(self, what: str, unit: str, time: float | None, amount: float | None) -> float:
        """Return the end of a motion that lasts a time (s) or, without one, up to an amount.

        `CaseError` if the last rate, called `what`, ends before; the amount has the `unit`.
        """
        last, most = self.ends[-1], self.by(self.ends[-1])
        if time is None:
            assert amount is not None
            lasts, asked = amount <= most * (1 + ROUND_OFF), f"{amount:g} {unit}"
        else:
            lasts, asked = time <= last * (1 + ROUND_OFF), f"{time:g} s"
        if not lasts:
            raise CaseError(
                f"the {what} ends at {last:g} s, after {most:g} {unit}, before the run does at "
                f"{asked}; give it up to then",
                f"kinematics.{what}",
            )
        return self.reached(amount or 0.0) if time is None else time


@lru_cache(maxsize=32)
def held(what: str, given: float | tuple[Any, ...]) -> Held:
    """Return the rate given by a case: a number, or stages with `until` and a rate called `what`.

    ValueError if the times do not increase, or all are rests.
    """
    if isinstance(given, float):
        return Held((given,))
    ends, rates = [stage.until for stage in given], [getattr(stage, what) for stage in given]
    check_times(ends, what)
    if not any(rates):
        raise ValueError("every stage is a rest; give a stage with sliding")
    return Held(tuple(rates), tuple(ends))


class HeldMotion(Kinematics):
    """A motion at a held speed or frequency, up to a time, a distance or a number of laps."""

    _rate_key: ClassVar[str]
    """Key of its speed or frequency."""
    _laps_key: ClassVar[str]
    """Key of its number of laps."""

    duration: Annotated[float, Quantity("s", above=0)] | None = None
    """Duration of the motion."""
    distance: Annotated[float | str, Quantity("m", above=0, also=("lap",))] | None = None
    """Sliding distance."""
    swept: str | None = None
    """Name of the body whose points pass through the contact; the last body if left out."""

    _in_a_list = field_validator("speed", "frequency", mode="before", check_fields=False)(listed)

    @field_validator("speed", "frequency", check_fields=False)
    @classmethod
    def _slides_on(cls, given: Any) -> Any:
        if not isinstance(given, str):
            held(cls._rate_key, given)
        return given

    @model_validator(mode="after")
    def _one_end(self) -> Self:
        ends = self.duration, getattr(self, self._laps_key), self.distance
        if sum(end is not None for end in ends) != 1:
            raise ValueError(f"give exactly one of duration, {self._laps_key} and distance")
        return self

    @property
    def _held(self) -> Held:
        given = getattr(self, self._rate_key)
        if isinstance(given, str):
            given = parse(given, "Hz") * self.lap
        return held(self._rate_key, given)

    @property
    def edges(self) -> Sequence[float]:
        """Times at which one stage of the speed or frequency ends and another begins, in s."""
        return self._held.ends[:-1]
