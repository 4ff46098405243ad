"""The bodies and contacts that the checks share: those of the paper's test."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tribo.case import Body, Case
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem
from tribo.core.grid import Grid
from tribo.core.material import Material, contact_modulus
from tribo.core.state import State
from tribo.motion.unidirectional import Unidirectional
from tribo.simulation.assembly import assemble
from tribo.simulation.model import Model
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.stepping.step import first_contact
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

SPEED = 0.1


class Shape(Surface):
    """A surface from a function."""

    type = "verification.shape"

    heights: Callable[[Grid], Array]
    """From the grid to heights in m, shape (nx, ny)."""

    def height(self, grid: Grid) -> Array:
        """Return the function's heights."""
        return self.heights(grid)


def half_space(tolerance: float = 1e-10) -> DcFft:
    """Return the half-space in free space."""
    return DcFft(tolerance=tolerance)


def periodic(tolerance: float = 1e-10) -> Periodic:
    """Return the half-space that repeats."""
    return Periodic(tolerance=tolerance)


def press(
    contact: ContactSolver, gap: Array, grid: Grid, load: float, cap: float | None = None
) -> ContactSolution:
    """Solve one contact of the checks' materials."""
    system = ContactSystem(grid, MODULUS, load, cap)
    return contact.solve(ContactProblem(system, gap, load))


def ball() -> Paraboloid:
    """Return the ball of 5 mm radius, as a paraboloid."""
    return Paraboloid(radius=RADIUS)


def on_flat(
    surface: Surface,
    grid: Grid,
    contact: ContactSolver,
    *,
    load: float = LOAD,
    ball_k: float = WEAR_COEFFICIENT,
    flat_k: float | None = None,
    ball_law: WearLaw | None = None,
    track_length: float = 2e-3,
    distance: float = 1.0,
    material: Material = STEEL,
    flat_material: Material | None = None,
) -> Model:
    """Return the model of a body named "ball" that slides on a flat along a track.

    The ball wears by Archard's law with `ball_k` if no other is given; the flat is of the ball's
    material likewise.
    """
    ball_wear = ball_law or Archard(k=ball_k)
    flat_wear = None if flat_k is None else Archard(k=flat_k)
    return assemble(
        Case(
            grid=grid,
            load=load,
            bodies={
                "ball": Body(surface=surface, material=material, wear=ball_wear),
                "flat": Body(surface=Flat(), material=flat_material or material, wear=flat_wear),
            },
            contact=contact,
            kinematics=Unidirectional(speed=SPEED, track_length=track_length, distance=distance),
            # Unused by `slide`, but what does not go with the contact is refused.
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


def norm(got: Array, expected: Array) -> tuple[float, float]:
    """Return (0, Σ|got − expected| / Σ|expected|)."""
    return 0.0, float(np.sum(np.abs(got - expected)) / np.sum(np.abs(expected)))
