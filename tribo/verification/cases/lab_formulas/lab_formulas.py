"""What a lab computes from the sizes of scars and tracks."""

import numpy as np

from tribo.lab import formulas

RADIUS, GROOVE, WIDTH, LENGTH = 5e-3, 8e-3, 1e-3, 10e-3


def found() -> dict[str, float]:
    """Return volumes and sections, in SI units."""
    y = (np.arange(500) - 249.5) * WIDTH / 500
    groove = (0.25 * WIDTH**2 - y**2) / (2 * GROOVE)
    # Of two profiles, the second with material piled up beside.
    profiles = np.pad([groove, groove], ((0, 0), (0, 9)), constant_values=[(0, 0), (0, -1e-3)])
    section = formulas.planimetric_area(profiles, WIDTH / 500)
    return {
        "ball: flat scar, G99": formulas.ball_cap_volume(WIDTH, RADIUS),
        "ball: scar in a groove, D7755": formulas.conforming_ball_volume(
            WIDTH, WIDTH, RADIUS, GROOVE
        ),
        "track: section of a parabola": section,
        "track: radius of a groove, D7755": formulas.groove_radius(WIDTH, WIDTH**3 / (12 * GROOVE)),
        "track: groove of an unworn ball, G99": formulas.circular_groove_area(WIDTH, RADIUS),
        "track: straight, G133": formulas.reciprocating_track_volume(WIDTH, RADIUS, LENGTH),
    }
