"""Pressures and a short wear history against tamaas and ContactMechanics."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial

import numpy as np

from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem, Residuals
from tribo.core.grid import Grid
from tribo.registry.registry import default_registry
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.plasticity import ONSET
from tribo.verification.problems import (
    HARDNESS,
    LOAD,
    MODULUS,
    RADIUS,
    WEAR_COEFFICIENT,
    ball,
    half_space,
    norm,
    on_flat,
    periodic,
    press,
    slide,
)

CELLS = 48
Solve = Callable[[Array, Grid, float], Array]


class Other(ContactSolver):
    """A contact solver from a function that knows only pressures."""

    type = "verification.other"

    pressure: Solve
    """From gap (m), grid and load (N) to pressure (Pa), shape (nx, ny)."""
    plasticity: bool = False

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
    system = ContactSystem(grid, MODULUS, load, cap)
    return solver.solve(ContactProblem(system, gap, load)).pressure


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
    solver.solve(load / (grid.size[0] * grid.size[1]) / MODULUS)
    return np.array(model.traction).reshape(grid.cells) * MODULUS


def contact_mechanics(gap: Array, grid: Grid, load: float, *, repeats: bool = False) -> Array:
    """Return ContactMechanics' pressure, in free space or periodic."""
    with warnings.catch_warnings():
        # It says so where MPI is not installed.
        warnings.simplefilter("ignore")
        from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
        from ContactMechanics.Factory import make_system
        from SurfaceTopography import Topography

    substrate = PeriodicFFTElasticHalfSpace if repeats else FreeFFTElasticHalfSpace
    system = make_system(
        substrate=substrate(grid.cells, MODULUS, grid.size), surface=Topography(-gap, grid.size)
    )
    found = system.minimize_proxy(
        external_force=load, pentol=1e-11 * float(np.ptp(gap)), maxiter=1000
    )
    assert found.success, found.message
    nx, ny = grid.cells
    return np.asarray(found.jac)[:nx, :ny] / grid.cell_area


def _ball_problem() -> tuple[Array, Grid]:
    grid = Grid((0.7e-3, 0.7e-3), (CELLS, CELLS))
    x, y = grid.mesh
    return (x**2 + y**2) / (2 * RADIUS), grid


def _free(solve: Solve, level: int, placement: float) -> Found:
    gap, grid = _ball_problem()
    return {"pressure": norm(press(half_space(), gap, grid, LOAD).pressure, solve(gap, grid, LOAD))}


def _capped(level: int, placement: float) -> Found:
    grid = Grid((1.4e-3, 1.4e-3), (CELLS, CELLS))
    x, y = grid.mesh
    gap, load = (x**2 + y**2) / (2 * RADIUS), 1.5 * ONSET
    theirs = tamaas_free(gap, grid, load, HARDNESS)
    return {"pressure": norm(press(half_space(), gap, grid, load, HARDNESS).pressure, theirs)}


def _rough(solve: Solve, level: int, placement: float) -> Found:
    grid = Grid((0.7e-3, 0.7e-3), (CELLS, CELLS))
    x, y = (2 * np.pi * v / 0.7e-3 for v in grid.mesh)
    gap = 1e-6 * (np.cos(3 * x + 1) * np.cos(2 * y) + 0.4 * np.cos(7 * x - 5 * y))
    return {"pressure": norm(press(periodic(), gap, grid, LOAD).pressure, solve(gap, grid, LOAD))}


def _history(solve: Solve, level: int, placement: float) -> Found:
    distance, steps = 4.0, 20
    depths = []
    for contact in (half_space(), Other(pressure=solve)):
        model = on_flat(
            ball(),
            Grid((0.7e-3, 0.7e-3), (CELLS, CELLS)),
            contact,
            flat_k=WEAR_COEFFICIENT,
            distance=distance,
        )
        _, state = slide(model, distance, steps, explicit=True)
        depths.append((state.bodies["ball"].wear, state.bodies["flat"].wear))
    (ball_ours, flat_ours), (ball_theirs, flat_theirs) = depths
    return {
        "depth of the ball": norm(ball_ours, ball_theirs),
        "depth of the flat": norm(flat_ours, flat_theirs),
    }


def _check(
    case: str, code: str, measure: Callable[[int, float], Found], names: tuple[str, ...]
) -> Check:
    needs = {
        "tamaas": ("tamaas", "tribo_tamaas"),
        "ContactMechanics": ("ContactMechanics", "SurfaceTopography"),
    }[code]
    note = "difference of the two codes, both at their tolerance"
    return Check(
        f"{case}, {code}",
        code,
        measure,
        tuple(Quantity(name, "1", 1e-5, note=note) for name in names),
        levels=(CELLS,),
        needs=needs,
    )


DEPTHS = ("depth of the ball", "depth of the flat")
CODES: tuple[tuple[str, Solve, Solve], ...] = (
    ("tamaas", tamaas_free, tamaas_periodic),
    ("ContactMechanics", contact_mechanics, partial(contact_mechanics, repeats=True)),
)
CHECKS = (
    *(
        check
        for code, free, repeating in CODES
        for check in (
            _check("ball in free space", code, partial(_free, free), ("pressure",)),
            _check("waves, periodic", code, partial(_rough, repeating), ("pressure",)),
            _check("ball and flat wear, 20 explicit steps", code, partial(_history, free), DEPTHS),
        )
    ),
    _check("ball beyond yield", "tamaas", _capped, ("pressure",)),
)
