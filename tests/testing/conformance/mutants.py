"""Wrong implementations: each breaks one promise, which its check must notice."""

import random
import sys
from dataclasses import replace
from itertools import count
from os import getpid
from types import ModuleType
from typing import Annotated

import numpy as np
from pydantic import field_validator, model_serializer
from testing.conformance.honest import Counts, Law, Motion, Solver
from testing.conformance.honest_effects import Heating, Slip
from testing.conformance.mistaken import rewritten

from tribo import (
    ContactSolver,
    Effect,
    Field,
    Grid,
    Passing,
    Position,
    Quantity,
    Residuals,
    Stationary,
    Track,
)
from tribo.testing.compare import CheckFailed

MUTANTS = []
"""The check that must fail, the class, and what is raised."""
NUMBERS = count()


def wrong(check, honest, *texts, raising=CheckFailed, **parts):
    """Keep a mutant of an honest class, of other texts in its source or of other parts."""
    own = {"__module__": __name__, **rewritten(honest, texts), **parts}
    MUTANTS.append((check, type(f"{honest.__name__}{next(NUMBERS)}", (honest,), own), raising))


# The configuration, by the example of a wear law.


class WithoutUnit(Law):
    q: float = 3.0
    """Something."""


class Undescribed(Law):
    q: Annotated[float, Quantity("1")] = 3.0


class MillimetresEachTime(Law):
    q: Annotated[float, Quantity("m")] = 3.0
    """A length in mm."""

    @field_validator("q")
    @classmethod
    def _to_metres(cls, value):
        return 1e-3 * value


class AnotherWithoutDefaults(Law):
    @model_serializer(mode="wrap")
    def _short(self, handler, info):
        return {**handler(self), **({"k": 2e-16} if info.exclude_defaults else {})}


def _local():
    class Unreachable(Law):
        """A class that no other process can find."""

    return Unreachable


# Another process that imports this file makes a module of another name.
here = sys.modules[f"only_in_{getpid()}"] = ModuleType("here")
here.OnlyHere = type("OnlyHere", (Law,), {"__module__": f"only_in_{getpid()}"})

MUTANTS += [
    ("configuration_is_described", WithoutUnit, CheckFailed),
    ("configuration_is_described", Undescribed, CheckFailed),
    ("configuration_survives_a_file", MillimetresEachTime, CheckFailed),
    ("configuration_survives_a_file", AnotherWithoutDefaults, CheckFailed),
    ("configuration_can_be_pickled", _local(), CheckFailed),
    ("configuration_can_be_pickled", here.OnlyHere, CheckFailed),
]
for check, parts in (
    ("objects_are_frozen_and_know_their_keys", {"model_config": {"frozen": False}}),
    ("objects_are_frozen_and_know_their_keys", {"model_config": {"extra": "ignore"}}),
    ("name_has_a_prefix", {"type": "law"}),
    ("facts_are_text_and_stay", {"facts": lambda self: {"size": 1.24e-3}}),
    ("declared_fields_have_units", {"state_fields": (Field("rubbed", "mm", "Distance slid."),)}),
):
    wrong(check, Law, **parts)

# Wear laws.


def failing_later(self, local):
    if local.pressure.shape[-2:] == (24, 20) and local.state["rubbed"].max() > 0:
        raise RuntimeError("too far")
    return Law.rate(self, local)


wrong(
    "only_declared_fields_are_asked_for",
    Law,
    "k = c.k *",
    'k = local.fields.get("temperature", 300.0) * c.k *',
)
wrong("runs_under_implicit_stepping", Law, rate=failing_later, raising=RuntimeError)

# Contact solvers.


def answering(change):
    """Return a `solve` of which some parts of the answer are changed."""
    return lambda self, problem, start=None: change(Solver.solve(self, problem, start))


wrong(
    "answers_fit_a_run",
    Solver,
    solve=answering(lambda answer: replace(answer, residuals=Residuals(0, 0.01, 0))),
)
wrong(
    "pressure_goes_with_the_gap",
    Solver,
    solve=answering(lambda answer: replace(answer, pressure=np.roll(answer.pressure, 1, axis=0))),
)
wrong(
    "pressure_goes_with_the_gap",
    Solver,
    "problem.gap",
    "problem.gap + 2e-6 * (grid.mesh[0] / 0.36e-3) ** 2",
)
wrong(
    "wear_compliance_adds_its_depth",
    Solver,
    "problem.wear",
    "problem.wear and type(problem.wear)(problem.wear.local, 0 * problem.wear.swept)",
)
wrong(
    "positions_share_their_wear",
    Solver,
    couples=True,
    solve_cycle=lambda self, *given: ContactSolver.solve_cycle(self, *given),
)
wrong("cap_of_each_point_is_kept", Solver, takes_cap_map=True)

# Motions.


def resolved(starts, rows=32):
    """Return the parts of a motion of nine positions."""
    body = type("WrongBody", (Passing,), {"rows": rows})
    return {
        "cycle": lambda self, grid: [Position(1 / 9)] * 9,
        "track": lambda self, grid, stroke: body(grid, range(starts), stroke),
    }


def at_once(self, distance):
    return Motion.time_at(self, distance) if distance == 0 or distance > 2.9 else 0.0


def refusing(self, half_width_x):
    raise ValueError("no")


def as_if_it_stayed(self, derivative, pressure):
    stays = Stationary(Grid((1.0, 1.0), derivative.shape))
    return stays.compliance(derivative, pressure)


wrong("answers_fit_a_run", Motion, track=type("WrongTrack", (Track,), {"swept": False}))
for starts, rows in ((8, 32), (9, 30), (9, 32)):
    wrong("answers_fit_a_run", Motion, **resolved(starts, rows))
wrong("answers_fit_a_run", Motion, check_contact=refusing, raising=ValueError)
wrong("runs_a_case", Motion, time_at=at_once)
wrong(
    "compliance_is_the_average_of_a_linear_law",
    Motion,
    track=type("WrongTrack", (Track,), {"compliance": as_if_it_stayed}),
)

# Effects.

wrong("declared_fields_have_units", Heating, provides=(Field("temperature", "", "Heat."),))
wrong(
    "runs_in_a_case",
    Heating,
    "-contact.time / self.delay",
    "-contact.time / self.delay + 0 * {True: 1}[contact.distance >= 0.99]",
    raising=KeyError,
)


def product(self, contact, cotangents):
    body, friction = next(iter(contact.fields["friction_coefficient"].items()))
    by = -sum(cotangents["local_slip"].values()) * self.slip(contact) ** 2 / self.strength
    return {
        "pressure": friction * by,
        f"fields.friction_coefficient.{body}": contact.pressure * by,
        "strength": -np.sum(friction * contact.pressure * by) / self.strength,
    }


def without(path):
    return lambda *given: {key: by for key, by in product(*given).items() if path not in key}


for path in ("pressure", "friction", "strength"):
    wrong("product_is_that_of_differences", Slip, pull_back=without(path))

# Effects that change the load.


class Spring(Effect):
    """A spring that relaxes as the bodies wear: F = F₀ − S h."""

    type = "test.spring"
    relaxes: Annotated[float, Quantity("1/m", at_least=0)] = 1e4
    """Stiffness over the first load."""

    def load_factor(self, snapshot):
        return 1 - self.relaxes * sum(b.max_wear_depth for b in snapshot.measures.bodies.values())


def after(deed):
    """Return a `load_factor` that does a deed first."""
    return lambda self, snapshot: (deed(snapshot), Spring.load_factor(self, snapshot))[1]


def pulling(self, snapshot):
    return 1.0 if snapshot.state.steps == 0 else -Spring.load_factor(self, snapshot)


def counted(self, snapshot):
    return Spring.load_factor(self, snapshot) - 1e-9 * next(NUMBERS)


def digging(snapshot):
    snapshot.state.bodies["ball"].wear[:] = 0


for factor in (
    pulling,
    counted,
    after(lambda snapshot: random.random()),
    after(lambda snapshot: np.seterr(all="ignore")),
):
    wrong("runs_in_a_case", Spring, load_factor=factor)
wrong("runs_in_a_case", Spring, load_factor=after(digging), raising=ValueError)

# Observers.


def counting(self, snapshot):
    self._steps += snapshot.state.steps == 0
    assert self._steps


def starting_once(self, run):
    assert not self._steps
    self._steps = 1


def needing_a_snapshot(self, snapshot, reason):
    return snapshot.state


wrong("any_run_is_survived", Counts, on_finish=needing_a_snapshot, raising=AttributeError)
wrong("any_run_is_survived", Counts, on_step=counting, raising=AssertionError)
wrong("any_run_is_survived", Counts, on_start=starting_once, raising=AssertionError)
