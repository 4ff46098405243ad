"""A blunt cone on a flat, z = -0.02 r."""

import numpy as np

import tribo
from tribo.verification.cases.pins import pin_on_flat

GRID = tribo.Grid("0.6 mm", 279)
CASE = pin_on_flat(
    tribo.HeightMap(size=GRID.size, heights=-0.02 * np.hypot(*GRID.mesh)),
    grid=GRID,
    load=142.9252042,
    contact=tribo.DcFft(tolerance=1e-10),
    kinematics=tribo.Unidirectional(speed=0.1, track_length=2e-3, distance=1e-6),
)
