"""Contact solvers, motions, surfaces and observers with mistakes in their physics.

They were written without sight of the checks.
"""

import math
from dataclasses import replace

import numpy as np
from testing.conformance.honest import Counts, Hill, Motion, Solver
from testing.conformance.mistaken import mistake
from testing.conformance.models import Ramp, Springs, Wavy
from testing.conformance.models_of_contact import Shuttle

from tribo import Residuals, Stationary, Track


def answering(words, change, **parts):
    """Keep a solver of which some parts of the answer are changed."""

    def solve(self, problem, start=None):
        solution = Solver.solve(self, problem, start)
        return replace(solution, **change(solution, problem, start))

    mistake(words, Solver, solve=solve, **parts)


def asking(words, change):
    """Keep a solver that solves another problem."""
    mistake(words, Solver, solve=lambda self, p, start=None: Solver.solve(self, change(p), start))


# Contact solvers.

answering(
    "The approach is measured from the gap's mean",
    lambda s, p, start: {"approach": s.approach + p.gap.mean() - p.gap.min()},
)
answering("The approach is that of one body", lambda s, p, start: {"approach": 0.5 * s.approach})
answering(
    "The approach has the range of the gap in it",
    lambda s, p, start: {"approach": s.approach + 0.01 * np.ptp(p.gap)},
)
answering(
    "The approach is the elastic one of a sphere in the code, 1 µm more",
    lambda s, p, start: {"approach": s.approach + 1e-6},
)
answering(
    "The approach is measured from the lowest gap, where the gap is not at 0",
    lambda s, p, start: {"approach": s.approach - p.gap.min()},
)
answering("The overlap is that of one body", lambda s, p, start: {"overlap": 0.5 * s.overlap})
answering(
    "The overlap is measured everywhere under pressure",
    lambda s, p, start: {"overlap": s.overlap + 0.05 * np.abs(s.approach) * (s.pressure > 0)},
)
answering(
    "The overlap is one number, the largest",
    lambda s, p, start: {"overlap": s.overlap.max() * (s.overlap > 0)},
)


def loosely(self, problem, start=None):
    tight = Solver.solve(self, problem, start)
    rough = tight.pressure * (1 + 0.02 * np.sin(np.arange(tight.pressure.size))).reshape(
        tight.pressure.shape
    )
    rough *= problem.load / (rough.sum() * problem.system.grid.cell_area)
    return replace(tight, pressure=rough, residuals=Residuals(0.0, 0.0, 0.0))


mistake("It stops at 2 % and says that nothing is left", Solver, solve=loosely)
asking("The load is always that of the first contact", lambda p: replace(p, load=p.system.load))
asking(
    "The modulus is that of one body",
    lambda p: replace(p, system=replace(p.system, modulus=2 * p.system.modulus)),
)
asking(
    "The wear of the step is halved",
    lambda p: (
        p
        if p.wear is None
        else replace(p, wear=replace(p.wear, local=0.5 * p.wear.local, swept=0.5 * p.wear.swept))
    ),
)
asking("The gap is turned along y", lambda p: replace(p, gap=np.ascontiguousarray(p.gap[:, ::-1])))
asking(
    "Both halves of the gap are taken as their mean, along y",
    lambda p: replace(p, gap=0.5 * (p.gap + p.gap[:, ::-1])),
)


def only_where_it_was(self, problem, start=None):
    free = Solver.solve(self, problem, start)
    if start is None:
        return free
    kept = free.pressure * (start.pressure > 0)
    kept *= problem.load / (kept.sum() * problem.system.grid.cell_area)
    return replace(free, pressure=kept)


mistake("The contact never grows beyond that of the start", Solver, solve=only_where_it_was)


def in_its_own_array(self, problem, start=None):
    solution = Solver.solve(self, problem, start)
    out = self._arrays.setdefault(solution.pressure.shape, np.empty_like(solution.pressure))
    out.flags.writeable = True
    out[:] = solution.pressure
    return replace(solution, pressure=out)


mistake(
    "The pressure lies in an array that the next solve overwrites",
    Solver,
    _arrays={},
    solve=in_its_own_array,
)
mistake(
    "A half-space is taken for springs, by the cell",
    Solver,
    operator=lambda self, grid, modulus: Springs(grid, modulus / grid.spacing[0]),
)

# Motions.


def motion(words, **parts):
    mistake(words, Motion, **parts)


def shuttle(words, **parts):
    mistake(words, Shuttle, **parts)


shuttle(
    "At a reversal the time is that at which it goes on",
    time_at=lambda s, d: d // s.stroke * (s.moves + s.rest) + d % s.stroke / s.speed,
)
shuttle("The time forgets the rests", time_at=lambda s, d: d / s.speed)
shuttle(
    "The time is that of the mean speed",
    time_at=lambda s, d: d / s.stroke * (s.moves + s.rest),
)
shuttle(
    "It slides on while it rests",
    distance_at=lambda s, t: s.stroke * t / (s.moves + s.rest),
)
shuttle(
    "The stroke back is counted off",
    distance_at=lambda s, t: s.stroke * (1 - math.cos(math.pi * t / (s.moves + s.rest))) / 2,
)
shuttle("Only whole strokes count", distance_at=lambda s, t: s.stroke * (t // (s.moves + s.rest)))
shuttle("The speed is that of a circular path", speeds=lambda s: [(math.pi * s.speed, 1.0)])
shuttle(
    "Shares are those of time, with the rest",
    speeds=lambda s: [(s.speed, s.moves / (s.moves + s.rest)), (0.0, s.rest / (s.moves + s.rest))],
)
shuttle("The shares are in percent", speeds=lambda s: [(s.speed, 100.0)])
shuttle(
    "The track is once to and fro, its extent once",
    exposures=lambda s, grid, bodies: {
        n: Track(grid, 2 * s.stroke) if n == (s.swept or bodies[-1]) else Stationary(grid)
        for n in bodies
    },
)
shuttle(
    "The body that is not named moves",
    exposures=lambda s, grid, bodies: {
        n: Stationary(grid) if n == (s.swept or bodies[-1]) else Track(grid, s.stroke)
        for n in bodies
    },
)
shuttle(
    "The key of the moving body is not used",
    exposures=lambda s, grid, bodies: {
        n: Track(grid, s.stroke) if n == bodies[-1] else Stationary(grid) for n in bodies
    },
)
motion(
    "Both bodies are named by what is common, ball and disk",
    exposures=lambda s, grid, bodies: {"ball": Stationary(grid), "disk": Track(grid, s.stroke)},
)
motion("The time is in minutes at its end", end_time=property(lambda s: s.duration / 60))
motion("Edges are in cycles", edges=property(lambda s: (1e3 * s.duration,)))
motion(
    "The distance falls back each second",
    distance_at=lambda s, t: 2 * s.stroke * s.frequency * (t - 0.3 * (t % 1.0)),
)


class UpsideDown(Track):
    def average(self, rate):
        return super().average(rate)[:, ::-1]


class MeanEnvelope(Track):
    def envelope(self, field):
        return np.mean(field, axis=0, keepdims=True)


class OneRow(Track):
    def volume(self, depth):
        return float(np.sum(depth)) * self._dx * self._dy


motion("The track is laid mirrored along y", track=UpsideDown)
motion("The envelope is the mean along the track", track=MeanEnvelope)
motion("The volume is that of one row of cells", track=OneRow)


def ramp_from_the_end(self, time):
    late = max(time - self.takes(), 0.0)
    return self.speed * (0.5 * min(time, self.takes()) + late)


mistake(
    "The ramp is half the speed at once, and is not told as an edge",
    Ramp,
    distance_at=ramp_from_the_end,
)

# Surfaces.


def hill(words, **parts):
    mistake(words, Hill, **parts)


hill(
    "Places are counted from the corner of the window",
    height=lambda s, grid: (
        -0.5 / s.radius * (grid.mesh[0] + 0.5 * grid.size[0] - s.beside) ** 2
        - 0.25 / s.radius * (grid.mesh[1] + 0.5 * grid.size[1]) ** 2
    ),
)
hill(
    "Beyond a ball's edge its height is no number",
    height=lambda s, grid: np.sqrt(
        (0.03 * s.radius) ** 2 - grid.mesh[0] ** 2 - 0.5 * grid.mesh[1] ** 2
    ),
)
hill(
    "The curvature is that of a hollow",
    curvature=property(lambda s: (-1 / s.radius, -0.5 / s.radius)),
)
hill("The curvature is in 1/mm", curvature=property(lambda s: (1e-3 / s.radius, 5e-4 / s.radius)))
hill("Heights are in µm", height=lambda s, grid: 1e6 * Hill.height(s, grid))
hill(
    "Heights are in single precision",
    height=lambda s, grid: Hill.height(s, grid).astype(np.float32),
)


def in_one_array(self, grid):
    out = self._maps.setdefault(grid.cells, np.empty(grid.cells))
    out[:] = Hill.height(self, grid)
    return out


hill("Heights lie in an array that the next call overwrites", _maps={}, height=in_one_array)
mistake(
    "Relief is scaled to the amplitude in each window",
    Wavy,
    height=lambda s, grid: (lambda z: z * s.amplitude / np.abs(z).max())(
        Wavy.height(s, grid) + 1e-3 * grid.mesh[1]
    ),
)
mistake(
    "The phase is counted from the window's edge",
    Wavy,
    height=lambda s, grid: (
        s.amplitude * np.sin(2 * np.pi * (grid.mesh[0] - grid.mesh[0].min()) / s.wavelength)
        + 0 * grid.mesh[1]
    ),
)
mistake(
    "The curvature of a wave forgets 2 π",
    Wavy,
    curvature=property(lambda s: (s.amplitude / s.wavelength**2, 0.0)),
)
mistake("A smoothed surface loses its configuration", Wavy, smoothed=lambda s: type(s)())

# Observers.


def counts(words, **parts):
    mistake(words, Counts, **parts)


def per_speed(self, snapshot):
    self._steps += int(1.0 / snapshot.state.speed > 0)


def of_two_bodies(self, snapshot):
    first, second = (body.wear for body in snapshot.state.bodies.values())
    self._steps += int(np.sum(first - second) > 0)


def of_rates(self, snapshot):
    self._steps += len(snapshot.state.rates[0])


def ending(self, snapshot, reason):
    assert reason != "failed"


counts("The rates of an implicit step are expected always", on_step=of_rates)
counts(
    "Wear of both bodies is expected in one shape, squared",
    on_step=lambda self, s: setattr(
        self, "_steps", int(np.linalg.inv(s.state.contact.pressure).size)
    ),
)
counts("It takes a run to end well", on_finish=ending)
