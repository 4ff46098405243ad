"""The paper's ball and track, worn in the rigid limit."""

import numpy as np
from ball_on_track import ball_on_track

R = 5e-3
EQUAL = {
    "load": 100.0,
    "radius": R,
    "track_length": 2e-3,
    "ball_wear_coefficient": 3.11e-16,
    "flat_wear_coefficient": 3.11e-16,
}


def half_lengths(y, distance, case):
    """Half-lengths b of the contact along the track: b² + ⅔ q b³ = c² - y²."""
    worn = ball_on_track(distance, **case)
    q = 2 * case["flat_wear_coefficient"] / case["ball_wear_coefficient"] / case["track_length"]
    b = worn.half_width_along * np.linspace(1, 0, 4001)
    outline = np.sqrt(np.maximum(worn.half_width_across**2 - b**2 - 2 / 3 * q * b**3, 0.0))
    return np.interp(np.abs(y), outline, b), q
