"""The rise under a source, over its flux times its radius and over the conductivity."""

import math

from tribo_thermal.sources import LIMITS, rise_per_power


def found() -> dict[str, float]:
    """Return the rise under each profile, its mean or maximum, at each Peclet number."""
    return {
        f"{rise} under a {profile} source, Pe {peclet:g}": math.pi
        * rise_per_power(1.0, 1.0, peclet, profile, rise)
        for profile, rise in LIMITS
        for peclet in (0.0, 0.3, 3.0, 300.0)
    }
