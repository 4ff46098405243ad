"""A stroke of three half-widths of the first contact, and a plain loop over its cells."""

import numpy as np
from contact_problems import pressed
from paper_models import FOUNDATION, K, foundation, motion, small

from tribo import Grid

GRID = Grid((1.2e-3, 0.75e-3), (32, 20))
STROKE = 12 * GRID.spacing[0]


def resolved(positions="cells", duration=600, grid=GRID, **changes):
    """Return the model of a ball that slides along the stroke."""
    kinematics = motion(stroke=STROKE, duration=duration, positions=positions)
    return small(**{"grid": grid, "contact": foundation(), "kinematics": kinematics, **changes})


def plain_loop(distance, shares=1.0, steps=500):
    """Wear ball and disk by forward Euler under a share of the load at each cell of the stroke."""
    (nx, ny), (dx, dy) = GRID.cells, GRID.spacing
    x, y = GRID.mesh
    ball, disk = np.zeros((nx, ny)), np.zeros((nx + 12, ny))
    gap = 5e-3 - np.sqrt(25e-6 - x**2 - y**2)
    path = np.full(13, 1 / 12)
    path[[0, -1]] /= 2
    for length in distance * np.diff(np.linspace(0, 1, steps + 1) ** 1.5):
        gaps = np.stack([gap + ball + disk[at : at + nx] for at in range(13)])
        p = FOUNDATION * pressed(gaps, 100 * shares / (dx * dy * FOUNDATION))
        ball += K * length * np.einsum("i,ijk->jk", path, p)
        for at in range(13):
            disk[at : at + nx] += K * length * path[at] * p[at]
    return ball, disk
