"""Roughness of waves along and across the sliding direction."""

import numpy as np
import tribo

from tribo_topography.roughness import roughness

ALONG, ACROSS = 0.1e-6, 0.3e-6
GRID = tribo.Grid((1e-3, 0.8e-3), (400, 320))


def found() -> dict[str, float]:
    """Return roughness parameters, in m and 1."""
    x, y = (2 * np.pi * t / 0.1e-3 for t in GRID.mesh)
    seen = roughness(ALONG * np.cos(x) + ACROSS * np.cos(y), order=0)
    return {
        "Ra along": seen.Ra_along_m,
        "Rq across": seen.Rq_across_m,
        "Sa": seen.Sa_m,
        "Sq": seen.Sq_m,
        "Sz": seen.Sz_m,
        "Ssk": seen.Ssk,
        "Sku": seen.Sku,
    }
