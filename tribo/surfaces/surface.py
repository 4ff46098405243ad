"""The interface of surfaces: the height of an unworn body."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from tribo.component import Component
from tribo.core.arrays import Array
from tribo.core.grid import Grid


class Surface(Component):
    """The shape of a body before it wears.

    Examples
    --------
    >>> class Step(tribo.Surface):
    ...     def height(self, grid):
    ...         return np.where(grid.mesh[0] > 0, 1e-6, np.zeros(grid.cells))
    >>> Step().height(tribo.Grid("1 mm", (4, 1)))[:, 0].tolist()
    [0.0, 0.0, 1e-06, 1e-06]
    """

    smooth: ClassVar[bool] = False
    """Whether it is a smooth form whatever its heights are; else they tell."""

    @abstractmethod
    def height(self, grid: Grid) -> Array:
        """Return the height outward from the body, in m.

        Parameters
        ----------
        grid : Grid
            Where to sample it, in contact-frame x and y.

        Returns
        -------
        ndarray, shape (nx, ny)
            Any constant may be added: the gap is shifted to minimum 0.

        Raises
        ------
        CaseError
            If the surface does not reach over the window.
        """

    def smoothed(self) -> Surface:
        """Return the surface without relief that a coarse grid cannot show, to estimate with.

        Itself, unless overridden.
        """
        return self

    @property
    def curvature(self) -> tuple[float, float] | None:
        """Curvature at the highest point along x and y, in 1/m, or None if not known.

        Positive where the body is convex.
        """
        return None
