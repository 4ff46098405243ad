import numpy as np

from tribo.core.grid import Grid
from tribo.motion.exposure import Track

GRID = Grid((1e-3, 2e-3), (8, 12))
RATE = np.random.default_rng(1).random(GRID.cells)


def test_an_unloaded_row_has_the_compliance_of_its_law():
    pressure = RATE.copy()
    pressure[:, 3] = 0
    compliance = Track(GRID, 5e-3).compliance(np.full(GRID.cells, 2.0), pressure)
    np.testing.assert_allclose(compliance.swept, 2.0 / 5e-3)
