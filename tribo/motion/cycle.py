"""The positions that stand for one cycle of a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Speeds = Sequence[tuple[float, float]]
"""Sliding speeds in m/s, each with a share of the path."""


@dataclass(frozen=True)
class Position:
    """One position of a cycle, in which the contact is solved.

    Parameters
    ----------
    share : float
        Part of the path of a cycle that is spent here; the shares of a cycle add up to 1.
    speeds : Speeds or None, optional
        Sliding speeds here, in m/s, each with its share of the path spent here. None: laws and
        effects are asked at the mean speed over each step.
    """

    share: float = 1.0
    speeds: Speeds | None = None
