"""Wear in the units that are reported: specific wear rate, mass, volume."""

from __future__ import annotations


def specific_wear_rate(volume: float, load: float, distance: float) -> float:
    """Specific wear rate k = V/(F s), in 1/Pa, the same as m³/(N·m).

    The number that ASTM G133 and ISO 18535 and 20808 report, and Archard's
    dimensional coefficient of the body that lost the volume.

    Parameters
    ----------
    volume, load, distance : float
        Volume lost, in m³; normal load, in N; sliding distance, in m.
    """
    return volume / (load * distance)


def in_mm3_per_newton_metre(wear_rate: float) -> float:
    """Convert a specific wear rate from 1/Pa to mm³/(N·m), 10⁹ times as much."""
    return wear_rate * 1e9


def volume_from_mass(mass: float, density: float) -> float:
    """Volume lost, in m³, from a weighing in kg and kg/m³ (ASTM G99, section on mass loss)."""
    return mass / density


def mass_from_volume(volume: float, density: float) -> float:
    """Mass that a balance would miss, in kg, from a volume in m³ and kg/m³."""
    return volume * density
