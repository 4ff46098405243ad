"""Wear resistance of a material made of particles: a random field of place and depth."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from tribo import Array

DRAWN = 1 << 16
"""Resistances that are drawn, whose spread is right to some 0.3 %; each particle has one of
them."""
# 2⁶⁴ over the golden ratio (Knuth), and two primes of xxHash64.
_MIX = [np.uint64(f) for f in (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9)]


def resistance(
    x: Array,
    y: Array,
    depth: Array,
    *,
    diameter: float,
    thickness: float,
    spread: float,
    seed: int,
    repeats: int | None = None,
) -> Array:
    """Return the wear resistance of a material at points, as a multiple of its mean.

    Particles lie on the nodes of a square lattice of spacing `diameter`, one lattice every
    `thickness` of depth, each lattice shifted by a random part of a spacing. Between them the
    resistance is linear in x, y and depth, so that the mean along any of these is 1.

    Parameters
    ----------
    x, y, depth : ndarray
        Place of each point, and its depth below the first surface, in m.
    diameter, thickness : float
        Spacing of the particles along the surface and in depth, in m.
    spread : float
        Standard deviation of a particle's resistance.
    seed : int
        Seed of the draws.
    repeats : int, optional
        Number of particles along x and along y after which they repeat.

    Returns
    -------
    ndarray
        Positive, of the points' shape.
    """
    drawn, shifts = _draws(seed, spread)
    level = depth / thickness
    upper = np.floor(level)
    part = level - upper
    total = np.zeros(level.shape)
    for layer, share in ((upper, 1 - part), (upper + 1, part)):
        number = _mixed(layer, 2)
        along, across = (
            _nodes(place / diameter + shift[_drawn(number)], repeats)
            for place, shift in zip((x, y), shifts, strict=True)
        )
        rows = [(_mixed(j, 1), share_y) for j, share_y in across]
        for i, share_x in along:
            column, shared = number ^ _mixed(i, 0), share * share_x
            for row, share_y in rows:
                total += shared * share_y * drawn[_drawn(column ^ row)]
    return total


def _nodes(place: Array, repeats: int | None) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Return the numbers of the nodes beside each place, and the share of each."""
    below = np.floor(place)
    part = place - below
    above = below + 1
    if repeats is not None:
        # Faster than the remainder, and the same.
        below, above = (node - repeats * np.floor(node / repeats) for node in (below, above))
    return (below, 1 - part), (above, part)


@lru_cache(maxsize=16)
def _draws(seed: int, spread: float) -> tuple[Array, Array]:
    """Return resistances of mean 1, and shifts of lattices along x and along y, in spacings."""
    random = np.random.default_rng(seed)
    drawn = random.gamma(spread**-2, spread**2, DRAWN)
    drawn /= np.mean(drawn)
    return drawn, random.uniform(size=(DRAWN, 2)).T.copy()


def _mixed(number: Array, axis: int) -> NDArray[np.uint64]:
    """Return whole numbers spread over all bits, differently for each axis."""
    mixed: NDArray[np.uint64] = number.astype(np.int64).view(np.uint64) * _MIX[axis]
    return mixed ^ (mixed >> np.uint64(31))


def _drawn(key: NDArray[np.uint64]) -> NDArray[np.int64]:
    """Return which draw belongs to each key."""
    key = (key ^ (key >> np.uint64(29))) * _MIX[1]
    return ((key ^ (key >> np.uint64(32))) & np.uint64(DRAWN - 1)).view(np.int64)
