"""A blunt cone on a flat."""

import numpy as np

import tribo
from tribo.verification.cases.pins import pin_on_flat


class Cone(tribo.Surface):
    """z = -0.02 r."""

    type = "verification.cone"

    def height(self, grid: tribo.Grid) -> tribo.Array:
        """Return the height."""
        return -0.02 * np.hypot(*grid.mesh)


CASE = pin_on_flat(
    Cone(),
    grid=tribo.Grid("0.6 mm", 279),
    load=142.9252042,
    contact=tribo.DcFft(tolerance=1e-10),
    kinematics=tribo.Unidirectional(speed=0.1, track_length=2e-3, distance=1e-6),
)
