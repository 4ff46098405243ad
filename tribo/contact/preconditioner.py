"""An estimate of the inverse of an operator, to precondition with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy

from tribo.contact.operator import Operator
from tribo.core.arrays import Array
from tribo.core.contact import CycleCompliance, mean_where_positive


class Preconditioner:
    """An estimate of an operator's inverse: of its symbol, less what the wear of a cycle takes.

    A body that wears adds T c TᵀΩ to the operator (see `CycleCompliance`). By Woodbury's formula
    it takes T h TᵀΩ from the inverse, h = c / (K (K + s c)), as the symbol K is alike all along
    the body, where each point meets the share s of the positions. Bodies that stay take from what
    is alike at all positions, bodies that move from the rest: a pattern that moves with a body
    differs from position to position. The estimate is positive definite where a box leaves a margin
    around the contact; a contact that fills its box may take more iterations.
    """

    def __init__(self, operator: Operator) -> None:
        self.shape, self.symbol = operator.shape, operator.symbol()
        wear = getattr(operator, "wear", None)
        self.wears = isinstance(wear, CycleCompliance)
        if not isinstance(wear, CycleCompliance):
            return
        stay = [each for each in wear.bodies if len(set(each[1])) == 1]
        move = [each for each in wear.bodies if len(set(each[1])) > 1]
        self._stay, self._move = replace(wear, bodies=stay[:1]), replace(wear, bodies=move)
        together = sum(mean_where_positive(compliance) for compliance, _ in stay)
        self._of_stay = [self._factor(together, 1.0, own.shape) for own, _ in stay[:1]]
        shares = self._move.gather(np.ones((len(wear.shares), *operator.shape)))
        self._of_move = [
            self._factor(mean_where_positive(compliance), len(move) * np.max(share), share.shape)
            for (compliance, _), share in zip(move, shares, strict=True)
        ]

    def _factor(self, compliance: float, share: float, shape: tuple[int, ...]) -> Array:
        """Return h for the modes of a body: K has its wavenumbers, or the next smaller ones."""
        (nx, ny), (rows, columns) = self.shape, shape
        along, across = np.arange(rows), np.arange(columns // 2 + 1)
        of_modes = np.minimum(along, rows - along) * nx // rows, across * ny // columns
        symbol = self.symbol[np.ix_(*of_modes)]
        return np.asarray(compliance / (symbol * (symbol + share * compliance)))

    def __call__(self, residual: Array) -> Array:
        """Return the estimate of what causes a residual, (nx, ny) or (positions, nx, ny)."""
        modes = scipy.fft.rfft2(residual)
        modes /= self.symbol
        found: Array = scipy.fft.irfft2(modes, s=residual.shape[-2:], overwrite_x=True)
        return found - self.correction(residual) if self.wears else found

    def correction(self, residual: Array) -> Array:
        """Return what the wear of a cycle takes from the estimate."""
        stay, move, shape = self._stay, self._move, residual.shape
        alike = stay.gather(residual)
        rest = residual - stay.see(alike, shape)
        taken = move.see(_filtered(move.gather(rest), self._of_move), shape)
        again = stay.gather(taken)
        own = [a - b for a, b in zip(_filtered(alike, self._of_stay), again, strict=True)]
        return taken + stay.see(own, shape)


def _filtered(fields: Sequence[Array], factors: Sequence[Array]) -> list[Array]:
    pairs = zip(fields, factors, strict=True)
    return [scipy.fft.irfft2(scipy.fft.rfft2(f) * h, s=f.shape) for f, h in pairs]
