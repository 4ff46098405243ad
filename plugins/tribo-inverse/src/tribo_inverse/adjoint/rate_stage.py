"""Rates at one place along an increment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from tribo import Array

from tribo_inverse.adjoint.response import Arrays


class RatePlace(NamedTuple):
    """Which part of an increment has passed, and over how much (m) of it rates are means.

    `shares` are those of the layers over it, by body.
    """

    passed: float
    over: float
    shares: Mapping[str, Mapping[str, Array]] = {}


@dataclass(frozen=True)
class RateStage:
    """Rates at one place along an increment, at states that are held within their limits.

    The rates are those at each cell of each position, and `means` those over each point of what
    they change. `inside` tells by state where it was within its limits already.
    """

    place: RatePlace
    states: Arrays
    inside: Sequence[Array]
    rates: Arrays
    means: Arrays
