"""Anderson's mixing: a fixed point found from several of its last iterates."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array

MEMORY = 3
"""Earlier iterates that are mixed in; more were not found to save passes."""
ALIKE = 1e-10


class Mixing:
    """Propose the next iterate of x = g(x) from the last few.

    The proposal is the mix of them whose residual g(x) - x would be smallest if g were linear.

    References
    ----------
    D. G. Anderson, J. ACM 12 (1965) 547-560; H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011)
    1715-1735.
    """

    def __init__(self) -> None:
        self._kept: list[tuple[Array, Array]] = []

    def next(self, given: Array, found: Array) -> Array:
        """Return what to try next.

        Parameters
        ----------
        given : ndarray
            The last iterate x.
        found : ndarray
            g(x), of the same shape.
        """
        residual = found - given
        earlier = [(found - f, residual - r) for f, r in self._kept]
        self._kept = [*self._kept[1 - MEMORY :], (found, residual)]
        if not earlier:
            return found
        # By sums, whose bits do not depend on the number of threads as those of a product do.
        gram = np.array([[np.sum(a * b) for _, b in earlier] for _, a in earlier])
        right = np.array([np.sum(a * residual) for _, a in earlier])
        parts = np.linalg.lstsq(gram, right, rcond=ALIKE)[0]
        mixed = found.copy()
        for part, (change, _) in zip(parts, earlier, strict=True):
            mixed -= part * change
        return mixed
