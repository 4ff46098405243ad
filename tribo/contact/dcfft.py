"""The `dcfft` contact solver: two half-spaces in free space, elastic up to the hardness."""

from __future__ import annotations

import numpy as np

from tribo.contact.elastic import ElasticSolver
from tribo.contact.love import nyquist_compliance
from tribo.contact.padded_half_space import HalfSpace
from tribo.contact.residuals import check_finite
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSystem

# Relative error of a first approach: from the exact one solves took two iterations fewer at most.
_ROUGHLY = 0.1


class DcFft(ElasticSolver):
    """Contact of two elastic half-spaces, yielding where the pressure reaches the hardness.

    They may be coated. Each cell is under uniform pressure (Love 1929); the convolution is exact in
    free space (DC-FFT: Liu, Wang & Liu 2000, Wear 243, 101-111). With a hardness 0 <= p <= H, and
    what still overlaps at p = H is permanent (Almqvist et al. 2007): no volume is conserved, and
    real onset of yield, beneath the surface, comes at a lower load.

    The solve runs on a box around the contact. In free space that is exact
    as long as no cell outside the box overlaps, which is checked.

    Examples
    --------
    >>> grid = tribo.Grid("0.4 mm", 64)
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=10.0)
    >>> gap = -tribo.Sphere(radius="5 mm").height(grid)
    >>> contact = tribo.DcFft().solve(tribo.ContactProblem(system, gap, load=10.0))
    >>> round(float(contact.pressure.max()) / 1e9, 2)  # GPa, as Hertz's
    1.01
    """

    type = "dcfft"
    _half_space = HalfSpace

    def smallest_compliance(self, system: ContactSystem) -> float:
        """Return the compliance of the chequerboard mode, or the least on coatings, in m/Pa."""
        if system.coatings:
            return super().smallest_compliance(system)
        return nyquist_compliance(system.grid.spacing) / system.modulus

    def _guess(self, problem: ContactProblem) -> Array | None:
        """Return Hertz's pressure of a ball with the same gap; None where it is even."""
        check_finite(problem.gap)
        system, gap = problem.system, problem.gap - problem.gap.min()
        low, approach = 0.0, float(gap.max())
        while approach - low > _ROUGHLY * approach:
            middle = 0.5 * (low + approach)
            area = system.grid.cell_area * np.count_nonzero(gap < middle)
            # What a ball bears that would overlap by so much over this area, undeformed.
            if 2**1.5 / 3 * system.surface_modulus * middle * np.sqrt(area / np.pi) < problem.load:
                low = middle
            else:
                approach = middle
        # It touches where the gap is less than half of the approach.
        guess: Array = np.sqrt(np.maximum(0.5 * approach - gap, 0.0))
        return guess if guess.any() else None
