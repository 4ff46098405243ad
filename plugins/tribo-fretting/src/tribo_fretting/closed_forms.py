"""Partial slip of a ball on a ball or a flat, after Cattaneo and Mindlin, as functions.

They hold for one component of the traction, along the motion, and similar bodies. P is the load, μ
the coefficient of friction, a the radius of the contact, Q the amplitude of the tangential force,
C = Σ (2 − ν)/G over both bodies.

References
----------
Mindlin, R. D., Deresiewicz, H. (1953), Elastic spheres in contact under varying oblique forces, J.
Appl. Mech. 20, 327-344. Johnson, K. L. (1985), Contact Mechanics, sections 7.2 and 7.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from tribo import Material


def tangential_compliance(materials: Iterable[Material]) -> float:
    """Return C = Σ (2 − ν)/G, in 1/Pa."""
    return sum((2 - m.poisson) * 2 * (1 + m.poisson) / m.young for m in materials)


def stick_radius(ratio: float, radius: float) -> float:
    """Return c = a (1 − Q/μP)^⅓, in m, for the `ratio` Q/μP and the contact's `radius` (m)."""
    return radius * math.cbrt(1 - ratio)


def shift(ratio: float, sliding_force: float, radius: float, compliance: float) -> float:
    """Return δ = 3 μP C/(16 a) [1 − (1 − Q/μP)^⅔], the displacement under Q, in m.

    For the `ratio` Q/μP, the `sliding_force` μP (N), the `radius` a (m) and C (1/Pa).
    """
    return 3 * sliding_force * compliance / (16 * radius) * (1 - math.cbrt(1 - ratio) ** 2)


def force_ratio(shift: float, sliding_force: float, radius: float, compliance: float) -> float:
    """Return Q/μP at a displacement δ (m); the inverse of `shift`, and 1 beyond."""
    left = max(0.0, 1 - 16 * radius * shift / (3 * sliding_force * compliance))
    return 1 - left * math.sqrt(left)


def loop_energy(ratio: float, sliding_force: float, radius: float, compliance: float) -> float:
    """Return the energy that a cycle between ±Q dissipates, in J; parameters as of `shift`.

    ΔW = 9 (μP)² C/(10 a) {1 − (1 − Q/μP)^(5/3) − 5Q/(6μP) [1 + (1 − Q/μP)^⅔]}
    """
    left = math.cbrt(1 - ratio)
    shape = 1 - left**5 - 5 / 6 * ratio * (1 + left**2)
    return 0.9 * sliding_force**2 * compliance / radius * shape


def worn_load_share(stuck: float) -> float:
    """Return P∞/P of a ball that wore at its first approach until nothing slips, for c/a.

    P∞/P = 1.5 c/a − 0.5 (c/a)³: the stick zone indents on, the ring round it bears no load.
    Popov, V. L. (2014), Sci. Rep. 4, 3749.
    """
    return 1.5 * stuck - 0.5 * stuck**3
