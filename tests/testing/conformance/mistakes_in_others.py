"""Motions, surfaces, contact solvers and observers with mistakes.

They were written without sight of the kit's source.
"""

import numpy as np
from testing.conformance.honest import Counts, Hill, Motion, Pad, Ramp, Solver, Wavy
from testing.conformance.mistaken import mistake

from tribo import Stationary, Track

# Motions.

SLID, STROKE = "2 * self.stroke * self.frequency * time", "self.stroke)}"

for words, old, new in (
    (
        "The distance is where it is, not how far it has slid",
        SLID,
        "0.5 * self.stroke * abs(np.sin(2 * np.pi * self.frequency * time))",
    ),
    (
        "The end is the cycles times the frequency",
        "return self.duration",
        "return 2000 * self.frequency",
    ),
    ("The track is as long as the window", STROKE, "grid.size[0])}"),
):
    mistake(words, Motion, old, new)
mistake(
    "The speeds are those of another amplitude than the path's",
    Motion,
    speeds=lambda self: [(2 * np.pi * self.stroke * self.frequency * s, 0.5) for s in (0.5, 0.9)],
)
mistake(
    "The body called disk is swept, whatever the case calls it",
    Motion,
    exposures=lambda self, grid, bodies: {
        name: Track(grid, self.stroke) if name == "disk" else Stationary(grid)
        for name in ("ball", "disk")
    },
)


class AcrossTrack(Track):
    def average(self, rate):
        line = np.sum(rate, axis=1)[None, :]
        return line * (self._dx / self._length)


mistake("The track runs along y", Motion, track=AcrossTrack)


class LongTrack(Track):
    def volume(self, depth):
        return super().volume(depth) * 1e3


mistake("The track's length is in mm in its volume", Motion, track=LongTrack)


def one_after_another(self, time):
    self._so_far += max(0.0, time - self._last) * 2 * self.stroke * self.frequency
    self._last = time
    return self._so_far


mistake(
    "The distance is added up from call to call",
    Motion,
    _so_far=0.0,
    _last=0.0,
    distance_at=one_after_another,
)
mistake("It speeds up for 5 s, in the code", Ramp, "start = self.start", "start = 5.0")
mistake(
    "Only one of the two ends is right: time_at is of full speed",
    Ramp,
    time_at=lambda s, d: d / s.speed,
)

# Surfaces.

FORM = "-0.5 * c * (x - self.beside) ** 2 - 0.25 * c * (y + 0.8 * self.beside) ** 2"

for words, old, new in (
    ("The diameter is taken for the radius", FORM, f"0.5 * ({FORM})"),
    (
        "The curvature along y comes first",
        "1 / self.radius, 0.5 / self.radius",
        "0.5 / self.radius, 1 / self.radius",
    ),
    ("Its height is that of the gap", FORM, f"-({FORM})"),
):
    mistake(words, Hill, old, new)


def by_shape(self, grid):
    if grid.cells not in self._maps:
        self._maps[grid.cells] = Hill.height(self, grid)
    return self._maps[grid.cells]


mistake("Heights are kept by the number of cells", Hill, _maps={}, height=by_shape)


WAVE = "self.amplitude * np.sin(2 * np.pi * x / self.wavelength + 0.3) + 0 * y"

for words, old, new in (
    ("Waves are counted in cells", "x / self.wavelength + 0.3", "np.arange(x.size)[:, None] / 8"),
    ("The amplitude is 1 µm, in the code", "self.amplitude * np", "1e-6 * np"),
    (
        "Roughness is drawn cell by cell",
        WAVE,
        "self.amplitude * np.random.default_rng(0).normal(size=grid.cells)",
    ),
    ("Heights are given as (y, x)", WAVE, f"np.ascontiguousarray(({WAVE}).T)"),
):
    mistake(words, Wavy, old, new)

# Contact solvers.


KERNELS = {}


HALF_SPACE = "HalfSpace(grid.cells, grid.spacing, modulus)"


def solver(words, **parts):
    mistake(words, Solver, **parts)


solver(
    "A kernel is kept by the number of cells alone",
    operator=lambda self, grid, modulus: KERNELS.setdefault(
        grid.cells, Solver.operator(self, grid, modulus)
    ),
)
mistake(
    "The modulus is that of the body called ball",
    Solver,
    "problem.system.grid, problem.system",
    'problem.system.materials["ball"] and problem.system.grid, problem.system',
)
mistake(
    "Cells are taken as squares",
    Solver,
    HALF_SPACE,
    "HalfSpace(grid.cells, (grid.spacing[0],) * 2, modulus)",
)


def from_the_last(self, problem, start=None):
    answer = Solver.solve(self, problem, start or self._last)
    self._last = answer
    return answer


solver("It starts from its own last solution", _last=None, solve=from_the_last)


def with_start_written(self, problem, start=None):
    if start is not None:
        start.pressure.flags.writeable = True
        start.pressure *= problem.load / (np.sum(start.pressure) * problem.system.grid.cell_area)
    return Solver.solve(self, problem, start)


solver("The start is scaled in place", solve=with_start_written)
STIFFNESS = "(grid, self.modulus / self.thickness)"
mistake("The foundation is 1e14 Pa/m, in the code", Pad, STIFFNESS, "(grid, 1e14)")
mistake(
    "The pad is as thick as a cell is long",
    Pad,
    STIFFNESS,
    "(grid, self.modulus / grid.spacing[0])",
)

# Observers.


def by_name(self, snapshot):
    self._depth = snapshot.state.bodies["ball"].wear.max()


mistake("The body called ball is watched", Counts, on_step=by_name)


def first_step(self, snapshot):
    self._rate = snapshot.state.distance / snapshot.state.steps


mistake("It divides by the steps, of which there are none yet", Counts, on_save=first_step)
mistake("It tells every step on the screen", Counts, on_step=lambda self, s: print(s.state.time))


def settle(self, snapshot):
    snapshot.state.contact.pressure.base[:] *= 0.999


mistake("It smooths the pressure round the view", Counts, on_step=settle)
