"""The maps between the surfaces of bodies and the part of the window of an adjoint."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from tribo import Array, Box
from tribo.kernel_api import Model, region


@dataclass(frozen=True)
class Carrier:
    """The map between the points of a body, or of the contact, and the window.

    The points have `shape`; the window begins at one of the `cells` at each position. `weights`,
    shape (nx, ny), are the weights of cells in the average over a row, or over all if the shape is
    (1, 1); None where points are not averaged.
    """

    shape: tuple[int, int]
    cells: Sequence[tuple[int, int]]
    weights: Array | None

    def gathered(self, parts: Array, box: Box) -> Array:
        """Return the sum at the points of fields on a box, by position."""
        own = np.zeros(self.shape)
        if self.weights is not None:
            row = np.sum(parts, axis=(0, 1))
            own[0, self._columns(box)] = row if self.shape[1] > 1 else np.sum(row)
            return own
        for part, place in zip(parts, self._places(own, box), strict=True):
            own[place] += part
        return own

    def seen(self, own: Array, box: Box) -> Array:
        """Return a field at the points as it lies in a box, shape (positions, nx, ny)."""
        shape = (len(self.cells), *box.shape)
        if self.weights is not None:
            return np.broadcast_to(own[:, self._columns(box)], shape)
        if len({*self.cells}) == 1:
            return np.broadcast_to(own[next(self._places(own, box))], shape)
        return np.stack([own[place] for place in self._places(own, box)])

    def part(self, box: Box) -> Array | float:
        """Return the weight of each cell of a box in the mean rate of its point."""
        return 1.0 if self.weights is None else self.weights[box.slices]

    def _columns(self, box: Box) -> slice:
        return box.slices[1] if self.shape[1] > 1 else slice(None)

    def _places(self, own: Array, box: Box) -> Iterator[Any]:
        """Return the part of the points that lies in a box, at each position."""
        row, column = box.first
        for at, across in self.cells:
            yield region(own, (at + row, across + column), box.shape)


def carriers_between(model: Model, of_bodies: Mapping[str, Carrier]) -> dict[str, Carrier]:
    """Return the carriers of the states of effects, by key as in `State`."""
    found: dict[str, Carrier] = {}
    window, cells = model.grid.cells, [(0, 0)] * len(model.cycle)
    for key, (effect, field) in model.laws.between.items():
        if field.uniform:
            found[key] = Carrier((1, 1), cells, np.full(window, 1 / np.prod(window)))
        elif effect.carrier is None:
            found[key] = Carrier(window, cells, None)
        else:
            found[key] = of_bodies[effect.carrier]
    return found


def carriers_of(model: Model) -> dict[str, Carrier]:
    """Return the carriers of bodies, by name."""
    found, (rows, columns) = {}, model.grid.cells
    for name in model.case.bodies:
        exposure = model.cycle.maps[name]
        weights = None
        if exposure.averaged:
            # An average is linear: the averages of the window's rows are its weights.
            each = (np.outer(row, np.ones(columns)) for row in np.eye(rows))
            weights = np.concatenate([exposure.average(row) for row in each])
        cells = [exposure.first_cell(position) for position in range(len(model.cycle))]
        found[name] = Carrier((exposure.rows, columns), cells, weights)
    return found
