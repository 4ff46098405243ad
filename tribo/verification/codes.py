"""Pressures and a short wear history against tamaas and ContactMechanics."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, Residuals
from tribo.core.grid import Grid
from tribo.registry.registry import default_registry
from tribo.verification import paper_bodies as paper
from tribo.verification.reference import Reference, Row, norm

CELLS, WIDTH = 48, 0.7e-3
TAMAAS = ("tamaas", "tribo_tamaas")
CONTACT_MECHANICS = ("ContactMechanics", "SurfaceTopography")
NOTE = "difference of the two codes, both at their tolerance"
Solve = Callable[[Array, Grid, float], Array]


class OtherCode(ContactSolver):
    """A contact solver from a function that knows only pressures."""

    type = "verification.other"

    pressure: Solve
    """From gap (m), grid and load (N) to pressure (Pa), shape (nx, ny)."""

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact; the approach and the residuals are not known."""
        pressure = self.pressure(problem.gap, problem.system.grid, problem.load)
        return ContactSolution(pressure, 0.0, np.zeros_like(pressure), 0, Residuals(0.0, 0.0, 0.0))


def tamaas_free(gap: Array, grid: Grid, load: float, cap: float | None = None) -> Array:
    """Return tamaas's pressure in free space, through the plugin tribo-tamaas."""
    cls = default_registry().lookup("contact_solver", "tamaas.half_space")
    solver = cls.model_validate({"tolerance": 1e-9})
    assert isinstance(solver, ContactSolver)
    return paper.press(solver, gap, grid, load, cap).pressure


def tamaas_periodic(gap: Array, grid: Grid, load: float) -> Array:
    """Return tamaas's periodic pressure; its window's longer side is its unit of length."""
    import tamaas

    tamaas.set_log_level(tamaas.LogLevel.error)
    scale = 1 / max(grid.size)
    size = [scale * edge for edge in grid.size]
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, size, list(grid.cells))
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(-scale * gap), 1e-10)
    solver.max_iter = 2000
    solver.solve(load / (grid.size[0] * grid.size[1]) / paper.MODULUS)
    return np.array(model.traction).reshape(grid.cells) * paper.MODULUS


def contact_mechanics(gap: Array, grid: Grid, load: float, *, repeats: bool = False) -> Array:
    """Return ContactMechanics' pressure, in free space or periodic."""
    with warnings.catch_warnings():
        # It says so where MPI is not installed.
        warnings.simplefilter("ignore")
        from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
        from ContactMechanics.Factory import make_system
        from SurfaceTopography import Topography

    kind = PeriodicFFTElasticHalfSpace if repeats else FreeFFTElasticHalfSpace
    substrate = kind(grid.cells, paper.MODULUS, grid.size)
    system = make_system(substrate=substrate, surface=Topography(-gap, grid.size))
    pentol = 1e-11 * float(np.ptp(gap))
    found = system.minimize_proxy(external_force=load, pentol=pentol, maxiter=1000)
    assert found.success, found.message
    nx, ny = grid.cells
    return np.asarray(found.jac)[:nx, :ny] / grid.cell_area


def _row(name: str, ours: Array, theirs: Array) -> Row:
    return norm(name, ours, theirs, 1e-5, note=NOTE)


def _free(solve: Solve, level: int, placement: float) -> list[Row]:
    grid = paper.square(WIDTH, CELLS)
    gap = paper.paraboloid(grid)
    ours = paper.press(paper.HALF_SPACE, gap, grid, paper.LOAD).pressure
    return [_row("pressure", ours, solve(gap, grid, paper.LOAD))]


def _capped(level: int, placement: float) -> list[Row]:
    grid, load = paper.square(2 * WIDTH, CELLS), 1.5 * paper.ONSET
    gap = paper.paraboloid(grid)
    ours = paper.press(paper.HALF_SPACE, gap, grid, load, paper.HARDNESS).pressure
    return [_row("pressure", ours, tamaas_free(gap, grid, load, paper.HARDNESS))]


def _rough(solve: Solve, level: int, placement: float) -> list[Row]:
    grid = paper.square(WIDTH, CELLS)
    x, y = (2 * np.pi * v / WIDTH for v in grid.mesh)
    gap = 1e-6 * (np.cos(3 * x + 1) * np.cos(2 * y) + 0.4 * np.cos(7 * x - 5 * y))
    ours = paper.press(paper.PERIODIC, gap, grid, paper.LOAD).pressure
    return [_row("pressure", ours, solve(gap, grid, paper.LOAD))]


def _history(solve: Solve, level: int, placement: float) -> list[Row]:
    distance, k, grid = 4.0, paper.WEAR_COEFFICIENT, paper.square(WIDTH, CELLS)
    worn = []
    for contact in (paper.HALF_SPACE, OtherCode(pressure=solve)):
        model = paper.on_flat(paper.BALL, grid, contact, flat_k=k, distance=distance)
        worn.append(paper.slide(model, distance, 20, explicit=True)[1].bodies)
    ours, theirs = worn
    return [_row(f"depth of the {name}", ours[name].wear, theirs[name].wear) for name in ours]


def _against(
    code: str, needs: tuple[str, ...], free: Solve, repeating: Solve
) -> Iterator[Reference]:
    for case, rows in (
        ("ball in free space", partial(_free, free)),
        ("waves, periodic", partial(_rough, repeating)),
        ("ball and flat wear, 20 explicit steps", partial(_history, free)),
    ):
        yield Reference(f"{case}, {code}", code, rows, (CELLS,), needs=needs)


_REPEATING = partial(contact_mechanics, repeats=True)
REFERENCES = (
    *_against("tamaas", TAMAAS, tamaas_free, tamaas_periodic),
    Reference("ball beyond yield, tamaas", "tamaas", _capped, (CELLS,), needs=TAMAAS),
    *_against("ContactMechanics", CONTACT_MECHANICS, contact_mechanics, _REPEATING),
)
