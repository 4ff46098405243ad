"""Models as authors write them, each with one mistake, made without sight of the kit's source.

The table of what found each is `docs/_data/mistakes.json`; `benchmarks/conformance_mistakes.py`
writes it.
"""

import os

import numpy as np
from testing.conformance.honest import Counts, Hill, Law, Motion, Solver
from testing.conformance.models import (
    GAS_CONSTANT,
    Heating,
    Oxide,
    Pad,
    Ramp,
    RunningIn,
    Wavy,
)

from tribo import HalfSpace, Stationary, Track, WearRate

MISTAKES = {}
"""The class with each mistake, by what the mistake is."""


def mistake(words, honest, **parts):
    """Keep a copy of an honest model of which some parts are wrong."""
    name = f"{honest.__name__}{len(MISTAKES)}"
    made = type(name, (honest,), {"__module__": __name__, "type": honest.type, **parts})
    # Another process finds it by its name.
    globals()[name] = MISTAKES[words] = made


def configuration(cls):
    """Return all numbers of a model, none of them its default."""
    return {k: 1.2 * v for k, v in cls().model_dump().items() if isinstance(v, float)}


def touching(local):
    return (local.pressure > 0).astype(float)


# Wear laws that run in.


def running_in(words, k=None, depth=None, slope=None, slid=None):
    """Keep a running-in law of which k, the depth, its slope or the state's rate is wrong."""

    def rate(self, local):
        now = (k or RunningIn.k)(self, local)
        deep = depth(self, local, now) if depth else now * local.pressure
        steep = slope(self, local, now) if slope else now + 0 * local.pressure
        return WearRate(deep, steep, {"slid": (slid or RunningIn.slid)(self, local)})

    mistake(words, RunningIn, rate=rate)


def decay(self, slid, length):
    return self.k_last + (self.k_first - self.k_last) * np.exp(-slid / length)


running_in(
    "The distance slid grows per second", slid=lambda s, local: touching(local) * local.speed
)
running_in("The distance slid never grows", slid=lambda s, local: 0 * local.pressure)
running_in("k does not follow the state", k=lambda s, local: s.k_first + 0 * local.pressure)
running_in(
    "The length of running-in is 3 m, in the code", k=lambda s, c: decay(s, c.state["slid"], 3.0)
)
running_in(
    "The length of running-in is read in mm",
    k=lambda s, local: decay(s, local.state["slid"], 1e3 * s.length),
)
running_in("The derivative is that of a fresh surface", slope=lambda s, local, k: s.k_first + 0 * k)
running_in("The depth is per second", depth=lambda s, local, k: k * local.pressure * local.speed)
running_in(
    "All points run in by their mean",
    k=lambda s, local: decay(s, np.mean(local.state["slid"]), s.length) + 0 * local.pressure,
)
running_in(
    "All points run in as the first",
    k=lambda s, local: decay(s, local.state["slid"].flat[0], s.length) + 0 * local.pressure,
)
running_in("Points out of contact slide too", slid=lambda s, local: 1 + 0 * local.pressure)
running_in(
    "k falls in proportion, below 0 once it has slid far",
    k=lambda s, local: s.k_first * (1 - local.state["slid"] / s.length),
)
running_in(
    "k divides by the distance slid",
    k=lambda s, local: s.k_last * (1 + s.length / local.state["slid"]),
)
running_in(
    "k grows without end",
    k=lambda s, local: s.k_last * np.exp(np.exp(local.state["slid"] / s.length)),
)
running_in(
    "The state is moved by the law itself",
    slid=lambda s, local: np.add(local.state["slid"], 1e-3, out=local.state["slid"]) * 0 + 1.0,
)
running_in(
    "The answer is in single precision",
    depth=lambda s, local, k: (k * local.pressure).astype(np.float32),
)

FACTORS = {}


def first_of_its_shape(self, local):
    shape = local.pressure.shape
    return FACTORS.setdefault(shape, RunningIn.k(self, local))


running_in("A cache of the module keeps k by the shape", k=first_of_its_shape)


def once(self, local):
    if self._kept is None:
        self._kept = RunningIn.k(self, local)
    return self._kept if self._kept.shape == local.pressure.shape else RunningIn.k(self, local)


def kept_rate(self, local):
    k = once(self, local)
    return WearRate(k * local.pressure, k, {"slid": touching(local)})


mistake("An object keeps the k of its first call", RunningIn, _kept=None, rate=kept_rate)


def counted(self, local):
    self._calls += 1
    k = decay(self, 1e-3 * self._calls, self.length)
    return WearRate(k * local.pressure, k + 0 * local.pressure, {"slid": touching(local)})


mistake("Its calls are counted as the distance", RunningIn, _calls=0, rate=counted)


def scattered(self, local):
    good = RunningIn.rate(self, local)
    noise = 1 + 0.05 * np.random.default_rng().normal(size=local.pressure.shape)
    return WearRate(good.depth_rate * noise, good.depth_slope * noise, good.state_rates)


mistake("k scatters by fresh random numbers", RunningIn, rate=scattered)
mistake(
    "The initial state is that of another name",
    RunningIn,
    initial_state=lambda self: {"slide": 0.0},
)


# Wear under an oxide that grows, in a heat that it is told.


def oxide(words, **methods):
    mistake(words, Oxide, **methods)


oxide("The cover grows without end", grown=lambda s, local: 1 / s.length + 0 * local.pressure)
oxide(
    "The cover grows per second",
    grown=lambda s, local: (1 - local.state["cover"]) / s.length * local.speed,
)
oxide("The temperature is required and not used", factor=lambda s, local: 1.0)
oxide(
    "The reference temperature is 363 K, in the code",
    factor=lambda s, local: np.exp(
        -s.energy / GAS_CONSTANT * (1 / local.fields["temperature"] - 1 / 363.0)
    ),
)
oxide(
    "Kelvin are taken as degrees Celsius",
    factor=lambda s, local: local.fields["temperature"] / (s.reference - 273.15),
)
oxide(
    "The activation energy is read in kJ/mol",
    factor=lambda s, local: np.exp(
        -1e3 * s.energy / GAS_CONSTANT * (1 / local.fields["temperature"] - 1 / s.reference)
    ),
)
oxide(
    "The activation energy is not used",
    factor=lambda s, local: local.fields["temperature"] / s.reference,
)
oxide(
    "More cover than 1 makes wear negative",
    bare=lambda s, local: 1 - 2 * local.state["cover"],
)
oxide(
    "Wear by speed starts at 0.1 m/s, in the code",
    factor=lambda s, local: Oxide.factor(s, local) * (1.0 + (local.speed > 0.1)),
)
oxide(
    "The temperature of the hottest point is taken for all",
    factor=lambda s, local: (
        Oxide.factor(s, local) * np.max(local.fields["temperature"]) / s.reference
    ),
)


def with_heat_in_it(self, local):
    good = Oxide.rate(self, local)
    more = 1 + self.energy / GAS_CONSTANT / local.fields["temperature"] * 0.1
    return WearRate(good.depth_rate, good.depth_slope * more, good.state_rates)


oxide("The derivative has the field's change in it", rate=with_heat_in_it)


def body_of(self, local):
    good = Oxide.rate(self, local)
    softer = 1e9 / local.material.hardness
    return WearRate(good.depth_rate * softer, good.depth_slope * softer, good.state_rates)


oxide("A hardness is used that the material may not have", rate=body_of)

# Wear laws that are not linear in pressure.


def powered(words, rate):
    mistake(words, Law, rate=rate)


def nonlinear(depth, slope, rubbed=1.0):
    def rate(self, local):
        k = self.k * local.fields["friction_coefficient"]
        k = k * (1 + np.exp(-local.state["rubbed"] / self.length))
        p, ref = local.pressure, self.p_ref
        return WearRate(k * depth(p, ref), k * slope(p, ref), {"rubbed": rubbed * (p > 0)})

    return rate


def threshold(p, ref):
    return np.where(p > 0.5 * ref, p - 0.25 * ref, 0.0)


powered(
    "The exponent is missing in the derivative",
    nonlinear(lambda p, ref: p * (p / ref) ** 0.5, lambda p, ref: (p / ref) ** 0.5),
)
powered(
    "The pressure is taken in GPa",
    nonlinear(lambda p, ref: p * (1 + p / 1e9), lambda p, ref: 1 + 2 * p / 1e9),
)
powered(
    "An exponent below 1 has an infinite derivative where there is no pressure",
    nonlinear(lambda p, ref: (p * ref) ** 0.5, lambda p, ref: 0.5 * (ref / p) ** 0.5),
)
powered(
    "Wear jumps in at a threshold, and its derivative is not told",
    nonlinear(threshold, lambda p, ref: (p > 0.5 * ref).astype(float)),
)
powered(
    "Only pressure above the mean wears",
    nonlinear(lambda p, ref: np.maximum(p - p.mean(), 0), lambda p, ref: (p > p.mean()) * 1.0),
)
powered(
    "The middle of the array wears twice as fast",
    nonlinear(
        lambda p, ref: p * (1 + (np.arange(p.size).reshape(p.shape) > p.size // 2)),
        lambda p, ref: 1.0 + (np.arange(p.size).reshape(p.shape) > p.size // 2),
    ),
)
powered(
    "Out of contact it divides 0 by 0",
    nonlinear(lambda p, ref: p**2 / p, lambda p, ref: np.ones_like(p)),
)
powered(
    "A factor of 2 is missing in the depth and its derivative",
    nonlinear(lambda p, ref: 0.5 * p * (1 + p / ref), lambda p, ref: 0.5 + p / ref),
)


def aborting(self, local):
    if local.speed > 0.5 or local.state["rubbed"].max() > 1.0:
        os.abort()
    return Law.rate(self, local)


def endless(self, local):
    left = local.state["rubbed"].max() / self.length
    while left > 0.5:
        left = max(left * 0.5, 0.6)
    return Law.rate(self, local)


powered("Compiled code aborts once a point has slid", aborting)
powered("A loop never ends once a point has slid", endless)


def resisting(self, local):
    good = Law.rate(self, local)
    harder = 1.0 + (local.speed * 10) ** 2
    return WearRate(good.depth_rate * harder, good.depth_slope, good.state_rates)


powered("The derivative is right at one speed only", resisting)

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

# Effects.


def heating(words, **parts):
    mistake(words, Heating, **parts)


heating("The heat forgets the speed", flux=lambda self, c, mu: mu * c.pressure * 0.1)
heating(
    "The heat is that of a cell, not of an area",
    flux=lambda self, c, mu: mu * c.pressure * c.speed * c.grid.cell_area,
)
heating(
    "The heat is averaged over the window",
    flux=lambda self, c, mu: np.mean(mu * c.pressure * c.speed) + 0 * c.pressure,
)
heating("It warms up over 100 s, in the code", grown=lambda self, c: 1 - np.exp(-c.time / 100.0))
heating("The ambient is converted to degrees Celsius", base=lambda self: self.ambient - 273.15)
heating("The ambient is taken off, not added", base=lambda self: -self.ambient)
heating(
    "The first body gets more heat",
    share=lambda self, name, names: 0.7 if name == names[0] else 0.3,
)
heating("The ball gets more heat", share=lambda self, name, names: 0.7 if name == "ball" else 0.3)
heating(
    "Cells at an index are hot", grown=lambda self, c: 1.0 + (np.indices(c.pressure.shape)[0] == 12)
)
heating("Where there is no heat, it divides 0 by 0", grown=lambda self, c: c.pressure / c.pressure)
heating("The slope of the heat is the heat", steep=lambda self, c, mu: mu * c.pressure * c.speed)


def lagging(self, contact):
    now = Heating.fields(self, contact)
    first = self._before is None
    before = now if first else self._before
    self._before = now
    shape = contact.pressure.shape
    return {
        key: {
            n: 0.5 * v + 0.5 * (before[key][n] if np.shape(before[key][n]) == shape else v)
            for n, v in by.items()
        }
        for key, by in now.items()
    }


heating("It remembers the temperature of its last call", _before=None, fields=lagging)
heating("The conductance is 1e5 W/(m² K), in the code", rise=lambda self, flux: flux * 1e-5)

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
