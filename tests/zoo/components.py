"""Faulty components: whose methods raise, or answer nonsense from the start or from some step."""

from dataclasses import replace

import numpy as np
from pydantic import field_serializer, model_validator
from zoo_keeper import Zoo

from tribo import (
    CaseError,
    DcFft,
    Effect,
    Field,
    NumericalError,
    Observer,
    Sphere,
    WearLaw,
    WearRate,
)

ZOO = Zoo()


def raising(error):
    def fail(*given, **options):
        raise error

    return fail


class Unspeakable(Exception):
    def __str__(self):
        raise RuntimeError


def writing(array):
    array[:] = 0


# Keys, and what is made of them.


class Watcher(Observer):
    pass


def configured(name, error, words):
    def check(self):
        raise error

    ZOO.bad(name, Watcher, words, 2, _check=model_validator(mode="after")(check))


READ = "could not read its keys: "
configured("leaves_early", SystemExit(0), READ + "SystemExit: 0")
configured("says_nothing", ValueError(), "refused its keys without saying why")
configured("refuses", CaseError("these exclude each other"), "these exclude each other")
ZOO.bad("is_offline", Watcher, "raised ConnectionError", facts=raising(ConnectionError("offline")))


class CannotBeWritten(Watcher):
    key: str = "value"

    @field_serializer("key")
    def _write(self, key):
        raise LookupError(key)


ZOO.bad("cannot_be_written", CannotBeWritten, "Error calling function")

# Observers.


def failing_late(self, snapshot):
    if snapshot.state.steps > 10:
        raise KeyError("step")


for name, words, parts in (
    ("fails_at_start", "raised OSError: no screen", {"on_start": raising(OSError("no screen"))}),
    ("fails_at_a_step", "raised KeyError: 'step'", {"on_step": failing_late}),
    ("presses", "read-only", {"on_step": lambda self, s: writing(s.state.contact.pressure)}),
):
    ZOO.bad(name, Watcher, words, saved=True, **parts)

# Surfaces.


class Ball(Sphere):
    radius: float = 5e-3


def holed(self, grid):
    height = Sphere.height(self, grid)
    height[0, 0] = np.nan
    return height


for name, words, height in (
    (
        "column",
        "of body 'ball' gave 'height' that is float64 of shape (24, 1)",
        lambda s, grid: Sphere.height(s, grid)[:, :1],
    ),
    ("holed", "'height' that is not finite in 1 cells", holed),
    ("no_scan", "FileNotFoundError: scan.opd", raising(FileNotFoundError("scan.opd"))),
):
    ZOO.bad(name, Ball, words, height=height)
ZOO.bad("one_curvature", Ball, "'curvature' that is 3", curvature=property(lambda self: 3))

# Effects.


class Heat(Effect):
    """A field of the pressure's shape for each body, and what is made of it."""

    provides = (Field("zoo_heat", "W/m^2", "Power per area."),)

    def fields(self, contact):
        return {"zoo_heat": {name: self.heat(contact.pressure) for name in contact.materials}}

    def heat(self, pressure):
        return pressure * 0.1


for name, words, fields in (
    ("no_fields", "NoneType as its fields", lambda self, contact: None),
    ("forgets_the_field", "gave no 'zoo_heat' for body 'ball'", lambda self, contact: {}),
):
    ZOO.bad(name, Heat, words, saved=True, fields=fields)
for name, words, heat in (
    (
        "short_heat",
        "'zoo_heat' for body 'ball' that is float64 of shape (23, 24)",
        lambda self, pressure: pressure[1:],
    ),
    ("heat_raises", "raised KeyError: 'steel'", raising(KeyError("steel"))),
    ("heat_writes", "read-only", lambda self, pressure: writing(pressure)),
):
    ZOO.bad(name, Heat, words, saved=True, heat=heat)

# Wear laws.


class Law(WearLaw):
    """Good for 20 calls; `spoilt` is what it answers after them."""

    _calls: int = 0

    def rate(self, local):
        self._calls += 1
        k = np.full_like(local.pressure, 3e-16)
        depth = k * local.pressure
        good = WearRate(depth, k, {f.name: depth for f in self.state_fields})
        return self.spoilt(good, local) if self._calls > 20 else good

    def spoilt(self, good, local):
        return good


class Slides(Law):
    state_fields = (Field("slid", "m", "Distance slid."),)


def rated(change):
    return lambda self, good, local: replace(good, **change(good, local))


for name, words, spoilt in (
    ("no_rate", "of body 'ball' gave a NoneType", lambda self, good, local: None),
    ("rate_nan", "not finite in", rated(lambda r, local: {"depth_rate": r.depth_rate * np.nan})),
    ("grows", "'depth_rate' that is -", rated(lambda r, _: {"depth_rate": -r.depth_rate})),
    (
        "wears_untouched",
        "that is not 0 in",
        rated(lambda r, local: {"depth_rate": 3e-16 * (local.pressure + 1e8)}),
    ),
    ("rate_writes", "read-only", rated(lambda r, local: writing(local.pressure))),
    ("rate_raises", "raised KeyError: 'oops'", raising(KeyError("oops"))),
    ("state_is_7", "gave a int as rates of its state", rated(lambda r, _: {"state_rates": 7})),
):
    ZOO.bad(name, Law, words, saved=True, spoilt=spoilt)
for name, words, spoilt in (
    ("forgets_its_state", "no rate for its state field 'slid'", lambda r, local: {}),
    ("ages", "'rate of slid' that is not 0 in", lambda r, local: {"slid": r.depth_slope}),
):
    spoilt = rated(lambda r, local, rates=spoilt: {"state_rates": rates(r, local)})
    ZOO.bad(name, Slides, words, saved=True, spoilt=spoilt)
ZOO.bad("starts_nowhere", Slides, "but starts with {}", initial_state=lambda self: {})
ZOO.bad(
    "starts_nan", Slides, "'initial slid' that is nan", initial_state=lambda self: {"slid": np.nan}
)

# Contact solvers.


class Solver(DcFft):
    """Good for 20 solves; `spoilt` is what it answers after them."""

    _solves: int = 0
    _kept: object = None

    def solve(self, problem, start=None):
        self._solves += 1
        solution = super().solve(problem, start)
        return self.spoilt(solution, problem) if self._solves > 20 else solution

    def spoilt(self, solution, problem):
        return solution


def solution(change):
    return lambda self, solution, problem: replace(solution, **change(solution))


def holed_pressure(s):
    return {"pressure": np.where(np.arange(24) > 0, s.pressure, np.nan)}


def focused(s):
    pressure = np.zeros_like(s.pressure)
    pressure[16, 16] = s.pressure.sum()
    return {"pressure": pressure}


def used_again(self, problem, start=None):
    answer = Solver.solve(self, problem, start)
    if start is None:
        self._kept = answer
        return answer
    self._kept.pressure[:] = answer.pressure
    return self._kept


for name, words, spoilt in (
    ("no_solution", "NoneType as its solution", lambda self, s, problem: None),
    ("nan_p", "not finite in 24 cells", solution(holed_pressure)),
    ("too_hard", "above the hardness of 2e+09 Pa", solution(focused)),
    ("too_strong", "carries 100.01 N", solution(lambda s: {"pressure": 1.0001 * s.pressure})),
    ("no_approach", "'approach' that is nan", solution(lambda s: {"approach": np.nan})),
    ("no_residuals", "NoneType as its residuals", solution(lambda s: {"residuals": None})),
    ("divides", "raised ZeroDivisionError: division by zero", lambda self, s, problem: 1 / 0),
    ("mute", "raised NumericalError", raising(NumericalError())),
    ("gives_up", "it did not like it", raising(NumericalError("it did not like it"))),
    ("unspeakable", "(its message cannot be shown)", raising(Unspeakable())),
    ("writes_gap", "read-only", lambda self, s, problem: writing(problem.gap)),
):
    ZOO.bad(name, Solver, words, saved=True, spoilt=spoilt)
ZOO.bad("uses_its_answer_again", Solver, "read-only", saved=True, solve=used_again)
ZOO.bad(
    "boastful",
    DcFft,
    "'smallest_compliance' that is a str",
    case={"more": 'stepping = { type = "explicit", time_step = 1 }'},
    smallest_compliance=lambda self, system: "tiny",
)
