"""Derivatives of rates in their inputs: at each point, in the load and in Σp²."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from tribo import Array
from tribo.kernel_api import CELLS, over

NUDGE = 3e-5
"""Part of the pressures by which they are varied up and down."""
ASIDE = 1e-7
"""Part of a value by which it is varied to one side for a derivative."""
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
        if isinstance(seed, np.ndarray) and isinstance(response.own, np.ndarray):
            found = found + seed * response.own
    return found


def responses(found: Arrays, moved: Arrays, span: Array) -> list[Response]:
    """Return the responses of rates in values of their own cell, from rates with these moved.

    They move by `span`. An array that is among both rates has no derivative.
    """
    by = np.where(span == 0, np.inf, span)
    pairs = zip(found, moved, strict=True)
    return [Response(0.0 if now is was else (now - was) / by) for was, now in pairs]


def shared(rates: Rates, pressure: Array) -> list[Response]:
    """Return the responses of rates that also depend on the load and the mean of squares.

    Such rates come from effects that share the load, or that are uniform over the contact.
    """
    load, square = np.sum(pressure, CELLS), np.sum(pressure**2, CELLS)
    steep = pressure / over(np.max(pressure, CELLS))
    ones, checks = np.ones_like(steep), np.indices(pressure.shape[-2:]).sum(axis=0) % 2
    stripes = np.where(checks, -ones, ones)

    def changes(part: Array) -> Array:
        """Return what a part changes of the load and of Σp², relative to them."""
        by = part * pressure
        return np.stack([np.sum(by, CELLS) / load, np.sum(pressure * by, CELLS) / square], -1)

    def slopes(part: Array) -> Arrays:
        higher, lower = (rates((1 + by * part) * pressure) for by in (NUDGE, -NUDGE))
        return [(up - down) / (2 * NUDGE) for up, down in zip(higher, lower, strict=True)]

    # Where pressures are even, both parts change both alike.
    inverse = np.linalg.pinv(np.stack([changes(ones), changes(steep)], -2), rcond=1e-9)
    even, steeper = (over(np.sum(changes(stripes) * inverse[..., at], -1)) for at in (0, 1))
    # Stripes that change neither.
    balanced = stripes - even - steeper * steep
    varied = (np.abs(balanced) > LEAST) & (pressure > 0)
    found = []
    for by_balanced, by_all, by_steep in zip(*map(slopes, (balanced, ones, steep)), strict=True):
        own = by_balanced / np.where(varied, balanced * pressure, np.inf)
        left = by_all - own * pressure, by_steep - own * steep * pressure
        of_load, of_square = (
            sum(over(row[..., at] / total) * left[at] for at in (0, 1))
            for row, total in ((inverse[..., 0, :], load), (inverse[..., 1, :], square))
        )
        found.append(Response(own, of_load, of_square))
    return found
