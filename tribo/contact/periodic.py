"""The `periodic` contact solver: two half-spaces whose contact repeats along x and y."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
import scipy

from tribo.contact.elastic import ElasticSolver
from tribo.contact.preconditioner import Preconditioner
from tribo.contact.projection import CELLS, over, project
from tribo.contact.residuals import check_finite
from tribo.core.arrays import Array, Mask
from tribo.core.box import Box, whole
from tribo.core.coating import Coating
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem


class PeriodicHalfSpace:
    """Elastic half-space under a pressure that repeats beyond the window; given as a `HalfSpace`.

    A mode of wavenumber q displaces the surface by 2/(E* q) per pressure (Johnson 1985, Contact
    Mechanics, section 13.2; Stanley & Kato 1997), the mean pressure by nothing: displacements count
    from their mean. Between the cells' centres the pressure is the trigonometric polynomial
    through them.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        spacing: tuple[float, float],
        modulus: float,
        coatings: tuple[Coating, ...] = (),
    ) -> None:
        self.shape = self.padded = shape
        self.spacing = spacing
        along = np.fft.fftfreq(shape[0], spacing[0])[:, None]
        across = np.fft.rfftfreq(shape[1], spacing[1])
        wavenumber = 2 * np.pi * np.hypot(along, across)
        wavenumber[0, 0] = np.inf
        self.spectrum = 2.0 / (modulus * wavenumber)
        finite = np.where(np.isinf(wavenumber), 0.0, wavenumber)
        for coating in coatings:
            self.spectrum += 2.0 * coating.influence(finite) / (coating.modulus * wavenumber)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under `pressure`; see `Operator.apply`."""
        modes = scipy.fft.rfft2(pressure)
        modes *= self.spectrum
        return np.asarray(scipy.fft.irfft2(modes, s=self.shape, overwrite_x=True))

    def symbol(self) -> Array:
        """Return the eigenvalues, with the largest in place of the mean's, which is 0."""
        symbol: Array = self.spectrum.copy()
        # A window of one cell has no modes but the mean.
        symbol[0, 0] = np.max(symbol) or 1.0
        return symbol


class Periodic(ElasticSolver):
    """Contact of two half-spaces that repeats with the window, for nominally flat surfaces.

    The window is one period along x and y, and its mean pressure the load over its area (Stanley &
    Kato 1997, J. Tribol. 119, 481-485). Far from the surface a mean pressure moves the whole body,
    so the approach counts from the mean of the deformed surface. The hardness limits the pressure
    as in `dcfft`.

    Examples
    --------
    >>> grid = tribo.Grid("1 mm", (4, 64))
    >>> gap = -tribo.Waves(amplitude="0.1 um", wavelength="1 mm").height(grid)
    >>> load = 0.5 * np.pi * 115e9 * 0.1e-6 / 1e-3 * 1e-6  # half of π E* A/λ, which closes the gap
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=load)
    >>> contact = tribo.Periodic().solve(tribo.ContactProblem(system, gap, load))
    >>> round(float(np.mean(contact.pressure > 0)), 1)  # part of the window in contact
    0.5
    """

    type = "periodic"
    _half_space = PeriodicHalfSpace
    periodic: ClassVar[bool] = True

    def _solve(
        self, system: ContactSystem, gap: Array, *given: Any, **named: Any
    ) -> list[ContactSolution]:
        # The digits of a deep uniform wear would be lost to a contact that hardly displaces.
        lowest = gap.min(CELLS)
        solutions = super()._solve(system, gap - over(lowest), *given, **named)
        return [
            replace(solution, approach=solution.approach + float(low))
            for solution, low in zip(solutions, np.ravel(lowest), strict=True)
        ]

    def _guess(self, problem: ContactProblem) -> Array:
        """Return the pressure that closes the gap everywhere, projected onto load and bounds."""
        check_finite(problem.gap)
        system = problem.system
        pressure = Preconditioner(self._operator(system, system.grid.cells))(-problem.gap)
        total = np.asarray(problem.load / system.grid.cell_area)
        cap = system.cap if problem.cap is None else problem.cap
        cells = np.ones(pressure.shape, dtype=bool)
        return project(pressure, total, np.inf if cap is None else cap, cells)

    def _around(self, touching: Mask) -> Box:
        return whole((touching.shape[0], touching.shape[1]))
