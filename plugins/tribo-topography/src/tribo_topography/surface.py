"""The `topography.file` surface."""

from __future__ import annotations

import warnings

from tribo import Array, Grid, Surface, TriboWarning

from tribo_topography.config import MeasuredFile
from tribo_topography.facts import Facts, check, facts
from tribo_topography.form import detrended, filled, turned
from tribo_topography.read import read
from tribo_topography.sample import resolution, sampled

_MUCH = 4.0
"""Pixels of a cell, or cells of a pixel; a wave needs four."""


class MeasuredSurface(Surface, MeasuredFile):
    """Heights that an instrument measured, sampled on the window's cells.

    A warning tells the scale of a file whose size and range the case does not
    state as expected.

    Examples
    --------
    >>> from tribo_topography import MeasuredSurface
    >>> path = "plugins/tribo-topography/tests/data/waves.asc"
    >>> waves = MeasuredSurface(path=path, expect_size=("1.5 mm", "1.5 mm"), expect_range="2.57 um")
    >>> heights = waves.height(tribo.Grid("1 mm", 20))
    >>> f"{1e6 * float(np.ptp(heights)):.1f} µm on the window"
    '2.5 µm on the window'
    """

    type = "topography.file"

    _read: tuple[Array, tuple[float, float], Facts] | None = None
    _told: bool = False

    @property
    def scale(self) -> Facts:
        """What the file is taken to be; reads it."""
        return self._measured()[2]

    def facts(self) -> dict[str, str]:
        """Return how the file was read, for the user to check; reads it."""
        return self.scale.stated()

    def height(self, grid: Grid) -> Array:
        """Return the measured height; the window must lie inside the measured area."""
        heights, size, found = self._measured()
        values = sampled(heights, size, grid, self.centre)
        if not self._told:
            self._told = True
            self._tell(found, *resolution(heights.shape, size, grid))
        return values

    def _measured(self) -> tuple[Array, tuple[float, float], Facts]:
        if self._read is None:
            found = read(self)
            scale = facts(found, self)
            check(scale, self)
            whole = filled(detrended(found.heights, self.detrend), self)
            self._read = (*turned(whole, found.size, self), scale)
        return self._read

    def _tell(self, found: Facts, fewest: float, most: float) -> None:
        told = []
        if self.expect_size is None or self.expect_range is None:
            told.append(f"{found}. If that is right, say so with expect_size and expect_range")
        if most > _MUCH:
            told.append(
                f"a cell averages {most:.3g} pixels of {found.path.name} in a row, and roughness "
                "shorter than two cells is lost; raise grid.cells to keep it"
            )
        if fewest < 1 / _MUCH:
            told.append(
                f"a pixel of {found.path.name} is {1 / fewest:.3g} cells wide: nothing was "
                "measured between, and the contact is smoother than the body"
            )
        for words in told:
            warnings.warn(words, TriboWarning, stacklevel=3)
