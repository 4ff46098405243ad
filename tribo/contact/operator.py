"""Operators from pressure to displacement: the protocol, and added wear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from tribo.core.arrays import Array
from tribo.core.contact import CycleCompliance, WearCompliance


class Operator(Protocol):
    """A symmetric positive definite map from pressure to displacement on a box of cells.

    Anything with these members can be given to `tribo.solve_bounded`.

    Examples
    --------
    >>> class Springs:
    ...     shape, spacing = (2, 2), (1e-3, 1e-3)
    ...     def apply(self, pressure):
    ...         return 1e-12 * pressure
    ...     def symbol(self):
    ...         return np.full((2, 2), 1e-12)
    >>> tribo.solve_bounded(Springs(), np.zeros((2, 2)), load=4.0).approach  # 1 µm under 1 MPa
    1e-06
    """

    @property
    def shape(self) -> tuple[int, int]:
        """Cells (nx, ny) of the box."""
        ...

    @property
    def spacing(self) -> tuple[float, float]:
        """Edge lengths of a cell along x and y, in m."""
        ...

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under `pressure`.

        It is in Pa and m, shape (nx, ny), or (positions, nx, ny) where positions of a cycle are
        solved together; the displacement is a new array.
        """
        ...

    def symbol(self) -> Array:
        """Return positive estimates of the eigenvalues, to precondition with.

        Shape (nx, ny // 2 + 1), for the modes of ``rfft2`` on the box, in m/Pa.
        """
        ...


@dataclass(frozen=True)
class WornOperator:
    """An operator with the wear of an implicit step as additional compliance."""

    base: Operator
    """The elastic operator K."""
    wear: WearCompliance | CycleCompliance
    """On the same box as `base`."""

    @property
    def shape(self) -> tuple[int, int]:
        """Cells (nx, ny) of the box."""
        return self.base.shape

    @property
    def spacing(self) -> tuple[float, float]:
        """Edge lengths of a cell along x and y, in m."""
        return self.base.spacing

    def apply(self, pressure: Array) -> Array:
        """Return K p and the depth that the step wears."""
        worn = self.wear.depth(pressure, self.spacing[0])
        worn += self.base.apply(pressure)
        return worn

    def symbol(self) -> Array:
        """Return the estimates of `base`, plus the mean compliance of wear, but of a cycle's."""
        if isinstance(self.wear, CycleCompliance):
            return self.base.symbol()
        local, swept = self.wear.typical(self.shape[0] * self.spacing[0])
        symbol = self.base.symbol() + local
        symbol[0] += swept
        return symbol
