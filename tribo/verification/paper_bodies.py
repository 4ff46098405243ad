"""Bodies, contacts and runs that the references share: those of the paper's test."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from tribo.case import Body, Case
from tribo.closed_forms import hertz
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, Mask
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem
from tribo.core.grid import Grid
from tribo.core.material import Material, contact_modulus
from tribo.core.state import State
from tribo.model.model import Model
from tribo.motion.unidirectional import Unidirectional
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.stepping.explicit import Explicit
from tribo.stepping.first_contact import first_contact
from tribo.stepping.implicit import Implicit
from tribo.surfaces.flat import Flat
from tribo.surfaces.paraboloid import Paraboloid
from tribo.surfaces.surface import Surface
from tribo.wear.archard import Archard
from tribo.wear.law import WearLaw

YOUNG, POISSON = 207e9, 0.3
HARDNESS = 4e9
RADIUS = 5e-3
LOAD = 100.0
WEAR_COEFFICIENT = 3.11e-16
STEEL = Material(young=YOUNG, poisson=POISSON)
MODULUS = contact_modulus([STEEL, STEEL])
ONSET = LOAD * (HARDNESS / hertz.point(MODULUS, LOAD, 1 / RADIUS, 1 / RADIUS).peak_pressure) ** 3
"""Load at which the ball's peak pressure is the hardness, in N."""

SPEED = 0.1
ARCHARD = Archard(k=WEAR_COEFFICIENT)
BALL = Paraboloid(radius=RADIUS)
HALF_SPACE, PERIODIC = DcFft(tolerance=1e-10), Periodic(tolerance=1e-10)


class Shape(Surface):
    """A surface from a function."""

    type = "verification.shape"

    heights: Callable[[Grid], Array]
    """From the grid to heights in m, shape (nx, ny)."""

    def height(self, grid: Grid) -> Array:
        """Return the function's heights."""
        return self.heights(grid)


def square(width: float, cells: int, placement: float = 0.0, breadth: float | None = None) -> Grid:
    """Return a grid of as many cells along as across, square unless `breadth` is given.

    The edge of a contact on it moves by about a cell with the placement.
    """
    larger = 1 + 3 * placement / cells
    return Grid((larger * width, larger * (breadth or width)), (cells, cells))


def paraboloid(grid: Grid, radius_x: float = RADIUS) -> Array:
    """Return the gap of a paraboloid of radius 5 mm across, and `radius_x` along, in m."""
    x, y = grid.mesh
    return np.asarray(x**2 / (2 * radius_x) + y**2 / (2 * RADIUS))


def drawn_radius(inside: Mask, grid: Grid) -> float:
    """Return the radius of the disc of the same area as the cells `inside`, in m."""
    return math.sqrt(np.count_nonzero(inside) * grid.cell_area / math.pi)


def press(
    contact: ContactSolver, gap: Array, grid: Grid, load: float, cap: float | None = None
) -> ContactSolution:
    """Solve one contact between bodies of steel."""
    system = ContactSystem(grid, MODULUS, load, cap)
    return contact.solve(ContactProblem(system, gap, load))


def on_flat(
    surface: Surface,
    grid: Grid,
    contact: ContactSolver,
    *,
    load: float = LOAD,
    ball_law: WearLaw = ARCHARD,
    flat_k: float | None = None,
    track_length: float = 2e-3,
    distance: float = 1.0,
    material: Material = STEEL,
    flat_material: Material | None = None,
) -> Model:
    """Return the model of a body named "ball" that slides on a flat along a track.

    The flat is of the ball's material if no other is given.
    """
    flat_wear = None if flat_k is None else Archard(k=flat_k)
    return assemble(
        Case(
            grid=grid,
            load=load,
            bodies={
                "ball": Body(surface=surface, material=material, wear=ball_law),
                "flat": Body(surface=Flat(), material=flat_material or material, wear=flat_wear),
            },
            contact=contact,
            kinematics=Unidirectional(speed=SPEED, track_length=track_length, distance=distance),
            # `slide` makes its own steps, but a stepping that does not fit the contact is refused.
            stepping=Implicit() if contact.accepts_wear_compliance else Explicit(time_step=1.0),
        )
    )


def slide(
    model: Model, distance: float, steps: int, *, explicit: bool = False
) -> tuple[State, State]:
    """Slide in equal steps; return the last two states."""
    before = state = first_contact(model)
    scheme = Explicit(time_step=distance / steps / SPEED) if explicit else Implicit()
    for i in range(steps):
        before = state
        state = scheme.step(model, state, distance / steps, distance * (i + 1) / steps / SPEED)
    return before, state


def run_to_end(model: Model) -> State:
    """Return the state at the end of the model's case."""
    state = begin(model)
    for accepted in march(model, state):
        state = accepted.state
    return state
