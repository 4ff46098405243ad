"""Contact solvers, motions, surfaces and observers with mistakes in their physics.

They were written without sight of the checks.
"""

from dataclasses import replace

import numpy as np
from testing.conformance.honest import Counts, Hill, Motion, Ramp, Shuttle, Solver, Wavy
from testing.conformance.mistaken import mistake

from tribo import Residuals, Track


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
    "HalfSpace(grid.cells, grid.spacing, modulus)",
    "Springs(grid, modulus / grid.spacing[0])",
)

# Motions.

AT, TIME = "strokes + min(into / self.moves, 1.0)", "strokes * self.rest + distance / self.speed"
SWEPT, SPEEDS = "bodies[-1] if self.swept is None else self.swept", "[(self.speed, 1.0)]"

for words, *texts in (
    (
        "At a reversal the time is that at which it goes on",
        "max(math.ceil(distance / self.stroke - 1e-9) - 1, 0)",
        "distance // self.stroke",
    ),
    ("The time forgets the rests", TIME, "distance / self.speed"),
    (
        "The time is that of the mean speed",
        TIME,
        "distance / self.stroke * (self.moves + self.rest)",
    ),
    ("It slides on while it rests", AT, "time / (self.moves + self.rest)"),
    (
        "The stroke back is counted off",
        AT,
        "0.5 - 0.5 * math.cos(math.pi * time / (self.moves + self.rest))",
    ),
    ("Only whole strokes count", AT, "strokes"),
    ("The speed is that of a circular path", SPEEDS, "[(math.pi * self.speed, 1.0)]"),
    (
        "Shares are those of time, with the rest",
        f"return {SPEEDS}",
        "both = self.moves + self.rest\n"
        "        return [(self.speed, self.moves / both), (0.0, self.rest / both)]",
    ),
    ("The shares are in percent", SPEEDS, "[(self.speed, 100.0)]"),
    (
        "The track is once to and fro, its extent once",
        "Track(grid, self.stroke)",
        "Track(grid, 2 * self.stroke)",
    ),
    ("The body that is not named moves", "if name == swept", "if name != swept"),
    ("The key of the moving body is not used", SWEPT, "bodies[-1]"),
):
    mistake(words, Shuttle, *texts)

for words, *texts in (
    (
        "Both bodies are named by what is common, ball and disk",
        "{bodies[0]: Stationary(grid), bodies[1]:",
        '{"ball": Stationary(grid), "disk":',
    ),
    ("The time is in minutes at its end", "return self.duration", "return self.duration / 60"),
    (
        "The distance falls back each second",
        "self.frequency * time",
        "self.frequency * (time - 0.3 * (time % 1.0))",
    ),
):
    mistake(words, Motion, *texts)
mistake("Edges are in cycles", Motion, edges=property(lambda s: (1e3 * s.duration,)))
mistake(
    "The ramp is half the speed at once, and is not told as an edge",
    Ramp,
    "0.5 * early**2 / start",
    "0.5 * early",
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


mistake("The track is laid mirrored along y", Motion, track=UpsideDown)
mistake("The envelope is the mean along the track", Motion, track=MeanEnvelope)
mistake("The volume is that of one row of cells", Motion, track=OneRow)

# Surfaces.

X, Y = "(x - self.beside)", "(y + 0.8 * self.beside)"
FORM = f"-0.5 * c * {X} ** 2 - 0.25 * c * {Y} ** 2"
CURVED = "1 / self.radius, 0.5 / self.radius"

for words, *texts in (
    (
        "Places are counted from the corner of the window",
        *("x, y = grid.mesh", "x, y = (v + 0.5 * size for v, size in zip(grid.mesh, grid.size))"),
        *(Y, "y"),
    ),
    (
        "Beyond a ball's edge its height is no number",
        FORM,
        "np.sqrt((0.03 / c) ** 2 - x**2 - 0.5 * y**2)",
    ),
    ("The curvature is that of a hollow", CURVED, "-1 / self.radius, -0.5 / self.radius"),
    ("The curvature is in 1/mm", CURVED, "1e-3 / self.radius, 5e-4 / self.radius"),
    ("Heights are in µm", FORM, f"1e6 * ({FORM})"),
    ("Heights are in single precision", FORM, f"({FORM}).astype(np.float32)"),
):
    mistake(words, Hill, *texts)


def in_one_array(self, grid):
    out = self._maps.setdefault(grid.cells, np.empty(grid.cells))
    out[:] = Hill.height(self, grid)
    return out


mistake(
    "Heights lie in an array that the next call overwrites", Hill, _maps={}, height=in_one_array
)


def scaled_in_each_window(self, grid):
    relief = Wavy.height(self, grid) + 1e-3 * grid.mesh[1]
    return relief * self.amplitude / np.abs(relief).max()


mistake("Relief is scaled to the amplitude in each window", Wavy, height=scaled_in_each_window)
mistake(
    "The phase is counted from the window's edge",
    Wavy,
    "x / self.wavelength + 0.3",
    "(x - x.min()) / self.wavelength",
)
mistake(
    "The curvature of a wave forgets 2 π",
    Wavy,
    curvature=property(lambda s: (s.amplitude / s.wavelength**2, 0.0)),
)
mistake("A smoothed surface loses its configuration", Wavy, smoothed=lambda s: type(s)())

# Observers.


def of_rates(self, snapshot):
    self._steps += len(snapshot.state.rates[0])


def of_the_inverse(self, snapshot):
    self._steps = int(np.linalg.inv(snapshot.state.contact.pressure).size)


def ending(self, snapshot, reason):
    assert reason != "failed"


mistake("The rates of an implicit step are expected always", Counts, on_step=of_rates)
mistake("Wear of both bodies is expected in one shape, squared", Counts, on_step=of_the_inverse)
mistake("It takes a run to end well", Counts, on_finish=ending)
