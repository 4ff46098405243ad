"""The positions that represent one cycle of a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from tribo.core.arrays import Array

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
        effects are evaluated at the mean speed over each step.
    reach : ndarray, shape (nx, ny), or None, optional
        Sliding distance and speed of each point of the contact here, relative to the motion's.
        None: all points slide as the motion does.
    rest : float, optional
        Time at rest here, in s, for each metre of the path spent here; in addition to `speeds`.
    heading : pair of float or of ndarray, shape (nx, ny), optional
        Direction of the moving body here: the x and y of a vector of length 1. Where it moves both
        ways, as on a stroke, one of them.

    Examples
    --------
    >>> motion = tribo.Reciprocating(stroke="1 mm", frequency="5 Hz", cycles=9, positions=5)
    >>> [at.share for at in motion.cycle(tribo.Grid("2 mm", 80))]
    [0.125, 0.25, 0.25, 0.25, 0.125]
    """

    share: float = 1.0
    speeds: Speeds | None = None
    reach: Array | None = None
    rest: float = 0.0
    heading: tuple[Array | float, Array | float] = (1.0, 0.0)
