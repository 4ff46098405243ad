"""Rates at one place along an increment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from tribo import Array

from tribo_inverse.increment.across import EffectFields
from tribo_inverse.increment.response import Arrays


@dataclass(frozen=True)
class RateStage:
    """Rates where a part of an increment has `passed`, at states that are held to their limits.

    The rates are those at each cell of each position, and `means` those over each point of what
    they change. `inside` tells by state where it was within its limits already. Behind the rates
    is what effects were told for their `answers`.
    """

    passed: float
    states: Arrays
    inside: Sequence[Array]
    rates: Arrays
    means: Arrays
    answers: Sequence[Sequence[EffectFields]]
