"""Heat sources that come back on their track, by Green's function."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.special import erf
from tribo import Array

from tribo_thermal.sources import NODES, WEIGHTS

SIDE = math.sqrt(math.pi)
"""Of a square as large as the disc of radius 1."""
PHASES = (np.arange(32)[:, None] + 0.5) / 32
"""Of a period of the motion."""
PLACES = (np.arange(64) + 0.5) / 64
"""Parts of a period, at which the source is of old."""
PERIODS, PANELS = 6, 24
"""Periods that are added up pass by pass, and panels of Gauss's rule in each."""

Way = Callable[[float, Array], tuple[Array, Array]]
"""From the track and the distance slid since then, in radii, to how far the source is from where
it was, along and across."""


def to_and_fro(length: float, slid: Array) -> tuple[Array, Array]:
    """Return the way between two points of reversal, one row for each phase."""

    def place(phase: Array) -> Array:
        return np.asarray(length * np.arccos(np.cos(2 * math.pi * phase)) / math.pi)

    return place(PHASES) - place(PHASES - 0.5 * slid / length), np.zeros((1, 1))


def round_a_circle(length: float, slid: Array) -> tuple[Array, Array]:
    """Return the way along a circle; all phases are alike."""
    radius, angle = length / (2 * math.pi), 2 * math.pi * slid[None] / length
    return radius * np.sin(angle), radius * (1 - np.cos(angle))


def moved_on(peclet: float) -> float:
    """Return ΔT K a/Q, the mean over a square source that moves on for ever."""
    s, weight = _panels(np.concatenate([[0.0], np.geomspace(1e-6, 1e4, 100)]))
    return float(np.sum(weight / s**2 * _mean(0.5 * peclet * s**2, s) * _mean(0.0, s))) / SIDE**3


def steady_cycle(way: Way, length: float, peclet: float, panels: int = PANELS) -> float:
    """Return ΔT K a/Q, the mean over a square source that comes back, and over its cycle.

    Heat of the age s² a²/(4κ) was left where the source was Pe s² a/2 ago. That of the last periods
    is added up as it was left; before, the source was as often at each place of its track.
    """
    period = (2 if way is to_and_fro else 1) * length
    ages = np.concatenate([np.geomspace(1e-9, 1e-2, 20), np.linspace(0, PERIODS, panels * PERIODS)])
    s, weight = _panels(np.sqrt(2 * period * np.unique(ages) / peclet))
    along, across = way(length, 0.5 * peclet * s**2)
    recent = np.mean(_mean(along, s) * _mean(across, s), axis=0) / s**2
    inverse, old_weight = _panels(np.array([0.0, math.sqrt(peclet / (2 * period * PERIODS))]))
    old = 1 / inverse[:, None, None]
    along, across = way(length, period * PLACES)
    before = np.mean(_mean(along, old) * _mean(across, old), axis=(1, 2))
    return float(np.sum(weight * recent) + np.sum(old_weight * before)) / SIDE**3


def _panels(ends: Array) -> tuple[Array, Array]:
    """Return nodes and weights of Gauss's rule between each two ends."""
    lengths = np.diff(ends)[:, None]
    return (ends[:-1, None] + lengths * NODES).ravel(), (lengths * WEIGHTS).ravel()


def _mean(shift: Array | float, s: Array) -> Array:
    """Return the mean of exp(−(x − x′ + shift)²/s²) with x and x′ along the square's side."""

    def twice_integrated(z: Array) -> Array:
        return np.asarray(0.5 * math.sqrt(math.pi) * z * erf(z) + 0.5 * np.exp(-(z**2)))

    above, at, below = (twice_integrated((shift + by) / s) for by in (SIDE, 0.0, -SIDE))
    return np.asarray((above - 2 * at + below) * (s / SIDE) ** 2)
