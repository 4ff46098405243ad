"""A contact without symmetry, for the checks of contact solvers."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem, WearCompliance
from tribo.core.grid import Grid
from tribo.core.material import contact_modulus
from tribo.testing import samples
from tribo.testing.checks_calls import locked
from tribo.testing.subject import Subject

MODULUS = contact_modulus([samples.STEEL, samples.STEEL])
# A tenth of what the step control allows as error of the wear depth, 1e-3.
TOLERANCE = 1e-4


def sample_gap(grid: Grid, scale: float = 1.0, cells: tuple[int, int] = (0, 0)) -> Array:
    """Return a ball with a slanted ripple, which has no symmetry, moved by some cells."""
    x, y = grid.mesh
    x, y = x - cells[0] * grid.spacing[0], y - cells[1] * grid.spacing[1]
    bowl = (x**2 + y**2) / (2 * scale * samples.RADIUS)
    ripple = 1e-7 * scale * np.sin((3.1 * x + 4.7 * y) / (0.72e-3 * scale) + 0.4)
    return np.asarray(bowl + ripple)


def sample_problem(
    *,
    gap: Array | None = None,
    load: float = samples.LOAD,
    cap: float | None = None,
    wear: WearCompliance | None = None,
    scale: float = 1.0,
    stiffer: float = 1.0,
) -> ContactProblem:
    """Return a problem with lengths times `scale` and moduli times `stiffer`, read-only."""
    size = (scale * samples.GRID.size[0], scale * samples.GRID.size[1])
    grid = Grid(size, samples.GRID.cells)
    curved = 1 / (scale * samples.RADIUS)
    force = scale**2 * stiffer
    material = samples.STEEL.model_copy(
        update={"young": stiffer * samples.STEEL.young, "hardness": cap}
    )
    # The system states the first contact's load, whatever the problem's own is.
    system = ContactSystem(
        grid=grid,
        modulus=stiffer * MODULUS,
        load=force * samples.LOAD,
        cap=cap,
        curvature=(curved, curved),
        materials=dict.fromkeys(samples.BODIES, material),
    )
    gap = sample_gap(grid, scale) if gap is None else gap
    problem = ContactProblem(system, gap, force * load, wear)
    return locked(problem)  # type: ignore[no-any-return]


def solved(
    subject: Subject, problem: ContactProblem, start: ContactSolution | None = None
) -> ContactSolution:
    """Return the solution of a problem by a new solver, which is asked first if it can."""
    solver = subject.make()
    solver.check(problem.system)
    solution: ContactSolution = solver.solve(problem, start)
    return solution
