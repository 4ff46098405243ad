"""A self-affine rough surface, made of random waves."""

from __future__ import annotations

import math
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity
from tribo.surfaces.relief import Laid, check_resolved

PERIOD = 8.0
"""In roll-off lengths: π · 8² = 200 waves of the plateau fit."""
Wavelength = Annotated[float, Quantity("m", above=0, usual=(1e-9, 0.1))]


class Rough(Laid):
    """Random waves with a power spectrum that falls as q^(-2-2H) between two wavelengths.

    Up to the roll-off the spectrum is even, beyond the cut-off 0; the phases are random, so that
    heights are nearly Gaussian. The same seed gives the same surface on any grid.

    References
    ----------
    B. N. J. Persson, O. Albohr, U. Tartaglino, A. I. Volokitin, E. Tosatti, J. Phys.: Condens.
    Matter 17 (2005) R1-R62; T. D. B. Jacobs, T. Junge, L. Pastewka, Surf. Topogr.: Metrol. Prop. 5
    (2017) 013001.

    Examples
    --------
    >>> ground = tribo.Rough(sq="50 nm", cut_off="0.4 mm", roll_off="1 mm")
    >>> height = ground.height(tribo.Grid("8 mm", 80))  # one period
    >>> round(float(height.std()) * 1e9, 3)  # nm
    50.0
    """

    examples = ({"sq": "50 nm", "cut_off": "0.4 mm", "roll_off": "1 mm", "seed": 1},)
    type = "rough"
    sq: Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-3))]
    """Root mean square height Sq."""
    cut_off: Wavelength
    """Shortest wavelength."""
    roll_off: Wavelength
    """Wavelength beyond which the spectrum is even."""
    hurst: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.8
    """Hurst exponent H: the smaller, the rougher at short wavelengths."""
    stretch: Annotated[float, Quantity("1", above=0)] = 1.0
    """How many times longer its waves are along x than along y: its lay."""
    period: Wavelength | None = None
    """Length after which it repeats, along x and y: eight times `roll_off` if left out."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Seed of the random phases."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.roll_off < self.cut_off:
            raise ValueError("roll_off must be at least as long as cut_off")
        if self.period is not None and self.period < self.roll_off:
            raise ValueError("period must be at least as long as roll_off")
        return self

    def relief(self, grid: Grid) -> Array:
        """Return the waves; the shortest must be at least four cells long."""
        # Waves are longer by the root of the stretch along x, and shorter by it along y.
        root = math.sqrt(self.stretch)
        shortest = self.cut_off * root, self.cut_off / root
        for length, spacing in zip(shortest, grid.spacing, strict=True):
            check_resolved(length, spacing, "cut_off")
        period = self.period or PERIOD * self.roll_off
        # In an order that does not depend on the grid; of a wave and its opposite one is drawn.
        i, j = (int(period / length * (1 + ROUND_OFF)) for length in shortest)
        along, across = np.arange(-i, i + 1)[:, None] / period, np.arange(j + 1) / period
        phases = np.random.default_rng(self.seed).uniform(0, 2 * math.pi, (2 * i + 1, j + 1))
        wavenumber = np.hypot(along * root, across / root)
        inside = wavenumber <= (1 + ROUND_OFF) / self.cut_off
        kept = (wavenumber > 0) & inside & ((across > 0) | (along > 0))
        amplitudes = np.zeros(phases.shape)
        rolled = np.maximum(wavenumber[kept] * self.roll_off, 1.0)
        amplitudes[kept] = rolled ** (-1 - self.hurst)
        amplitudes *= self.sq * math.sqrt(2 / float(np.sum(amplitudes**2)))
        waves = amplitudes * np.exp(1j * phases)
        x, y = grid.mesh
        # By sums, whose bits, unlike a product's, do not depend on the number of threads.
        lines = np.einsum("xi,ij->xj", np.exp(2j * math.pi * x * along.T), waves)
        relief = np.einsum("xj,jy->xy", lines, np.exp(2j * math.pi * across[:, None] * y))
        return np.array(relief.real)
