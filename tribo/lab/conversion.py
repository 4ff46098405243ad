"""Wear in the units that are reported: specific wear rate, mass, volume."""

from __future__ import annotations


def specific_wear_rate(volume: float, load: float, distance: float) -> float:
    """Specific wear rate k = V/(F s).

    The number that ASTM G133 and ISO 18535 and 20808 report, and Archard's
    dimensional coefficient of the body that lost the volume.

    Parameters
    ----------
    volume : float
        Volume lost V, in m³.
    load : float
        Normal load F, in N.
    distance : float
        Sliding distance s, in m.

    Returns
    -------
    float
        k, in 1/Pa, the same as m³/(N·m).
    """
    return volume / (load * distance)


def in_mm3_per_newton_metre(wear_rate: float) -> float:
    """Convert a specific wear rate from 1/Pa to mm³/(N·m).

    Parameters
    ----------
    wear_rate : float
        Specific wear rate, in 1/Pa.

    Returns
    -------
    float
        The same, in mm³/(N·m): 10⁹ times as much.
    """
    return wear_rate * 1e9


def volume_from_mass(mass: float, density: float) -> float:
    """Volume lost, from a weighing (ASTM G99, section on mass loss).

    Parameters
    ----------
    mass : float
        Mass lost, in kg.
    density : float
        Density, in kg/m³.

    Returns
    -------
    float
        Volume, in m³.
    """
    return mass / density


def mass_from_volume(volume: float, density: float) -> float:
    """Mass that a balance would miss.

    Parameters
    ----------
    volume : float
        Volume lost, in m³.
    density : float
        Density, in kg/m³.

    Returns
    -------
    float
        Mass, in kg.
    """
    return volume * density
