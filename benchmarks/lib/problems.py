"""The contacts that are solved, and the judge of all answers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np
import scipy.fft

from tribo import Array

MODULUS = 207e9 / (2 * (1 - 0.3**2))
RADIUS = 5e-3
LOAD = 100.0
WINDOW = 2e-3
HARDNESS = 4e9
WEAR_STEP = 1e-9


@dataclass(frozen=True)
class Contact:
    """A contact on a square window.

    Parameters
    ----------
    gap : ndarray, shape (n, n)
        In m.
    width : float
        Edge of the window, in m.
    load : float
        In N.
    depth : float
        Length that gaps are judged by, in m: Hertz's approach, or the rms height.
    pressure : float
        A pressure of the order of the largest, in Pa.
    cap : float, optional
        Largest pressure, in Pa.
    periodic : bool, optional
        Whether the window repeats without end.
    """

    gap: Array
    width: float
    load: float
    depth: float
    pressure: float
    cap: float | None = None
    periodic: bool = False

    @property
    def spacing(self) -> float:
        """Edge of a cell, in m."""
        return self.width / len(self.gap)

    @property
    def mean_pressure(self) -> float:
        """Load over the area of the window, in Pa."""
        return self.load / self.width**2

    def worn(self, pressure: Array) -> Contact:
        """Return the contact after wear of `WEAR_STEP` at the reference pressure."""
        return replace(self, gap=self.gap + WEAR_STEP * pressure / self.pressure)


@dataclass(frozen=True)
class Verdict:
    """How far a pressure is from the conditions of contact.

    Parameters
    ----------
    load_error : float
        \\|sum(p) * cell area / load − 1\\|.
    complementarity : float
        sum(p * \\|g\\|) / (sum(p) * depth); at the cap only an open gap counts.
    penetration : float
        Largest overlap where there is no pressure, over the depth.
    """

    load_error: float
    complementarity: float
    penetration: float

    def passes(self, duty: float) -> bool:
        """Whether the answer is as good as `duty`."""
        return self.complementarity <= duty and self.load_error <= duty


def hertz(load: float) -> tuple[float, float, float]:
    """Return contact radius (m), largest pressure (Pa) and approach (m) of Hertz's contact."""
    radius = (3 * load * RADIUS / (4 * MODULUS)) ** (1 / 3)
    return radius, 3 * load / (2 * np.pi * radius**2), radius**2 / RADIUS


def ball(
    cells: int, load: float = LOAD, width: float = WINDOW, cap: float | None = None
) -> Contact:
    """Return the paper's contact, of a paraboloid, which every package can be given."""
    x = (np.arange(cells) + 0.5) * width / cells - width / 2
    _, pressure, depth = hertz(load)
    gap = (x[:, None] ** 2 + x**2) / (2 * RADIUS)
    return Contact(gap, width, load, depth, pressure, cap)


def tight(load: float = LOAD) -> float:
    """Return the width of a window of four contact radii."""
    return 4 * hertz(load)[0]


def rough(cells: int) -> Contact:
    """Return a self-affine surface that repeats, pressed to about a twentieth of contact.

    Hurst exponent 0.8, wavelengths from a fourth of the window to eight cells,
    root-mean-square slope 0.1, mean pressure 0.0022 E*.
    """
    wave = np.fft.fftfreq(cells, 1 / cells)
    number = np.hypot(wave[:, None], wave)
    amplitude = np.zeros_like(number)
    band = (number >= 4) & (number <= max(cells // 8, 8))
    amplitude[band] = number[band] ** -1.8
    noise = np.random.default_rng(1).standard_normal((cells, cells))
    modes = amplitude * scipy.fft.fft2(noise)
    slope = 2 * np.pi / WINDOW * np.linalg.norm(number * modes) / cells**2
    heights = scipy.fft.ifft2(modes).real * (0.1 / slope)
    load = 0.0022 * MODULUS * WINDOW**2
    depth = float(np.std(heights))
    return Contact(heights.max() - heights, WINDOW, load, depth, 0.05 * MODULUS, periodic=True)


BALLS = {"ball, 2 mm": ball, "ball, 4a": partial(ball, width=tight())}
CONTACTS = {**BALLS, "plastic": partial(ball, load=1000.0, cap=HARDNESS), "rough": rough}


def judge(contact: Contact, pressure: Array) -> Verdict:
    """Judge a pressure by a kernel of the benchmark's own.

    In free space that is Love's (1929) for each cell; on a periodic window
    2 / (E* q), which the peers use too.
    """
    area = contact.spacing**2
    gap = contact.gap + _displacement(contact, pressure)
    loaded = pressure > 0
    limit = np.inf if contact.cap is None else contact.cap
    full = pressure >= limit * (1 - 1e-9)
    gap -= gap[loaded & ~full].mean()
    opening = np.where(full, np.maximum(gap, 0.0), np.abs(gap))
    weight = float(pressure.sum()) * contact.depth
    return Verdict(
        load_error=float(abs(pressure.sum() * area / contact.load - 1)),
        complementarity=float((pressure * opening).sum()) / weight,
        penetration=max(0.0, -float(gap[~loaded].min(initial=0.0))) / contact.depth,
    )


def _displacement(contact: Contact, pressure: Array) -> Array:
    cells = len(pressure)
    size = cells if contact.periodic else 2 * cells
    kernel = _periodic if contact.periodic else _love
    modes = scipy.fft.rfft2(pressure, (size, size)) * kernel(cells, contact.spacing)
    displacement: Array = scipy.fft.irfft2(modes, (size, size))[:cells, :cells]
    return displacement


@lru_cache(maxsize=1)
def _love(cells: int, spacing: float) -> Array:
    # Love's potential at the corners of cells, differenced: no corner lies on an axis.
    corner = (np.arange(cells + 2) - 0.5) * spacing
    x, y = corner[:, None], corner
    potential = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    quarter = np.diff(np.diff(potential, axis=0), axis=1) / (np.pi * MODULUS)
    offset = np.minimum(np.arange(2 * cells), 2 * cells - np.arange(2 * cells))
    spectrum: Array = scipy.fft.rfft2(quarter[np.ix_(offset, offset)]).real
    return spectrum


@lru_cache(maxsize=1)
def _periodic(cells: int, spacing: float) -> Array:
    q = (
        2
        * np.pi
        * np.hypot(scipy.fft.fftfreq(cells, spacing)[:, None], scipy.fft.rfftfreq(cells, spacing))
    )
    with np.errstate(divide="ignore"):
        spectrum: Array = 2 / (MODULUS * q)
    spectrum[0, 0] = 0.0
    return spectrum
