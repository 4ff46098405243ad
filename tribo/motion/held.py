"""A speed or a frequency that is held: at one value, or in stages, each until a time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate, pairwise
from math import inf
from typing import Any

from tribo.core.errors import CaseError
from tribo.core.loads import check_times
from tribo.core.rounding import ROUND_OFF


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
