"""The interface of wear laws: depth per metre of sliding at a point."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from tribo.component import Component
from tribo.core.arrays import Array
from tribo.core.fields import Field, LocalConditions, WearRate
from tribo.core.material import Material


class WearLaw(Component):
    """A pointwise law of wear.

    It knows nothing of grids, strokes or the other body: averaging along a
    track belongs to the kinematics.
    """

    requires: ClassVar[tuple[str, ...]] = ()
    """Names of the local fields it needs besides pressure and speed."""

    state_fields: ClassVar[tuple[Field, ...]] = ()
    """Fields it keeps per material point; each starts at `initial_state`."""

    def check(self, material: Material) -> None:
        """Raise `CaseError` if the law cannot serve a body of `material`."""

    def check_cells(self, spacing: tuple[float, float]) -> None:
        """Raise `CaseError` if cells of this length along x and y, in m, are too large for it."""

    def initial_state(self) -> dict[str, float]:
        """Return the initial value of each state field; zero unless overridden."""
        return {field.name: 0.0 for field in self.state_fields}

    def smoothed(self) -> WearLaw:
        """Return the law without what varies from place to place, for a trial on a coarse grid.

        Itself, unless overridden.
        """
        return self

    @abstractmethod
    def rate(self, local: LocalConditions) -> WearRate:
        """Return depth per metre of sliding and its derivative in pressure, at fixed fields.

        Parameters
        ----------
        local : LocalConditions
            Conditions at each point; not to be written to.

        Returns
        -------
        WearRate
            Arrays of the pressure's shape. Where the pressure is 0 the depth and the rates of
            the state are 0.
        """

    def advance(self, local: LocalConditions, distance: Array | float) -> WearRate | None:
        """Return the exact mean of `rate` over a distance, in which the law's own state goes on.

        Pressure and fields stay as they are. A law with a closed form of it spares the run the
        integration of its state; any other answers None, and its rates are integrated.

        Parameters
        ----------
        local : LocalConditions
            Conditions at each point, with the state before; not to be written to.
        distance : float or ndarray
            In m; of a body in layers that of each point, at the shape of the pressure.

        Returns
        -------
        WearRate or None
            Means per metre; no slope is needed.
        """
        return None
