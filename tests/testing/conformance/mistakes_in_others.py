"""Motions, surfaces, contact solvers and observers with mistakes.

They were written without sight of the kit's source.
"""

import numpy as np
from testing.conformance.honest import Counts, Hill, Motion, Solver
from testing.conformance.mistaken import mistake
from testing.conformance.models import Pad, Ramp, Wavy

from tribo import HalfSpace, Stationary, Track

# Motions.

mistake(
    "The distance is where it is, not how far it has slid",
    Motion,
    distance_at=lambda self, t: 0.5 * self.stroke * abs(np.sin(2 * np.pi * self.frequency * t)),
)
mistake(
    "The end is the cycles times the frequency",
    Motion,
    end_time=property(lambda self: 2000 * self.frequency),
)
mistake(
    "The speeds are those of another amplitude than the path's",
    Motion,
    speeds=lambda self: [(2 * np.pi * self.stroke * self.frequency * s, 0.5) for s in (0.5, 0.9)],
)
mistake(
    "The track is as long as the window",
    Motion,
    exposures=lambda self, grid, bodies: {
        bodies[0]: Stationary(grid),
        bodies[1]: Track(grid, grid.size[0]),
    },
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
mistake("It speeds up for 5 s, in the code", Ramp, takes=lambda self: 5.0)
mistake(
    "Only one of the two ends is right: time_at is of full speed",
    Ramp,
    time_at=lambda s, d: d / s.speed,
)

# Surfaces.

mistake(
    "The diameter is taken for the radius",
    Hill,
    height=lambda self, grid: 0.5 * Hill.height(self, grid),
)
mistake(
    "The curvature along y comes first",
    Hill,
    curvature=property(lambda s: (0.5 / s.radius, 1 / s.radius)),
)
mistake("Its height is that of the gap", Hill, height=lambda self, grid: -Hill.height(self, grid))


def by_shape(self, grid):
    if grid.cells not in self._maps:
        self._maps[grid.cells] = Hill.height(self, grid)
    return self._maps[grid.cells]


mistake("Heights are kept by the number of cells", Hill, _maps={}, height=by_shape)


def waves(words, height):
    mistake(words, Wavy, height=height)


waves(
    "Waves are counted in cells",
    lambda self, grid: (
        self.amplitude * np.sin(2 * np.pi * np.arange(grid.cells[0]) / 8)[:, None]
        + 0 * grid.mesh[1]
    ),
)
waves(
    "The amplitude is 1 µm, in the code",
    lambda self, grid: 1e-6 * np.sin(2 * np.pi * grid.mesh[0] / self.wavelength) + 0 * grid.mesh[1],
)
waves(
    "Roughness is drawn cell by cell",
    lambda self, grid: self.amplitude * np.random.default_rng(0).normal(size=grid.cells),
)
waves(
    "Heights are given as (y, x)",
    lambda self, grid: np.ascontiguousarray(Wavy.height(self, grid).T),
)

# Contact solvers.


KERNELS = {}


def solver(words, **parts):
    mistake(words, Solver, **parts)


solver(
    "A kernel is kept by the number of cells alone",
    operator=lambda self, grid, modulus: KERNELS.setdefault(
        grid.cells, HalfSpace(grid.cells, grid.spacing, modulus)
    ),
)
solver(
    "The modulus is that of the body called ball",
    operator=lambda self, grid, modulus: HalfSpace(grid.cells, grid.spacing, modulus),
    solve=lambda self, problem, start=None: (
        problem.system.materials["ball"],
        Solver.solve(self, problem, start),
    )[1],
)
solver(
    "Cells are taken as squares",
    operator=lambda self, grid, modulus: HalfSpace(grid.cells, (grid.spacing[0],) * 2, modulus),
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
mistake("The foundation is 1e14 Pa/m, in the code", Pad, stiffness=lambda self, grid: 1e14)
mistake(
    "The pad is as thick as a cell is long",
    Pad,
    stiffness=lambda self, grid: self.modulus / grid.spacing[0],
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
