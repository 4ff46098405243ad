"""Sound contact solvers, motions, surfaces and an observer, for mistakes to be made in."""

import math
from typing import Annotated, Any, ClassVar

import numpy as np

from tribo import (
    ContactSolver,
    HalfSpace,
    Kinematics,
    Observer,
    Position,
    Quantity,
    Stationary,
    Surface,
    Track,
    solve_bounded,
)

Length = Annotated[float, Quantity("m", above=0)]
Duration = Annotated[float, Quantity("s", above=0)]


class Solver(ContactSolver):
    """Two half-spaces."""

    type = "honest.solver"

    accepts_wear_compliance = True
    honours_cap = True

    def operator(self, grid, modulus):
        return HalfSpace(grid.cells, grid.spacing, modulus)

    def solve(self, problem, start=None):
        system = problem.system
        solution = solve_bounded(
            self.operator(system.grid, system.modulus),
            problem.gap,
            problem.load,
            system.cap,
            problem.wear,
            start=None if start is None else start.pressure,
            tolerance=1e-9,
        )
        return solution

    def smallest_compliance(self, system):
        # The continuum's at the grid's shortest wave, 2/(E* q), is less than the cells'.
        q = np.pi * np.hypot(*(1 / d for d in system.grid.spacing))
        return 0.8 * 2 / (system.modulus * q)


class Springs:
    """Springs, one to a cell, as `solve_bounded` takes them."""

    def __init__(self, grid, stiffness):
        self.shape, self.spacing, self.stiffness = grid.cells, grid.spacing, stiffness

    def apply(self, pressure):
        return pressure / self.stiffness

    def symbol(self):
        nx, ny = self.shape
        return np.full((nx, ny // 2 + 1), 1 / self.stiffness)


class Pad(Solver):
    """A soft pad, of stiffness modulus over thickness."""

    type = "honest.pad"
    modulus: Annotated[float, Quantity("Pa", above=0)] = 1e10
    """Modulus of the pad, under no strain along it."""
    thickness: Length = 1e-4
    """Its thickness."""

    def operator(self, grid, modulus):
        return Springs(grid, self.modulus / self.thickness)

    def smallest_compliance(self, system):
        return self.thickness / self.modulus


class Motion(Kinematics):
    """The second body goes back and forth."""

    type = "honest.motion"
    stroke: Length = 3e-3
    """Length of the stroke."""
    frequency: Annotated[float, Quantity("Hz", above=0)] = 10.0
    """Cycles per second."""
    duration: Duration = 100.0
    """How long it runs."""

    track: ClassVar[Any] = Track

    @property
    def end_time(self):
        return self.duration

    def distance_at(self, time):
        return 2 * self.stroke * self.frequency * time

    def time_at(self, distance):
        return distance / (2 * self.stroke * self.frequency)

    def exposures(self, grid, bodies):
        return {bodies[0]: Stationary(grid), bodies[1]: self.track(grid, self.stroke)}


class Ramp(Kinematics):
    """The second body is drawn along a track, ever faster until it has its speed."""

    type = "honest.ramp"
    speed: Annotated[float, Quantity("m/s", above=0)] = 0.1
    """Speed in the end."""
    start: Duration = 5.0
    """Time until it has that."""
    track_length: Length = 0.1
    """Length of the closed track."""
    duration: Duration = 100.0
    """How long it runs."""

    @property
    def end_time(self):
        return self.duration

    def distance_at(self, time):
        takes = self.start
        early = min(time, takes)
        return self.speed * (0.5 * early**2 / takes + time - early)

    def exposures(self, grid, bodies):
        return {bodies[0]: Stationary(grid), bodies[1]: Track(grid, self.track_length)}


class Shuttle(Kinematics):
    """Back and forth at a constant speed, with a rest at each end of the stroke."""

    type = "honest.shuttle"
    turns_back = True
    stroke: Length = 3e-3
    """Length of the stroke."""
    speed: Annotated[float, Quantity("m/s", above=0)] = 0.06
    """Speed along it."""
    rest: Duration = 0.02
    """Time at rest at each end."""
    duration: Duration = 100.0
    """How long it runs."""
    swept: str | None = None
    """The body that is moved, the last if left out."""

    @property
    def end_time(self):
        return self.duration

    @property
    def track_extent(self):
        return self.stroke

    @property
    def moves(self):
        return self.stroke / self.speed

    def distance_at(self, time):
        strokes, into = divmod(time, self.moves + self.rest)
        return self.stroke * (strokes + min(into / self.moves, 1.0))

    def time_at(self, distance):
        # The whole strokes before, of which the last is not yet over at a reversal.
        strokes = max(math.ceil(distance / self.stroke - 1e-9) - 1, 0)
        return strokes * self.rest + distance / self.speed

    def cycle(self, grid):
        return [Position(speeds=[(self.speed, 1.0)], rest=self.rest / self.stroke)]

    def exposures(self, grid, bodies):
        swept = self.swept or bodies[-1]
        track = Track(grid, self.stroke)
        return {name: track if name == swept else Stationary(grid) for name in bodies}


class Hill(Surface):
    """An elliptic paraboloid whose top lies beside the centre."""

    type = "honest.hill"
    radius: Length = 8e-3
    """Radius along x; twice that along y."""
    beside: Annotated[float, Quantity("m")] = 4e-5
    """Place of the top along x."""

    def height(self, grid):
        x, y = grid.mesh
        height = -((x - self.beside) ** 2) / 2 - (y + 0.8 * self.beside) ** 2 / 4
        return height / self.radius

    @property
    def curvature(self):
        return 1 / self.radius, 0.5 / self.radius


class Wavy(Surface):
    """A wave along x."""

    type = "honest.wavy"
    amplitude: Length = 1e-6
    """Amplitude of the wave."""
    wavelength: Length = 2.5e-4
    """Its length."""

    def height(self, grid):
        x, y = grid.mesh
        return self.amplitude * np.sin(2 * np.pi * x / self.wavelength + 0.3) + 0 * y


class Counts(Observer):
    """Counts the steps."""

    type = "honest.counts"

    _steps: int = 0

    def on_start(self, run):
        self._steps = 0

    def on_step(self, snapshot):
        self._steps += 1


OTHERS = (Solver, Pad, Motion, Ramp, Shuttle, Hill, Wavy, Counts)
