"""Derivatives of rates in their inputs: at each point, in the load and in Σp²."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from tribo import Array
from tribo.kernel_api import CELLS, over

NUDGE = 3e-5
"""Part of a value by which it is varied up and down for a derivative, or for a second one."""
ASIDE = 1e-7
"""The same where it is varied to one side only, or a derivative may soon change."""
EVENLY = 1e-6
"""Part of a pressure by which it is varied up and down where a rate depends on it alone."""
LEAST = 0.1
"""Part of a cell's pressure that must be varied for a derivative in it."""

Arrays = list[Array]
Field = Array | float
"""Values at each cell or point, or one value for all."""
Rates = Callable[[Array], Arrays]
"""Rates at pressures, shape (positions, nx, ny), or at other values."""


@dataclass(frozen=True)
class Response:
    """The derivatives of a rate at each cell, of the shape (positions, nx, ny) or 0.

    In its `own` value, in the sum of all pressures at its position, and in half the sum of their
    squares.
    """

    own: Field
    load: Field = 0.0
    square: Field = 0.0

    def change(self, pressure: Array, by: Array) -> Array:
        """Return the change of the rate for a change of the pressures, or of other values."""
        found: Array = self.own * by + self.load * over(np.sum(by, CELLS))
        return found + self.square * over(np.sum(pressure * by, CELLS))


def back(seeds: Sequence[Field], responses: Sequence[Response]) -> Field:
    """Return derivatives in the values at each cell from derivatives in rates."""
    found: Field = 0.0
    for seed, response in zip(seeds, responses, strict=True):
        if np.ndim(seed) and np.ndim(response.own):
            found = found + seed * response.own
    return found


def central(rates: Rates, pressure: Array) -> list[Response]:
    """Return the responses of rates that depend on the pressure of their own cell alone."""
    higher, lower = (1 + EVENLY) * pressure, (1 - EVENLY) * pressure
    by = np.where(higher == lower, np.inf, higher - lower)
    pairs = zip(rates(higher), rates(lower), strict=True)
    return [Response((above - below) / by) for above, below in pairs]


def aside(
    rates: Rates,
    found: Arrays,
    values: Array,
    nudge: Array,
    seen: Callable[[Array], Array] = lambda values: values,
) -> list[Response]:
    """Return the responses of rates in values of their own cell, each varied by its `nudge`.

    `found` are the rates at the values. `seen` maps values on a body to the cells of the rates.
    """
    moved = rates(values + nudge)
    # What is added is not quite the nudge: its last digits are lost.
    span = seen((values + nudge) - values)
    by = np.where(span == 0, np.inf, span)
    return [Response((after - before) / by) for after, before in zip(moved, found, strict=True)]


def shared(rates: Rates, pressure: Array) -> list[Response]:
    """Return the responses of rates that also depend on the load and the mean of squares.

    Such rates come from effects that share the load, or that are uniform over the contact.
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
            over(inverse[..., row, 0] / total) * left[0]
            + over(inverse[..., row, 1] / total) * left[1]
            for row, total in enumerate((sums[0], squares[0]))
        )
        found.append(Response(own, load, square))
    return found


def _balanced(pressure: Array) -> Array:
    """Return signs that alternate, so that neither the load nor Σp² changes by them."""
    signs = np.where(np.indices(pressure.shape[-2:]).sum(axis=0) % 2, -1.0, 1.0)
    part = pressure / over(np.max(pressure, CELLS))
    first, second, third = _sums([part, part**2, part**3])
    of_sum, of_squares = _sums([part * signs, part**2 * signs])
    inverse = _inverse(second / first, third / second)
    even, steep = (
        over(inverse[..., row, 0] * of_sum + inverse[..., row, 1] * of_squares) / over(total)
        for row, total in enumerate((first, second))
    )
    return np.where(pressure > 0, signs - even - steep * part, 0.0)


def _sums(fields: Arrays) -> Arrays:
    return [np.sum(field, CELLS) for field in fields]


def _inverse(one: Array, other: Array) -> Array:
    """Return the inverse of [[1, 1], [one, other]] at each position."""
    ones = np.ones_like(one)
    matrix: Array = np.stack([np.stack([ones, ones], -1), np.stack([one, other], -1)], -2)
    return np.asarray(np.linalg.pinv(matrix, rcond=1e-9), dtype=np.float64)
