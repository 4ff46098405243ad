"""What the average over a stroke costs, as a contact moved along the stroke shows it."""

from __future__ import annotations

import math

from scipy.optimize import brentq

NOTICED = 0.05
"""Excess from which on a run says so."""

GOOD = 0.03
"""Excess that the remedy leads to."""

FAR = 100.0
"""Half-widths of a stroke that is never too short."""


def groove_excess(stroke: float, half_width: float, depth: float, approach: float) -> float:
    """Return by how much of its depth the stroke average makes a groove too deep at mid-stroke.

    Two things add to it. Where the stroke is shorter than the contact, not all of the contact
    passes over mid-stroke, but the average spreads all of its wear over the stroke: the share that
    passes is that of Hertz's pressure. And once the groove is deeper than the elastic approach, the
    ball meets a shallower groove near the ends of the stroke and wears to fit all positions: fitted
    to runs of a moving contact with strokes of 4 to 20 half-widths and grooves of 0.4 to 10 times
    the approach. Where both bodies wear alike it is within a point of them. A flat that wears ten
    times faster has less, down to a third.

    Parameters
    ----------
    stroke : float
        Stroke S, in m.
    half_width : float
        Half-width of the contact along the stroke, as the average gives it, in m.
    depth : float
        Depth of the groove, as the average gives it, in m; may be infinite.
    approach : float
        Elastic approach of the first contact, in m.

    Returns
    -------
    float
        Depth by the average over that of the moving contact, less 1.

    References
    ----------
    The runs: ``benchmarks/moving_contact.py``.
    """
    deep = 0.0
    if depth > 0:
        deep = 1 / (1 + 1.25 * (max(approach, 0.0) / depth) ** 1.5)
    reach = min(1.0, stroke / (2 * half_width))
    passing = (math.asin(reach) + reach * math.sqrt(1 - reach**2)) / (math.pi / 2)
    excess = 1.5 * math.pow(half_width / stroke, 1.25) * deep
    return (1 + excess) / passing - 1


def excess_words(stroke: float, half_width: float, depth: float, approach: float) -> str | None:
    """Return a sentence on `groove_excess`, or None while it is below 5 %."""
    excess = groove_excess(stroke, half_width, depth, approach)
    if excess < NOTICED:
        return None

    def longer(widths: float) -> float:
        # A longer stroke spreads the same wear: its groove is shallower.
        other = widths * half_width
        return groove_excess(other, half_width, depth * stroke / other, approach) - GOOD

    widths = stroke / half_width
    enough = float(brentq(longer, widths, FAR, rtol=1e-3))
    # Beyond twice it is outside of what the formula was fitted to.
    much = f"about {100 * excess:.2g} %" if excess < 1 else "several times"
    return (
        f"the stroke of {1e3 * stroke:.3g} mm is {widths:.2g} half-widths of the contact, which is "
        f"{2e3 * half_width:.3g} mm long: the average over the stroke makes the groove "
        f"{much} too deep at mid-stroke; about 3 % with a stroke of {enough:.2g} half-widths, "
        f"{1e3 * enough * half_width:.2g} mm"
    )
