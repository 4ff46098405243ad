"""The largest eigenpairs of a symmetric operator, given by its products."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from tribo import Array

CHECK_INTERVAL = 10
"""Products with the Fisher information between two checks of their gain."""
LEAST_GAIN = 0.2
"""Degrees of freedom per product below which the Krylov space is large enough."""
EXHAUSTED = 1e-9
"""Relative length of a new Krylov vector that is rounding."""


def eigenpairs(product: Callable[[Array], Array], size: int, most: int) -> tuple[Array, Array]:
    """Return approximate eigenvectors, as rows, and eigenvalues, by Lanczos' method."""
    vector = np.random.default_rng(0).standard_normal(size)
    basis = images = np.empty((0, size))
    projected, gained = np.empty((0, 0)), 0.0
    while len(basis) < min(most, size):
        whole = np.sum(vector**2)
        for _ in range(2):
            along = np.sum(basis * vector, axis=1)
            vector = vector - np.sum(along[:, None] * basis, axis=0)
        left = np.sum(vector**2)
        if left <= EXHAUSTED**2 * whole:
            break
        basis = np.vstack([basis, vector / left**0.5])
        vector = product(basis[-1])
        images = np.vstack([images, vector])
        projected = basis @ images.T
        projected = 0.5 * (projected + projected.T)
        if len(basis) % CHECK_INTERVAL == 0:
            # Degrees of freedom Σ λ/(1 + λ) = n − tr (1 + H)⁻¹.
            inverse = np.linalg.inv(np.eye(len(basis)) + projected)
            former, gained = gained, len(basis) - float(np.trace(inverse))
            if gained - former < LEAST_GAIN * CHECK_INTERVAL:
                break
    values, vectors = np.linalg.eigh(projected)
    return vectors.T @ basis, np.maximum(values, 0.0)
