"""Anderson's mixing: a fixed point found from several of its last iterates."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array

ALIKE = 1e-10


class Mixing:
    """Proposes what to put into x = g(x) next, from what came of the last few.

    The proposal is the mix of them whose residual g(x) - x would be smallest if g were linear.

    Parameters
    ----------
    memory : int
        Iterates that are mixed; none, and the proposal is always g(x).

    References
    ----------
    D. G. Anderson, J. ACM 12 (1965) 547-560; H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011)
    1715-1735.
    """

    def __init__(self, memory: int) -> None:
        self._memory = memory
        self._given: Array | None = None
        self._kept: list[tuple[Array, Array]] = []

    def next(self, found: Array) -> Array:
        """Return the next x, of `found`, what g gave for the last."""
        if self._given is not None and self._memory:
            found = self._mixed(found, found - self._given)
        self._given = found
        return found

    def _mixed(self, found: Array, residual: Array) -> Array:
        changes = [(found - f, residual - r) for f, r in self._kept]
        self._kept = [*self._kept[1 - self._memory :], (found, residual)]
        if not changes:
            return found
        # By sums, whose bits do not depend on the number of threads as those of a product do.
        gram = np.array([[np.sum(a * b) for _, b in changes] for _, a in changes])
        right = np.array([np.sum(a * residual) for _, a in changes])
        parts = np.linalg.lstsq(gram, right, rcond=ALIKE)[0]
        mixed = found.copy()
        for part, (change, _) in zip(parts, changes, strict=True):
            mixed -= part * change
        return mixed
