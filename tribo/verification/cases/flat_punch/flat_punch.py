"""A flat-ended punch, whose edge is a staircase of cells."""

import numpy as np

from tribo import ContactProblem, ContactSystem, DcFft, Grid

MODULUS, LOAD = 113.736e9, 100.0


def found(part: float, cells: int) -> dict[str, float]:
    """Return the approach and the pressure, relative to a disc of the staircase's area."""
    grid = Grid(0.8e-3 * (1 + 3 * part / cells), cells)
    inside = np.hypot(*grid.mesh) < 0.3e-3
    radius = np.sqrt(np.count_nonzero(inside) * grid.cell_area / np.pi)
    problem = ContactProblem(ContactSystem(grid, MODULUS, LOAD), np.where(inside, 0, 1e-3), LOAD)
    solution = DcFft(tolerance=1e-10).solve(problem)
    middle = solution.pressure[cells // 2, cells // 2]
    return {
        "approach over F/2E*a": solution.approach * 2 * MODULUS * radius / LOAD,
        "pressure at the centre over F/2 pi a^2": middle * 2 * np.pi * radius**2 / LOAD,
    }
