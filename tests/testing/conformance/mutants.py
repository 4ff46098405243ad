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


def wrong(honest, *mistakes):
    """Return mutants of an honest class, given the check that each fails, its parts, its error."""
    own = {"__module__": __name__}
    return [
        (
            check,
            type(f"{honest.__name__}{next(NUMBERS)}", (honest,), {**own, **parts}),
            raising[0] if raising else CheckFailed,
        )
        for check, parts, *raising in mistakes
    ]


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
MUTANTS += wrong(
    Law,
    ("objects_are_frozen_and_know_their_keys", {"model_config": {"frozen": False}}),
    ("objects_are_frozen_and_know_their_keys", {"model_config": {"extra": "ignore"}}),
    ("name_has_a_prefix", {"type": "law"}),
    ("facts_are_text_and_stay", {"facts": lambda self: {"size": 1.24e-3}}),
)

# Calls that are not pure.


def rate(change):
    """Return a `rate` that differs from the honest law's by `change` of it and its conditions."""
    return lambda self, local: change(Law.rate(self, local), local)


# Wear laws.


def parts(change):
    """Return a `rate` of which `change` of it and its conditions gives other parts."""
    return {"rate": rate(lambda r, local: replace(r, **change(r, local)))}


def failing_later(rate, local):
    if local.pressure.shape[-2:] == (24, 20) and local.state["rubbed"].max() > 0:
        raise RuntimeError("too far")
    return {}


def asking(rate, local):
    return {"depth_rate": rate.depth_rate * local.fields.get("temperature", 300.0)}


MUTANTS += wrong(
    Law,
    ("only_declared_fields_are_asked_for", parts(asking)),
    ("declared_fields_have_units", {"state_fields": (Field("rubbed", "mm", "Distance slid."),)}),
    ("runs_under_implicit_stepping", parts(failing_later), RuntimeError),
)

# Contact solvers.


def answer(change):
    """Return a `solve` of which some parts of the answer are changed."""

    def solve(self, problem, start=None):
        solution = Solver.solve(self, problem, start)
        return replace(solution, **change(solution, start))

    return {"solve": solve}


def asked(change):
    """Return a `solve` of another problem than it is asked."""
    return {"solve": lambda self, problem, start=None: Solver.solve(self, change(problem), start)}


def bent(problem):
    x, y = problem.system.grid.mesh
    return replace(problem, gap=problem.gap + 2e-6 * (x / 0.36e-3) ** 2 * np.ones_like(y))


def without_swept(problem):
    wear = problem.wear
    wear = wear if wear is None else replace(wear, swept=np.zeros_like(wear.swept))
    return replace(problem, wear=wear)


MUTANTS += wrong(
    Solver,
    ("answers_fit_a_run", answer(lambda s, start: {"residuals": Residuals(0, 0.01, 0)})),
    (
        "pressure_goes_with_the_gap",
        answer(lambda s, start: {"pressure": np.roll(s.pressure, 1, axis=0)}),
    ),
    ("pressure_goes_with_the_gap", asked(bent)),
    ("wear_compliance_adds_its_depth", asked(without_swept)),
    (
        "positions_share_their_wear",
        {
            "couples": True,
            "solve_cycle": lambda self, *given: ContactSolver.solve_cycle(self, *given),
        },
    ),
    ("cap_of_each_point_is_kept", {"takes_cap_map": True}),
)

# Motions.


def exposed(**parts):
    """Return the parts of a motion whose track differs from the honest one's."""
    return {"track": type("WrongTrack", (Track,), parts)}


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


MUTANTS += wrong(
    Motion,
    ("answers_fit_a_run", exposed(swept=False)),
    ("compliance_is_the_average_of_a_linear_law", exposed(compliance=as_if_it_stayed)),
    ("answers_fit_a_run", resolved(8)),
    ("answers_fit_a_run", resolved(9, rows=30)),
    ("answers_fit_a_run", resolved(9)),
    ("answers_fit_a_run", {"check_contact": refusing}, ValueError),
    ("runs_a_case", {"time_at": at_once}),
)

# Effects.


def failing_at_first(self, contact):
    if contact.distance < 0.99:
        raise RuntimeError("too early")
    return Heating.fields(self, contact)


MUTANTS += wrong(
    Heating,
    ("declared_fields_have_units", {"provides": (Field("temperature", "", "Heat."),)}),
    ("runs_in_a_case", {"fields": failing_at_first}, RuntimeError),
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


MUTANTS += wrong(
    Slip,
    *(
        ("product_is_that_of_differences", {"pull_back": without(path)})
        for path in ("pressure", "friction", "strength")
    ),
)

# Effects that change the load.


class Spring(Effect):
    """A spring that relaxes as the bodies wear: F = F₀ − S h."""

    type = "test.spring"
    relaxes: Annotated[float, Quantity("1/m", at_least=0)] = 1e4
    """Stiffness over the first load."""

    def load_factor(self, snapshot):
        return 1 - self.relaxes * sum(b.max_wear_depth for b in snapshot.measures.bodies.values())


def pulling(self, snapshot):
    return 1.0 if snapshot.state.steps == 0 else -Spring.load_factor(self, snapshot)


def after(deed):
    """Return a `load_factor` that does a deed first."""
    return lambda self, snapshot: (deed(snapshot), Spring.load_factor(self, snapshot))[1]


def counted(self, snapshot):
    return Spring.load_factor(self, snapshot) - 1e-9 * next(NUMBERS)


def digging(snapshot):
    snapshot.state.bodies["ball"].wear[:] = 0


MUTANTS += wrong(
    Spring,
    ("runs_in_a_case", {"load_factor": pulling}),
    ("runs_in_a_case", {"load_factor": after(lambda snapshot: random.random())}),
    ("runs_in_a_case", {"load_factor": after(lambda snapshot: np.seterr(all="ignore"))}),
    ("runs_in_a_case", {"load_factor": counted}),
    ("runs_in_a_case", {"load_factor": after(digging)}, ValueError),
)

# Observers.


def counting(self, snapshot):
    self._steps += snapshot.state.steps == 0
    assert self._steps


def starting_once(self, run):
    assert not self._steps
    self._steps = 1


def needing_a_snapshot(self, snapshot, reason):
    return snapshot.state


MUTANTS += wrong(
    Counts,
    ("any_run_is_survived", {"on_finish": needing_a_snapshot}, AttributeError),
    ("any_run_is_survived", {"on_step": counting}, AssertionError),
    ("any_run_is_survived", {"on_start": starting_once}, AssertionError),
)
