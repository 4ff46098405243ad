"""The error of the average over a stroke, relative to a contact moved along the stroke."""

from __future__ import annotations

import math


def groove_excess(
    stroke: float,
    half_width: float,
    depth: float,
    approach: float,
    volume_ratio: float = 1.0,
    line: bool = False,
) -> float:
    """Return the relative error of a groove's depth at mid-stroke by the stroke average.

    Where the stroke is shorter than the contact, the average spreads all of the wear over the
    stroke, but only a part of the contact, by Hertz's pressure, passes over mid-stroke. Once the
    groove is deeper than the elastic approach, the ball wears to fit the shallower ends as well:
    a fit to runs of a moving contact with strokes of 4 to 20 half-widths and grooves of 0.4 to 10
    times the approach. A groove that is straight across costs exponentially less with the stroke.

    Within a percentage point of the runs where both bodies wear alike, within two where the ball
    wears ten times faster, and 0.5 to 1.5 times the runs where the flat does; an estimate below 4
    half-widths, too large for flat pins, and 0.8 to 3 times the error for cylinders.

    Parameters
    ----------
    stroke : float
        Stroke S, in m.
    half_width : float
        Half-width of the contact along the stroke, by the average, in m.
    depth : float
        Depth of the groove, by the average, in m; may be infinite.
    approach : float
        Elastic approach of the first contact, in m.
    volume_ratio : float, optional
        Volume lost by the stationary body over the volume lost by the track.
    line : bool, optional
        Whether the contact spans the window, as for a cylinder on a flat.

    Returns
    -------
    float
        Depth by the average over the depth by the moving contact, less 1.

    References
    ----------
    The runs: ``benchmarks/studies/moving_contact.py``;
    cylinders: ``tests/motion/test_averaging.py``.
    """
    excess = 0.0
    if depth > 0:
        elastic = max(approach, 0.0) / depth
        alike = min(max(volume_ratio, 0.1), 10.0) ** 0.4
        deep = 1 / (1 + 1.25 * (elastic / alike) ** 1.5)
        excess = 1.5 * math.pow(half_width / stroke, 1.25) * deep
        if line:
            excess = min(excess, math.exp(-stroke / (2 * half_width) * math.sqrt(elastic)))
    reach = min(1.0, stroke / (2 * half_width))
    passing = (math.asin(reach) + reach * math.sqrt(1 - reach**2)) / (math.pi / 2)
    return (1 + excess) / passing - 1
