"""A sinusoidal surface on an elastic half-space: partial contact, and wear in full contact.

References
----------
H. M. Westergaard (1939), J. Appl. Mech. 6, 49-53; K. L. Johnson (1985),
Contact Mechanics, section 13.2; K. L. Johnson, J. A. Greenwood,
J. G. Higginson (1985), Int. J. Mech. Sci. 27, 383-396. The wear of a mode
follows from Archard's law, see `worn_amplitude`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from tribo.core.arrays import Array


def compliance(wavenumber: ArrayLike, modulus: float) -> Array:
    """Displacement per pressure of a mode on a half-space, K̂ = 2/(E*q).

    Parameters
    ----------
    wavenumber : array_like
        q = 2π/λ, or √(qx² + qy²), in 1/m.
    modulus : float
        Contact modulus E*, in Pa.

    Returns
    -------
    ndarray
        K̂, in m/Pa.
    """
    return np.asarray(2.0 / (modulus * np.asarray(wavenumber, dtype=float)))


def worn_amplitude(distance: ArrayLike, wear_coefficient: float, compliance: ArrayLike) -> Array:
    """Amplitude left of a pressure mode in full contact, exp(−ks/K̂).

    On a half-space, K̂ = 2/(E*q), that is exp(−kE*qs/2).

    Parameters
    ----------
    distance : array_like
        Sliding distance s, in m.
    wear_coefficient : float
        Archard's k, in 1/Pa; the sum over the bodies that wear locally.
    compliance : array_like
        Displacement per pressure K̂ of the mode, in m/Pa.

    Returns
    -------
    ndarray
        Amplitude relative to that at s = 0.

    Notes
    -----
    In full contact the elastic displacement makes up for the wear: K̂ p̂ + ŵ is
    constant, and dŵ/ds = k p̂.
    """
    return np.asarray(np.exp(-wear_coefficient * np.asarray(distance) / np.asarray(compliance)))


@dataclass(frozen=True)
class Westergaard:
    """A rigid wavy surface, Δ cos(2πx/λ), pressed on a half-space."""

    mean_pressure: float
    """Load per nominal area p̄, in Pa."""
    complete: float
    """Mean pressure p* = πE*Δ/λ that closes the gap, in Pa."""
    contact_fraction: float
    """Width of contact per wavelength, 2a/λ."""
    peak_pressure: float
    """Pressure on the crest, in Pa."""


def westergaard(
    mean_pressure: float, amplitude: float, wavelength: float, modulus: float
) -> Westergaard:
    """Press a one-dimensional sinusoid on a half-space.

    2a/λ = (2/π) asin √(p̄/p*) and p_max = 2√(p̄p*) up to p̄ = p* = πE*Δ/λ;
    beyond, full contact with p_max = p̄ + p*.

    Parameters
    ----------
    mean_pressure, amplitude, wavelength, modulus : float
        Load per nominal area p̄, in Pa; amplitude Δ and wavelength λ of the height
        Δ cos(2πx/λ), in m; contact modulus E*, in Pa.
    """
    complete = np.pi * modulus * amplitude / wavelength
    ratio = min(mean_pressure / complete, 1.0)
    peak = mean_pressure + complete
    if mean_pressure < complete:
        peak = 2.0 * float(np.sqrt(mean_pressure * complete))
    fraction = float(2.0 / np.pi * np.arcsin(np.sqrt(ratio)))
    return Westergaard(mean_pressure, complete, fraction, peak)


def westergaard_pressure(x: ArrayLike, contact: Westergaard, wavelength: float) -> Array:
    """Pressure along the wave, with a crest at x = 0.

    With ψ = πx/λ and sin²ψ_a = p̄/p*,
    p = (2p̄ cos ψ/sin²ψ_a) √(sin²ψ_a − sin²ψ); in full contact
    p = p̄ + p* cos 2ψ.

    Parameters
    ----------
    x : array_like
        Position, in m.
    contact : Westergaard
        From `westergaard`.
    wavelength : float
        λ, in m.

    Returns
    -------
    ndarray
        Pressure, in Pa, shaped like `x`.
    """
    psi = np.pi * np.asarray(x, dtype=float) / wavelength
    if contact.contact_fraction >= 1.0:
        return np.asarray(contact.mean_pressure + contact.complete * np.cos(2.0 * psi))
    root = np.sqrt(np.maximum(contact.mean_pressure / contact.complete - np.sin(psi) ** 2, 0.0))
    return np.asarray(2.0 * contact.complete * np.abs(np.cos(psi)) * root)


@dataclass(frozen=True)
class WavyLimits:
    """The two ends of the contact of a surface that is wavy both ways."""

    complete: float
    """Mean pressure p* that closes the gap, in Pa."""
    light_area: float
    """Contact area per nominal area as p̄/p* → 0."""
    heavy_area: float
    """The same as p̄/p* → 1."""


def johnson_greenwood_higginson(
    mean_pressure: float, amplitude: float, wavelength: float, modulus: float
) -> WavyLimits:
    """Press the surface Δ cos(2πx/λ) cos(2πy/λ) on a half-space.

    p* = √2 πE*Δ/λ. Light contacts are Hertz's, two crests per λ²:
    A/λ² = π (3p̄/8πp*)^⅔; heavy ones leave penny-shaped gaps at the troughs open,
    two per λ²: A/λ² = 1 − (3/2π)(1 − p̄/p*). Between them there is no closed form.

    Parameters
    ----------
    mean_pressure, amplitude, wavelength, modulus : float
        As for `westergaard`.
    """
    complete = float(np.sqrt(2.0) * np.pi * modulus * amplitude / wavelength)
    ratio = mean_pressure / complete
    light = np.pi * (3.0 * ratio / (8.0 * np.pi)) ** (2.0 / 3.0)
    heavy = 1.0 - 1.5 / np.pi * (1.0 - ratio)
    return WavyLimits(complete, float(light), float(heavy))
