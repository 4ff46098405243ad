"""Values that change over time in stages, as a case gives them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from pydantic import Discriminator

NUMBER, STAGES = "number", "stages"
MOST = 10_000


ONE_OR_STAGES = Discriminator(lambda value: STAGES if isinstance(value, list | tuple) else NUMBER)
"""Tells a number from a list of stages, by the tags of these names."""


def listed(value: Any) -> Any:
    """Return a value of a case; raise ValueError of one stage that is in no list."""
    if isinstance(value, Mapping):
        raise ValueError("one table was given; write a list of them: [{ until = …, … }, …]")
    return value


def check_times(times: Sequence[float], what: str) -> None:
    """Raise ValueError unless the times at which stages of `what` end, in s, increase."""
    if not times:
        raise ValueError(
            f"the list is empty; give a number, or the stages of the {what} up to the end of the "
            "run"
        )
    if times[-1] == 0:
        raise ValueError(f"give the {what} up to the end of the run")
    if len(times) > MOST:
        raise ValueError(
            f"{len(times)} stages of the {what}, each of which ends a step; give means over longer "
            f"times, {MOST} at most"
        )
    for before, after in pairwise(times):
        if after <= before:
            raise ValueError(
                "times must increase from stage to stage, but "
                f"{before:g} s is followed by {after:g} s"
            )
