"""The prior of a local wear coefficient: its standard deviation and correlation length."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.fft import idctn
from tribo import Array


@dataclass(frozen=True)
class Prior:
    """Prior of ln(k/k₀) at each cell: a Gaussian field.

    Its covariance is s² (r/ℓ) K₁(r/ℓ) (Whittle 1954, Biometrika 41, 434-449), with reflecting ends
    and a uniform standard deviation. The correlation at the distance ℓ is 0.60.
    """

    spread: float
    """Standard deviation s."""
    length: float
    """Correlation length ℓ, in m."""

    def amplitudes(self, shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
        """Return the relative standard deviations of the cosine modes, of the shape of the map."""
        waves = [np.pi * np.arange(n) / (n * h) for n, h in zip(shape, spacing, strict=True)]
        squared = waves[0][:, None] ** 2 + waves[1] ** 2
        planes = np.count_nonzero(np.array(shape) > 1)
        return np.asarray((1 + self.length**2 * squared) ** -(0.5 + 0.25 * planes))

    def scale(self, amplitudes: Array) -> Array:
        """Return the factor at each cell that makes the standard deviation of the field uniform."""
        waves = [idctn(np.eye(n), axes=[0], norm="ortho") ** 2 for n in amplitudes.shape]
        return np.asarray(self.spread / np.sqrt(waves[0] @ amplitudes**2 @ waves[1].T))
