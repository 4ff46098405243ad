"""Wrong implementations: each breaks one promise, which its check must notice."""

import random
from dataclasses import replace
from itertools import count
from typing import Annotated

import numpy as np
import pytest
from pydantic import (
    ConfigDict,
    PrivateAttr,
    ValidationError,
    field_validator,
    model_serializer,
)
from testing.conformance.honest import Counts, Hill, Law, Motion, Solver, Traction

from tribo import Field, Grid, NumericalError, Quantity, Residuals, Stationary, Track
from tribo.core.errors import PluginError
from tribo.testing.compare import CheckFailed

MUTANTS = []


def wrong(check, name, honest, *, raising=CheckFailed, **parts):
    """Note a class that differs from an honest one by some parts, and the check it must fail."""
    made = type(name, (honest,), {"__module__": __name__, **parts})
    MUTANTS.append(pytest.param(check, made, raising, id=f"{name}-{check}"))
    return made


# The configuration, by the example of a wear law.

wrong("objects_are_frozen_and_know_their_keys", "Thawed", Law, model_config={"frozen": False})
wrong("objects_are_frozen_and_know_their_keys", "Lax", Law, model_config={"extra": "ignore"})
wrong("name_has_a_prefix", "WithoutPrefix", Law, type="law")
wrong("facts_are_text_and_stay", "StatesNumbers", Law, facts=lambda self: {"size": 1.24e-3})
wrong(
    "facts_are_text_and_stay",
    "StatesAnotherEachTime",
    Law,
    _number=PrivateAttr(default_factory=count().__next__),
    facts=lambda self: {"number": str(self._number)},
)


class WithoutUnit(Law):
    q: float = 3.0
    """Something."""


class Undescribed(Law):
    q: Annotated[float, Quantity("1")] = 3.0
    # Reads no docstring of the field above it.
    model_config = ConfigDict(use_attribute_docstrings=False)


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


class OfAnotherName(Law):
    @model_serializer(mode="wrap")
    def _of_another_name(self, handler):
        return {**handler(self), "type": "other.name"}


def _local():
    class Unreachable(Law):
        """A class that no other process can find."""

    return Unreachable


wrong("quantities_have_units", "WithoutUnits", WithoutUnit)
wrong("fields_are_described", "Silent", Undescribed)
wrong("configuration_survives_a_file", "Millimetres", MillimetresEachTime)
wrong("configuration_survives_a_file", "AnotherDefault", AnotherWithoutDefaults)
wrong("configuration_survives_a_file", "AnotherName", OfAnotherName, raising=ValidationError)
wrong("configuration_can_be_pickled", "Unreachable", _local())

# Calls that are not pure.


def rate(change):
    """Return a `rate` that differs from the honest law's by `change` of it and its conditions."""
    return lambda self, local: change(Law.rate(self, local), local)


def zeroed(rate, local):
    if local.pressure.flags.writeable:
        local.pressure[0] = 0
    return rate


def clipped(rate, local):
    np.clip(local.pressure, 0, None, out=local.pressure)
    return rate


def remembering(self, local):
    self._slid += 0.1
    rate = Law.rate(self, local)
    return replace(rate, depth_rate=rate.depth_rate * np.exp(-self._slid))


def cached(self, grid):
    if self._cache is None or self._cache.shape != grid.cells:
        self._cache = Hill.height(self, grid)
    return self._cache


wrong("inputs_stay_as_they_are", "WritesToItsInput", Law, rate=rate(zeroed))
wrong("read_only_inputs_are_accepted", "NeedsWritableInput", Law, rate=rate(clipped))
wrong("same_inputs_give_same_bits", "Remembers", Law, _slid=0.0, rate=remembering)
wrong("answers_may_be_overwritten", "GivesItsCacheAway", Hill, _cache=None, height=cached)
wrong("nothing_is_printed", "Chatters", Law, rate=rate(lambda r, local: print("rate") or r))
wrong(
    "no_global_random_numbers",
    "DrawsFromNumpy",
    Hill,
    height=lambda self, grid: Hill.height(self, grid) + 0 * np.random.rand(),  # noqa: NPY002
)
wrong(
    "no_global_random_numbers",
    "DrawsFromPython",
    Traction,
    fields=lambda self, contact: random.random() and Traction.fields(self, contact),
)

# Wear laws.


def law(check, name, change, **more):
    """Note a law whose rate is changed: `change` of rate and conditions gives other parts of it."""
    wrong(check, name, Law, rate=rate(lambda r, local: replace(r, **change(r, local))), **more)


def divided(rate, local):
    with np.errstate(invalid="ignore"):
        return {"depth_slope": local.pressure / local.pressure}


def falling(rate, local):
    fall = np.where(local.pressure > 1e9, 1e9 / np.maximum(local.pressure, 1.0), 1.0)
    return {"depth_rate": rate.depth_rate * fall**4}


def averaged(rate, local):
    mean = np.mean(rate.depth_rate, axis=0, keepdims=True)
    return {"depth_rate": np.where(local.pressure > 0, mean, 0.0)}


def failing_later(rate, local):
    if local.pressure.shape == (24, 20) and local.state["rubbed"].max() > 0:
        raise RuntimeError("too far")
    return {}


law("rates_are_finite_arrays", "ScalarDerivative", lambda r, local: {"depth_slope": 1e-16})
law(
    "rates_are_finite_arrays",
    "SinglePrecision",
    lambda r, local: {"depth_rate": r.depth_rate.astype(np.float32)},
)
law("rates_are_finite_arrays", "DividesByZero", divided)
law(
    "nothing_wears_without_pressure",
    "WearsByItself",
    lambda r, local: {"depth_rate": r.depth_rate + 1e-12},
)
law(
    "wear_only_removes",
    "Grows",
    lambda r, local: {"depth_rate": -r.depth_rate, "depth_slope": -r.depth_slope},
)
law(
    "derivative_is_that_of_the_depth",
    "SecantAsDerivative",
    lambda r, local: {"depth_slope": r.depth_rate / np.maximum(local.pressure, 1.0)},
)
law("depth_grows_with_pressure", "FallsUnseen", falling)
law(
    "points_are_independent",
    "Normalised",
    lambda r, local: {"depth_rate": r.depth_rate * np.mean(local.pressure) / 1e9},
)
law("points_are_independent", "AveragesItself", averaged)
law(
    "only_declared_fields_are_asked_for",
    "AsksForMore",
    lambda r, local: {"depth_rate": r.depth_rate * local.fields.get("temperature", 300.0)},
)
law("every_state_field_has_a_rate", "ForgetsItsState", lambda r, local: {"state_rates": {}})
wrong(
    "state_fields_are_declared",
    "StateInMillimetres",
    Law,
    state_fields=(Field("rubbed", "mm", "Distance slid under pressure."),),
)
law("runs_under_implicit_stepping", "FailsLaterOn", failing_later, raising=PluginError)

# Contact solvers.


def answer(change):
    """Return a `solve` of which some parts of the answer are changed."""

    def solve(self, problem, start=None):
        solution = Solver.solve(self, problem, start)
        return replace(solution, **change(solution, problem, start))

    return solve


def asked(change):
    """Return a `solve` of another problem than it is asked."""
    return lambda self, problem, start=None: Solver.solve(self, change(problem), start)


def of_system(change):
    return asked(lambda p: replace(p, system=replace(p.system, **change(p.system))))


def bent(problem):
    x, y = problem.system.grid.mesh
    return replace(problem, gap=problem.gap + 2e-6 * (x / 0.36e-3) ** 2 * np.ones_like(y))


def without_swept(problem):
    wear = problem.wear
    wear = wear if wear is None else replace(wear, swept=np.zeros_like(wear.swept))
    return replace(problem, wear=wear)


def cut_off(self, problem, start=None):
    elastic = replace(problem, system=replace(problem.system, cap=None))
    solution = Solver.solve(self, elastic, start)
    cap = problem.system.cap or np.inf
    return replace(solution, pressure=np.minimum(solution.pressure, cap))


SOLVES = [
    ("solutions_are_finite_arrays", answer(lambda s, p, start: {"pressure": s.pressure.ravel()})),
    (
        "solutions_own_their_arrays",
        answer(lambda s, p, start: {} if start is None else {"overlap": start.overlap}),
    ),
    ("pressure_carries_the_load", answer(lambda s, p, start: {"pressure": 0.9 * s.pressure})),
    (
        "contact_never_pulls",
        answer(lambda s, p, start: {"pressure": np.where(s.pressure == 0, -1.0, s.pressure)}),
    ),
    ("residuals_are_small", answer(lambda s, p, start: {"residuals": Residuals(0, 0.01, 0)})),
    (
        "mirrored_gap_mirrors_the_pressure",
        answer(lambda s, p, start: {"pressure": np.roll(s.pressure, 1, axis=0)}),
    ),
    ("moved_gap_moves_the_pressure", asked(bent)),
    ("approach_counts_from_the_gaps_zero", asked(lambda p: replace(p, gap=p.gap - p.gap.min()))),
    ("scaled_contact_scales_the_pressure", of_system(lambda system: {"modulus": 1.1e11})),
    ("more_load_goes_deeper", asked(lambda p: replace(p, load=p.system.load))),
    (
        "warm_start_changes_nothing",
        lambda self, p, start=None: Solver.solve(self, p) if start is None else replace(start),
    ),
    ("wear_compliance_adds_its_depth", asked(lambda p: replace(p, wear=None))),
    ("wear_compliance_adds_its_depth", asked(without_swept)),
    ("pressure_stays_below_the_cap", cut_off),
    ("cap_out_of_reach_does_nothing", of_system(lambda s: {"cap": s.cap and 0.4 * s.cap})),
]
for number, (check, solve) in enumerate(SOLVES):
    wrong(check, f"Solves{number}", Solver, solve=solve)
wrong(
    "no_mode_is_stiffer_than_stated",
    "LongestWave",
    Solver,
    smallest_compliance=lambda self, system: 2 * Solver.smallest_compliance(self, system),
)

# Motions.


def exposed(**parts):
    """Return the parts of a motion whose track differs from the honest one's."""
    return {"track": type("WrongTrack", (Track,), parts)}


def at_once(self, distance):
    return Motion.time_at(self, distance) if distance == 0 or distance > 2.9 else 0.0


def refusing(self, half_width_x):
    raise ValueError("no")


MOTIONS = [
    ("motion_ends", {"end_time": property(lambda self: np.inf)}),
    ("path_begins_at_zero", {"distance_at": lambda self, t: Motion.distance_at(self, t) + 1e-3}),
    ("path_never_shrinks", {"distance_at": lambda self, t: abs(np.sin(t)) + t / 2}),
    ("time_inverts_distance", {"time_at": lambda self, s: 2 * Motion.time_at(self, s)}),
    (
        "cycles_add_up",
        {
            "distance_at": lambda self, t: np.sqrt(1 + t) - 1,
            "time_at": lambda self, s: (s + 1) ** 2 - 1,
        },
    ),
    ("speeds_share_the_path", {"speeds": lambda self: [(0.05, 0.5), (0.07, 0.4)]}),
    ("speeds_share_the_path", {"speeds": lambda self: [(0.03, 0.5), (0.04, 0.5)]}),
    ("speeds_share_the_path", {"speeds": lambda self: [(-0.1, 0.5), (0.3, 0.5)]}),
    (
        "every_body_is_exposed",
        {"exposures": lambda self, grid, bodies: {bodies[1]: Track(grid, self.stroke)}},
    ),
    (
        "body_fields_fit_the_window",
        exposed(average=lambda self, rate: Track.average(self, rate)[0]),
    ),
    (
        "worn_volume_is_conserved",
        exposed(average=lambda self, rate: np.mean(rate, axis=0, keepdims=True)),
    ),
    ("what_passes_is_swept", exposed(swept=False)),
    (
        "averages_are_linear",
        exposed(average=lambda self, rate: np.sqrt(Track.average(self, rate**2))),
    ),
    (
        "finer_window_averages_the_same",
        exposed(average=lambda self, rate: Track.average(self, rate) * rate.shape[0] / 24),
    ),
    ("envelope_covers_the_field", exposed(envelope=Track.average)),
    (
        "compliance_is_the_average_of_a_linear_law",
        exposed(
            compliance=lambda self, derivative, pressure: Stationary(
                Grid((1.0, 1.0), derivative.shape)
            ).compliance(derivative, pressure)
        ),
    ),
    ("limitation_is_said_in_words", {"limitation": lambda self, *track: 7}),
]
for number, (check, parts) in enumerate(MOTIONS):
    wrong(check, f"Moves{number}", Motion, **parts)
wrong("absurd_contacts_are_refused", "Refuses", Motion, check_contact=refusing, raising=ValueError)
wrong("runs_a_case", "StandsStill", Motion, time_at=at_once, raising=NumericalError)
wrong(
    "runs_a_case",
    "MeanOverTheWindow",
    Motion,
    raising=NumericalError,
    **exposed(average=lambda self, rate: np.mean(rate, axis=0, keepdims=True)),
)

# Surfaces.


def corners(self, grid):
    x, y = (np.arange(n) * d for n, d in zip(grid.cells, grid.spacing, strict=True))
    return -0.5 / self.radius * (x[:, None] ** 2 + 0.5 * y[None, :] ** 2)


def filling(self, grid):
    x, y = grid.mesh
    return -1e-5 * ((x / grid.size[0]) ** 2 + (y / grid.size[1]) ** 2)


wrong("heights_are_finite_arrays", "SwapsAxes", Hill, height=lambda self, g: Hill.height(self, g).T)
wrong("finer_cells_sample_the_same_surface", "SamplesCorners", Hill, height=corners)
wrong("smaller_window_sees_the_same_surface", "FillsTheWindow", Hill, height=filling)
InwardHeight = wrong(
    "curvature_is_that_of_the_heights",
    "InwardHeight",
    Hill,
    height=lambda self, grid: -Hill.height(self, grid),
)
wrong(
    "curvature_is_that_of_the_heights",
    "RadiusAsCurvature",
    Hill,
    curvature=property(lambda self: (self.radius, 2 * self.radius)),
)

# Effects.


def effect(change):
    """Return `fields` of which the values by body are changed."""
    return lambda self, contact: {"traction": change(Traction.fields(self, contact)["traction"])}


def failing_at_first(self, contact):
    if contact.distance < 0.99:
        raise RuntimeError("too early")
    return Traction.fields(self, contact)


wrong(
    "provided_fields_are_declared",
    "WithoutUnitsOfFields",
    Traction,
    provides=(Field("traction", "", "Friction force per area."),),
)
wrong(
    "every_declared_field_is_answered",
    "OneBodyOnly",
    Traction,
    fields=effect(lambda values: dict([next(iter(values.items()))])),
)
wrong(
    "every_declared_field_is_answered",
    "NotFinite",
    Traction,
    fields=effect(lambda values: {name: np.log(-v - 1) for name, v in values.items()}),
)
wrong(
    "bodies_may_have_any_names",
    "KnowsTheBall",
    Traction,
    fields=effect(lambda values: {n: 0.1 * v if n == "ball" else v for n, v in values.items()}),
)
wrong("only_declared_fields_are_asked_for", "RequiresNothing", Traction, requires=())
wrong("runs_in_a_case", "FailsLater", Traction, fields=failing_at_first, raising=PluginError)

# Observers.


def polishing(self, snapshot):
    # Round the view, which is read-only.
    wear = snapshot.state.bodies["ball"].wear.base
    if wear is not None and wear.flags.writeable:
        wear *= 0.99


def writing(self, snapshot):
    snapshot.state.contact.pressure[0, 0] = 1.0


def counting(self, snapshot):
    self._steps += snapshot.state.steps == 0
    assert self._steps


def starting_once(self, run):
    assert not self._steps
    self._steps = 1


wrong("watching_changes_no_bit", "Polishes", Counts, on_step=polishing)
wrong("inputs_stay_as_they_are", "WritesToSnapshots", Counts, on_step=writing)
wrong(
    "every_end_is_survived",
    "NeedsASnapshot",
    Counts,
    on_finish=lambda self, snapshot, reason: snapshot.state,
    raising=AttributeError,
)
wrong("resumed_run_is_survived", "NeedsTheStart", Counts, on_step=counting, raising=AssertionError)
wrong("second_run_is_survived", "RunsOnce", Counts, on_start=starting_once, raising=AssertionError)
