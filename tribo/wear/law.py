"""The interface of wear laws: depth per metre of sliding at a point."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from tribo.component import Component
from tribo.core.fields import Field, LocalConditions, WearRate
from tribo.core.material import Material


class WearLaw(Component):
    """A pointwise law of wear.

    It knows nothing of grids, strokes or the other body: averaging along a track belongs to the
    kinematics.

    Examples
    --------
    >>> class Threshold(tribo.WearLaw):
    ...     def rate(self, local):
    ...         return tribo.WearRate(1e-15 * np.maximum(local.pressure - 1e8, 0))
    >>> local = tribo.LocalConditions(np.array([5e7, 2e8]), 0.1, tribo.Material(name="100Cr6"))
    >>> Threshold().rate(local).depth_rate.round(9).tolist()  # m/m
    [0.0, 1e-07]
    """

    requires: ClassVar[tuple[str | Field, ...]] = ()
    """Local fields it needs besides pressure and speed: their names, or a `Field` with the limits
    and the typical value at which the conformance kit tries the law."""

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
        """Return the law without its variation from place to place, for a trial on a coarse grid.

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
