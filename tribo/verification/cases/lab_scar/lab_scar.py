"""What a microscope reads off the scar of a ball worn to a groove."""

import numpy as np

import tribo
from tribo.lab.scar import crown, scar

RADIUS, GROOVE, ALONG, ACROSS = 5e-3, 8e-3, 0.2e-3, 0.3e-3
GRID = tribo.Grid((0.6e-3, 0.8e-3), (61, 101))


def found() -> dict[str, float]:
    """Return diameters and crowns, in m."""
    x, y = GRID.mesh
    worn = np.maximum(1 - (x / ALONG) ** 2 - (y / ACROSS) ** 2, 0.0)
    seen = scar(worn, GRID)
    across = y[0]
    off = np.maximum(ACROSS**2 - across**2, 0.0) * (1 / RADIUS - 1 / GROOVE) / 2
    return {
        "diameter along": seen.along,
        "diameter across": seen.across,
        "crown across": crown(-(across**2) / RADIUS / 2 - off, off),
    }
