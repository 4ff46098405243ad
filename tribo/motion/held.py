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
    """What goes on at one rate after the other.

    Parameters
    ----------
    rates : tuple of float
        Per second, 0 for a rest.
    ends : tuple of float, optional
        Until when each is held, in s; one rate is held for ever.
    """

    rates: tuple[float, ...]
    ends: tuple[float, ...] = (inf,)

    @cached_property
    def _begun(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """When each begins, in s, and how far it has come by then."""
        starts = (0.0, *self.ends[:-1])
        lasted = (end - start for start, end in pairwise(starts))
        return starts, (0.0, *accumulate(r * t for r, t in zip(self.rates, lasted, strict=False)))

    def by(self, time: float) -> float:
        """Return how far it has come by a time, in s."""
        starts, amounts = self._begun
        now = max(0, bisect_right(starts, time) - 1)
        return amounts[now] + self.rates[now] * (min(time, self.ends[-1]) - starts[now])

    def reached(self, amount: float) -> float:
        """Return the first time by which it has come so far, in s."""
        starts, amounts = self._begun
        if amount <= 0:
            return 0.0
        now = bisect_left(amounts, amount) - 1
        while not self.rates[now]:
            # Beyond the end it comes no further.
            now -= 1
        return min(starts[now] + (amount - amounts[now]) / self.rates[now], self.ends[-1])

    def end(self, what: str, unit: str, time: float | None, amount: float | None) -> float:
        """Return when it ends that lasts a time (s) or, without one, until it has come so far.

        `CaseError` if the last rate, called `what`, ends before; `unit` is that of the amount.
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
    """Return what a case gives: a number, or stages with `until` and a rate by the name `what`.

    ValueError if the times do not increase, or all are rests.
    """
    if isinstance(given, float):
        return Held((given,))
    ends, rates = [stage.until for stage in given], [getattr(stage, what) for stage in given]
    check_times(ends, what)
    if not any(rates):
        raise ValueError("every stage is a rest; give one that slides")
    return Held(tuple(rates), tuple(ends))
