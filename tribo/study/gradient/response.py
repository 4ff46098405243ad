"""How rates follow the pressures of a contact: each point's own, the load, and Σp²."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tribo.contact.projection import CELLS, over
from tribo.core.arrays import Array
from tribo.core.errors import CaseError

NUDGE = 3e-5
"""Part of the pressure by which it is varied to find the derivative of a rate, up and down."""
LEAST = 0.1
"""Part of a cell's pressure that must be varied to find what follows it."""
AGREES = 1e-4
"""Relative difference up to which a change in all that is varied is the sum of its parts."""

Arrays = list[Array]
Rates = Callable[[Array], Arrays]
"""Rates at pressures, shape (positions, nx, ny)."""


@dataclass(frozen=True)
class Response:
    """The derivatives of a rate at each cell, of the shape (positions, nx, ny) or 0.

    In the pressure of that cell, in the sum of all at its position, and in half the sum of their
    squares.
    """

    own: Array
    load: Array | float = 0.0
    square: Array | float = 0.0

    def change(self, pressure: Array, by: Array) -> Array:
        """Return what a change of the pressures adds to the rate."""
        found: Array = self.own * by + self.load * over(np.sum(by, CELLS))
        return found + self.square * over(np.sum(pressure * by, CELLS))


def local(rates: Rates, pressure: Array) -> list[Response]:
    """Return the responses of rates that follow the pressure of their own cell alone."""
    span = np.where(pressure > 0, 2 * NUDGE * pressure, np.inf)
    pairs = zip(rates((1 + NUDGE) * pressure), rates((1 - NUDGE) * pressure), strict=True)
    return [Response((higher - lower) / span) for higher, lower in pairs]


def shared(rates: Rates, pressure: Array) -> list[Response]:
    """Return the responses of rates that also follow the load and the mean of squares.

    As effects do that share the load, or that are uniform over a contact of this load and area.
    """
    stripes = _balanced(pressure)
    steeper = pressure**2 / over(np.max(pressure, CELLS))
    ways = [stripes * pressure, pressure, steeper]
    of_stripes, of_all, of_steeper = (
        [
            (higher - lower) / (2 * NUDGE)
            for higher, lower in zip(
                rates(pressure + NUDGE * way), rates(pressure - NUDGE * way), strict=True
            )
        ]
        for way in ways
    )
    moved = np.where(np.abs(stripes) > LEAST, ways[0], np.inf)
    moved = np.where(pressure > 0, moved, np.inf)
    # What both ways change of both sums, relative to the first's: alike where pressures are even.
    sums, squares = _sums(ways[1:]), _sums([pressure * way for way in ways[1:]])
    inverse = _inverse(sums[1] / sums[0], squares[1] / squares[0])
    found = []
    for by_stripes, *others in zip(of_stripes, of_all, of_steeper, strict=True):
        own = by_stripes / moved
        left = [other - own * way for other, way in zip(others, ways[1:], strict=True)]
        load, square = (
            over(inverse[:, row, 0] / total) * left[0] + over(inverse[:, row, 1] / total) * left[1]
            for row, total in enumerate((sums[0], squares[0]))
        )
        found.append(Response(own, load, square))
    return found


def _balanced(pressure: Array) -> Array:
    """Return signs that alternate, so that neither the load nor Σp² changes by them."""
    signs = np.where(np.indices(pressure.shape[1:]).sum(axis=0) % 2, -1.0, 1.0)
    part = pressure / over(np.max(pressure, CELLS))
    first, second, third = _sums([part, part**2, part**3])
    of_sum, of_squares = _sums([part * signs, part**2 * signs])
    inverse = _inverse(second / first, third / second)
    even, steep = (
        over(inverse[:, row, 0] * of_sum + inverse[:, row, 1] * of_squares) / over(total)
        for row, total in enumerate((first, second))
    )
    return np.where(pressure > 0, signs - even - steep * part, 0.0)


def _sums(fields: Arrays) -> Arrays:
    return [np.sum(field, CELLS) for field in fields]


def _inverse(one: Array, other: Array) -> Array:
    """Return the inverse of [[1, 1], [one, other]] at each position."""
    ones = np.ones_like(one)
    matrix = np.moveaxis(np.array([[ones, ones], [one, other]]), -1, 0)
    return np.linalg.pinv(matrix, rcond=1e-6)


def check_sum(expected: Arrays, found: Arrays, rates: Arrays, who: str) -> None:
    """Refuse rates that change otherwise than by their parts, in a change of all at once."""
    for one, other, rate in zip(expected, found, rates, strict=True):
        allowed = AGREES * np.max(np.abs(other)) + 1e-8 * NUDGE * np.max(np.abs(rate))
        if np.max(np.abs(one - other)) > allowed:
            raise CaseError(
                f"what {who} makes of a point follows other points, otherwise than by the load "
                "and the area, through which no gradient goes",
                "effects",
            )
