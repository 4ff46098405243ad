"""The maps between the surfaces of bodies and the part of the window of an adjoint."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from tribo import Array, Box, CaseError
from tribo.kernel_api import Model, region


@dataclass(frozen=True)
class Carrier:
    """The map between a body's own surface and the window.

    The surface has `rows` cells along x; the window begins at its row `starts` at each position.
    `weights`, shape (nx, ny), are the weights of cells in the average over a row; None where points
    are not averaged.
    """

    rows: int
    starts: Sequence[int]
    weights: Array | None

    def gathered(self, parts: Array, box: Box) -> Array:
        """Return the sum on the body of fields on a box, by position: shape (rows, ny)."""
        along, columns = box.slices
        own = np.zeros((self.rows, box.window[1]))
        if self.weights is not None:
            own[0, columns] = np.sum(parts, axis=(0, 1))
            return own
        for part, start in zip(parts, self.starts, strict=True):
            rows = own[:, columns]
            rows[region(rows, (start + along.start, 0), part.shape)] += part
        return own

    def seen(self, own: Array, box: Box) -> Array:
        """Return fields on the body, shape (…, rows, ny), as they lie in a box, by position."""
        along, columns = box.slices
        field = own[..., columns]
        if self.weights is not None or not any(self.starts):
            here = field if self.weights is not None else field[..., along, :]
            shape = (*own.shape[:-2], len(self.starts), *box.shape)
            placed = here[..., None, :, :]
            return placed if placed.shape == shape else np.broadcast_to(placed, shape)
        rows = np.arange(along.start, along.stop)
        each = [np.take(field, start + rows, -2, mode="wrap") for start in self.starts]
        return np.stack(each, axis=-3)

    def part(self, box: Box) -> Array | float:
        """Return the weight of each cell of a box in the mean rate of its point."""
        return 1.0 if self.weights is None else self.weights[box.slices]


@dataclass(frozen=True)
class Uniform(Carrier):
    """The carrier of one number for all of the window."""

    def gathered(self, parts: Array, box: Box) -> Array:
        """Return the sum of fields on a box, shape (1, 1)."""
        return np.sum(parts).reshape(1, 1)

    def seen(self, own: Array, box: Box) -> Array:
        """Return the number, shape (…, 1, 1), at each cell of a box, by position."""
        shape = (*own.shape[:-2], len(self.starts), *box.shape)
        return np.broadcast_to(own[..., None, :, :], shape)


def carriers_between(model: Model, of_bodies: Mapping[str, Carrier]) -> dict[str, Carrier]:
    """Return the carriers of the states of effects, by key as in `State`."""
    found: dict[str, Carrier] = {}
    rows, starts = model.grid.cells[0], [0] * len(model.cycle)
    for key, (effect, field) in model.laws.between.items():
        if field.uniform:
            even = np.full(model.grid.cells, 1 / np.prod(model.grid.cells))
            found[key] = Uniform(1, starts, even)
        elif effect.carrier is None:
            found[key] = Carrier(rows, starts, None)
        else:
            found[key] = of_bodies[effect.carrier]
    return found


def carriers_of(model: Model) -> dict[str, Carrier]:
    """Return the carriers of bodies, by name.

    Raises
    ------
    CaseError
        If a body moves across.
    """
    found, cells = {}, model.grid.cells
    for name in model.case.bodies:
        exposure = model.cycle.maps[name]
        if exposure.across is not None:
            raise CaseError(
                f"{name} moves across as well as along x with {model.case.kinematics.type!r}, "
                "which has no gradient; use a motion along x",
                "kinematics.type",
            )
        weights = None
        if exposure.averaged:
            # An average is linear: the averages of the window's rows are its weights.
            rows = (np.outer(row, np.ones(cells[1])) for row in np.eye(cells[0]))
            weights = np.concatenate([exposure.average(row) for row in rows])
        starts = exposure.starts if exposure.starts is not None else [0] * len(model.cycle)
        found[name] = Carrier(exposure.rows, starts, weights)
    return found
