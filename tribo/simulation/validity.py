"""Where a case leaves what its models hold for."""

from __future__ import annotations

import numpy as np

from tribo.core.measures import Measures
from tribo.simulation.model import Model

STEEP = 0.3
"""Half-width of a contact over the radius of a body, from which on it is spoken of."""
WHOLE = 1 - 1e-9


def too_wide(model: Model, measures: Measures) -> list[str]:
    """Say of which bodies the contact is too wide for their radius to be a half-space."""
    widths = (measures.half_width_x, measures.half_width_y)
    told = []
    for name, surface in model.surfaces.items():
        curvatures = surface.curvature or (0.0, 0.0)
        ratio, curvature = max(
            (abs(c) * a, abs(c)) for c, a in zip(curvatures, widths, strict=True)
        )
        if ratio > STEEP:
            told.append(
                f"at {measures.time:.3g} s the contact's half-width a is {ratio:.2f} of the radius "
                f"R of {name}, {1e3 / curvature:.3g} mm: a half-space with small slopes asks "
                "for a/R well below 1 (0.1, say), and pressures and depths may be far off"
            )
    return told


def short_of_a_lap(model: Model) -> str | None:
    """Say so if the whole run slides over a part of a body's track only."""
    distance = model.end_distance
    for name in [name for name in model.laws if name in model.swept]:
        # What one metre of depth all along the track takes, over the breadth of the window.
        depth = np.ones((1, model.grid.cells[1]))
        length = model.exposures[name].volume(depth) / model.grid.size[1]
        if distance < WHOLE * length:
            return (
                f"the run slides {distance:.3g} m, {distance / length:.2g} of the track of {name}, "
                f"which is {length:.3g} m long: its wear is averaged over the whole track, also "
                "where the contact never comes to; slide once over it at least, and for the "
                "average to hold many times"
            )
    return None
