"""The cells in contact over a cycle, one after the other, and what laws and bodies make of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from tribo.core.arrays import Array, readonly
from tribo.core.errors import CaseError
from tribo.core.fields import FRICTION_COEFFICIENT, PLACE_X, PLACE_Y, LocalConditions
from tribo.simulation.model import Model
from tribo.stepping.rates import by_row
from tribo.study.gradient.linear import Carrier

Index = NDArray[np.intp]


@dataclass(frozen=True)
class Touched:
    """The cells with pressure at the positions of a cycle.

    Parameters
    ----------
    position, x, y : ndarray of int, shape (cells,)
        Where each is: at which position, and in which cell of the window.
    pressure : ndarray, shape (cells,)
        In Pa.
    """

    position: Index
    x: Index
    y: Index
    pressure: Array

    @staticmethod
    def joined(parts: Sequence[Touched]) -> Touched:
        """Return the cells of several cycles, one after the other."""
        return Touched(
            *(
                np.concatenate([getattr(part, each.name) for part in parts])
                for each in fields(Touched)
            )
        )

    def rows(self, carrier: Carrier) -> Index:
        """Return the row of each cell on a body's own surface."""
        if carrier.weights is not None:
            return np.zeros_like(self.x)
        found: Index = (self.x + np.asarray(carrier.starts)[self.position]) % carrier.rows
        return found

    def weights(self, carrier: Carrier) -> Array | float:
        """Return with which weight an average of a body takes each cell."""
        return 1.0 if carrier.weights is None else carrier.weights[self.x, self.y]

    def seen(self, carrier: Carrier, own: Array) -> Array:
        """Return a derivative in the average of a rate, as one in the rate of each cell."""
        found: Array = own[self.rows(carrier), self.y] * self.weights(carrier)
        return found

    def summed(self, carrier: Carrier, values: Array) -> Array:
        """Return the sums of values where the cells lie on a body's own surface: (rows, ny)."""
        ny = carrier.cells[1]
        place = self.rows(carrier) * ny + self.y
        found = np.bincount(place, values, carrier.rows * ny)
        return np.asarray(found.reshape(carrier.rows, ny), dtype=float)

    def rate(
        self, model: Model, name: str, carrier: Carrier, speed: float, pressure: Array
    ) -> Array:
        """Return the depth per metre that a body's law gives in each cell under a pressure.

        `speed` (m/s) is taken where the motion does not state those of its cycle.
        """
        law = model.laws[name]
        dx, dy = model.grid.spacing
        middle = 0.5 * (carrier.rows - 1), 0.5 * (carrier.cells[1] - 1)
        given: dict[str, Array] = {}
        for field in law.requires:
            if field == PLACE_X.name:
                given[field] = dx * (np.asarray(self.rows(carrier), float) - middle[0])
            elif field == PLACE_Y.name:
                given[field] = dy * (np.asarray(self.y, float) - middle[1])
            elif field == FRICTION_COEFFICIENT.name and model.friction_coefficient is not None:
                given[field] = np.full(len(self.x), model.friction_coefficient)
        found = np.zeros_like(pressure)
        for here, at, share in self._speeds(model, speed):
            conditions = LocalConditions(
                pressure=readonly(pressure[here, None]),
                speed=at,
                material=law.material,
                fields={field: readonly(values[here, None]) for field, values in given.items()},
                state={},
            )
            found[here] += share * law.rate(conditions).depth_rate[:, 0]
        return found

    def _speeds(
        self, model: Model, speed: float
    ) -> Iterator[tuple[slice | Index, float, Array | float]]:
        """Yield cells, the speed at which they are to be asked, and what that counts for."""
        if all(place.speeds is None and place.reach is None for place in model.cycle):
            yield slice(None), speed, 1.0
            return
        for position, place in enumerate(model.cycle):
            here = np.flatnonzero(self.position == position)
            speeds = place.speeds or [(speed, 1.0)]
            if place.reach is None:
                yield from ((here, at, share) for at, share in speeds)
            else:
                for at, share in by_row(speeds, place.reach):
                    yield here, at, share[self.y[here]]


def carriers(model: Model) -> dict[str, Carrier]:
    """Return how each body's own surface meets the window, by name.

    Raises
    ------
    CaseError
        If the average over a track is not a weighted sum over its rows.
    """
    return {name: _carrier(model, name) for name in model.bodies}


def _carrier(model: Model, name: str) -> Carrier:
    exposure, cells = model.exposures[name], model.grid.cells
    starts = exposure.starts if exposure.starts is not None else [0] * len(model.cycle)
    trial = np.random.default_rng(0).random(cells)
    answer, expected, weights = exposure.average(trial), trial, None
    if exposure.averaged:
        weights = np.zeros(cells)
        for row, of_row in enumerate(weights):
            probe = np.zeros(cells)
            probe[row] = 1.0
            of_row[:] = exposure.average(probe)[0]
        expected = np.sum(weights * trial, axis=0, keepdims=True)
    if answer.shape != expected.shape or not np.allclose(answer, expected, rtol=1e-12, atol=0):
        raise CaseError(
            f"the average of {model.case.kinematics.type!r} over the track of {name} is not a sum "
            "over its rows, for which gradients are known",
            "kinematics.type",
        )
    return Carrier(exposure.rows, cells, starts, weights)
