"""The elastic half-space by DC-FFT: pressure to displacement on a padded box."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import scipy
from numpy.typing import NDArray

from tribo.contact.coated import base_kernel
from tribo.contact.love import nyquist_compliance, wrapped_kernel
from tribo.core.arrays import Array
from tribo.core.coating import Coating

_CACHED = 1 << 15
"""Complex numbers that a processor's cache holds: positions are transformed so many at a time."""


class HalfSpace:
    """Elastic half-space, coated or not, under pressure that is constant in each cell.

    The discrete convolution is evaluated with zero padding (DC-FFT), which
    makes it the exact sum of Love's displacements: no periodic images.

    Parameters
    ----------
    shape : tuple of int
        Cells (nx, ny) of the box.
    spacing : tuple of float
        Edge lengths of a cell along x and y, in m.
    modulus : float
        Contact modulus E*, in Pa; with coatings the modulus of the layers at the surface.
    coatings : tuple of Coating, optional
        Elastic layers on the half-spaces.

    References
    ----------
    S. Liu, Q. Wang, G. Liu, "A versatile method of discrete convolution and FFT
    (DC-FFT) for contact analyses", Wear 243 (2000) 101-111.

    Examples
    --------
    >>> steel = tribo.HalfSpace(shape=(33, 33), spacing=(1e-5, 1e-5), modulus=115e9)
    >>> displacement = steel.apply(np.full((33, 33), 1e9))
    >>> round(float(displacement[16, 16]) * 1e6, 2)  # µm: 1.122 p L/E* in the middle of a square
    3.22
    """

    def __init__(
        self,
        shape: tuple[int, int],
        spacing: tuple[float, float],
        modulus: float,
        coatings: tuple[Coating, ...] = (),
    ) -> None:
        self.shape = shape
        self.spacing = spacing
        self.modulus = modulus
        rows, columns = (scipy.fft.next_fast_len(2 * n - 1, real=True) for n in shape)
        self.padded = whole = rows, columns
        kernel = wrapped_kernel(whole, spacing)
        # An even kernel has a real spectrum.
        self.spectrum = scipy.fft.rfft2(kernel).real / modulus
        (nx, ny), twice = shape, (2 * shape[0], 2 * shape[1])
        near = kernel if whole == twice else wrapped_kernel(twice, spacing)
        # On the box with its nearest images, each counted once.
        periodic = scipy.fft.rfft2(near.reshape(2, nx, 2, ny).sum(axis=(0, 2))).real
        if coatings:
            self.spectrum += scipy.fft.rfft2(base_kernel(whole, spacing, coatings)).real
            near = base_kernel(twice, spacing, coatings).reshape(2, nx, 2, ny)
            periodic += modulus * scipy.fft.rfft2(near.sum(axis=(0, 2))).real
        # The spectrum of a kernel that is cut off oscillates, and could become negative; the
        # bound keeps the preconditioner definite on any box.
        self._symbol = np.maximum(periodic, 0.5 * nyquist_compliance(spacing)) / modulus
        # Kept, since new memory costs as much as the transforms; a thread takes one and returns it.
        self._buffers: list[NDArray[np.complex128]] = []
        modes = self.padded[0] * (self.padded[1] // 2 + 1)
        self._at_once = max(1, _CACHED // modes)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under `pressure`; see `Operator.apply`."""
        if pressure.ndim == 2:
            (displacement,) = self._apply(pressure[None])
            return np.asarray(displacement)
        workers = min(scipy.fft.get_workers(), len(pressure))
        if workers == 1:
            return self._one_by_one(pressure)
        with ThreadPoolExecutor(workers) as side_by_side:
            parts = side_by_side.map(self._one_by_one, np.array_split(pressure, workers))
            return np.concatenate(list(parts))

    def _one_by_one(self, pressure: Array) -> Array:
        several = range(0, len(pressure), self._at_once)
        return np.concatenate([self._apply(pressure[k : k + self._at_once]) for k in several])

    def _apply(self, pressure: Array) -> Array:
        (nx, ny), length = self.shape, self.padded[1]
        buffer = self._take_buffer()
        modes = buffer[: len(pressure)]
        # Axis by axis, so that rows of padding are neither transformed nor kept.
        modes[:, :nx] = scipy.fft.rfft(pressure, length, axis=2)
        modes[:, nx:] = 0
        product = scipy.fft.fft(modes, axis=1, overwrite_x=True)
        product *= self.spectrum
        product = scipy.fft.ifft(product, axis=1, overwrite_x=True)
        displacement: Array = scipy.fft.irfft(product[:, :nx], length, axis=2)[:, :, :ny]
        self._buffers.append(buffer)
        return displacement

    def _take_buffer(self) -> NDArray[np.complex128]:
        try:
            return self._buffers.pop()
        except IndexError:
            shape = (self._at_once, self.padded[0], self.padded[1] // 2 + 1)
            return np.empty(shape, dtype=np.complex128)

    def symbol(self) -> Array:
        """Return the eigenvalues of the periodic operator with the same near field."""
        return np.asarray(self._symbol.copy())
