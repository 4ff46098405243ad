"""Deliberately wrong implementations, each with the check that must catch it."""

import random
from dataclasses import replace
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import ConfigDict, field_validator
from testing.conformance.honest import (
    Counts,
    Hill,
    Law,
    LawConfig,
    Motion,
    Solver,
    Traction,
)

from tribo.plugin import Field, Grid, NumericalError, Quantity, Residuals, Stationary, Track
from tribo.testing.subject import CheckFailed

MUTANTS: list[tuple[str, type[Any], type[Exception]]] = []


def caught_by(check: str, raising: type[Exception] = CheckFailed):
    def add(mutant):
        MUTANTS.append((check, mutant, raising))
        return mutant

    return add


def changed(rate, **values):
    return replace(rate, **values)


# Configurations, by the example of a wear law.


@caught_by("config_is_frozen")
class Thawed(Law):
    class Config(LawConfig):
        model_config = ConfigDict(frozen=False)


@caught_by("unknown_keys_are_refused")
class TakesAnything(Law):
    class Config(LawConfig):
        model_config = ConfigDict(extra="ignore")


@caught_by("quantities_have_units")
class WithoutUnit(Law):
    class Config(LawConfig):
        q: float = 3.0
        """Something."""


@caught_by("fields_are_described")
class Undescribed(Law):
    class Config(LawConfig):
        q: Annotated[float, Quantity("1")] = 3.0


@caught_by("config_survives_json")
class MillimetresEachTime(Law):
    class Config(LawConfig):
        q: Annotated[float, Quantity("m")] = 3.0
        """A length in mm."""

        @field_validator("q")
        @classmethod
        def _to_metres(cls, value):
            return 1e-3 * value


@caught_by("config_survives_without_defaults")
class DefaultsWithoutNeed(Law):
    class Config(LawConfig):
        q: Annotated[float, Quantity("1")] | None = None
        """Where it is left out it is not what its default says."""

        def model_post_init(self, context):
            if "q" not in self.model_fields_set:
                object.__setattr__(self, "q", 1.0)

        def model_dump(self, *, exclude_defaults=False, **options):
            dumped = super().model_dump(exclude_defaults=exclude_defaults, **options)
            return {**dumped, "q": None} if exclude_defaults else dumped


@caught_by("a_case_can_name_it")
class OfAnotherName(Law):
    class Config(LawConfig):
        type: Literal["other.law", "other.name"] = "other.law"

        def model_post_init(self, context):
            object.__setattr__(self, "type", "other.name")


@caught_by("name_has_a_prefix")
class WithoutPrefix(Law):
    class Config(LawConfig):
        type: Literal["law"] = "law"


def _local():
    class Config(LawConfig):
        """A class that no other process can find."""

    return Config


@caught_by("config_reaches_a_new_process")
class Unreachable(Law):
    Config = _local()


# Calls.


@caught_by("inputs_stay_as_they_are")
class WritesToItsInput(Law):
    def rate(self, local):
        if local.pressure.flags.writeable:
            local.pressure[0] = 0
        return super().rate(local)


@caught_by("read_only_inputs_are_accepted")
class NeedsWritableInput(Law):
    def rate(self, local):
        np.clip(local.pressure, 0, None, out=local.pressure)
        return super().rate(local)


@caught_by("same_inputs_give_same_bits")
class Remembers(Law):
    slid = 0.0

    def rate(self, local):
        self.slid += 0.1
        rate = super().rate(local)
        return changed(rate, depth=rate.depth * np.exp(-self.slid))


@caught_by("answers_may_be_overwritten")
class GivesItsCacheAway(Hill):
    cache = None

    def height(self, grid):
        if self.cache is None or self.cache.shape != grid.cells:
            self.cache = super().height(grid)
        return self.cache


@caught_by("nothing_is_printed")
class Chatters(Law):
    def rate(self, local):
        print("rate")
        return super().rate(local)


@caught_by("no_global_random_numbers")
class DrawsFromNumpy(Hill):
    def height(self, grid):
        np.random.default_rng()
        return super().height(grid) + 0 * np.random.rand()  # noqa: NPY002


@caught_by("no_global_random_numbers")
class DrawsFromPython(Traction):
    def fields(self, contact):
        random.random()
        return super().fields(contact)


# Wear laws.


@caught_by("rates_are_finite_arrays")
class ScalarDerivative(Law):
    def rate(self, local):
        return changed(super().rate(local), derivative=1e-16)


@caught_by("rates_are_finite_arrays")
class SinglePrecision(Law):
    def rate(self, local):
        rate = super().rate(local)
        return changed(rate, depth=rate.depth.astype(np.float32))


@caught_by("rates_are_finite_arrays")
class DividesByZero(Law):
    def rate(self, local):
        with np.errstate(invalid="ignore"):
            return changed(super().rate(local), derivative=local.pressure / local.pressure)


@caught_by("nothing_wears_without_pressure")
class WearsByItself(Law):
    def rate(self, local):
        rate = super().rate(local)
        return changed(rate, depth=rate.depth + 1e-12)


@caught_by("wear_only_removes")
class Grows(Law):
    def rate(self, local):
        rate = super().rate(local)
        return changed(rate, depth=-rate.depth, derivative=-rate.derivative)


@caught_by("derivative_is_that_of_the_depth")
class SecantAsDerivative(Law):
    def rate(self, local):
        rate = super().rate(local)
        touching = np.where(local.pressure > 0, local.pressure, 1.0)
        return changed(rate, derivative=rate.depth / touching)


@caught_by("depth_grows_with_pressure")
class FallsUnseen(Law):
    def rate(self, local):
        rate = super().rate(local)
        fall = np.where(local.pressure > 1e9, 1e9 / np.maximum(local.pressure, 1.0), 1.0)
        return changed(rate, depth=rate.depth * fall**4)


@caught_by("points_are_independent")
class Normalised(Law):
    def rate(self, local):
        rate = super().rate(local)
        return changed(rate, depth=rate.depth * np.mean(local.pressure) / 1e9)


@caught_by("points_are_independent")
class AveragesItself(Law):
    def rate(self, local):
        rate = super().rate(local)
        mean = np.mean(rate.depth, axis=0, keepdims=True)
        return changed(rate, depth=np.where(local.pressure > 0, mean, 0.0))


@caught_by("only_declared_fields_are_asked_for")
class AsksForMore(Law):
    def rate(self, local):
        warm = local.fields.get("temperature", 300.0)
        rate = super().rate(local)
        return changed(rate, depth=rate.depth * (warm / 300))


@caught_by("every_state_field_has_a_rate")
class ForgetsItsState(Law):
    def rate(self, local):
        return changed(super().rate(local), state={})


@caught_by("state_fields_are_declared")
class StateInMillimetres(Law):
    state_fields = (Field("rubbed", "mm", "Distance slid under pressure."),)


@caught_by("runs_under_implicit_stepping", RuntimeError)
class FailsLaterOn(Law):
    def rate(self, local):
        if local.pressure.shape == (24, 20) and local.state["rubbed"].max() > 0:
            raise RuntimeError("too far")
        return super().rate(local)


# Contact solvers.


def spoiled(solution, **values):
    return replace(solution, **values)


@caught_by("solutions_are_finite_arrays")
class FlatPressure(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        return spoiled(solution, pressure=solution.pressure.ravel())


@caught_by("solutions_own_their_arrays")
class ReturnsTheStart(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        return solution if start is None else spoiled(solution, overlap=start.overlap)


@caught_by("pressure_carries_the_load")
class ForgetsCellArea(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        dx, dy = problem.system.grid.spacing
        return spoiled(solution, pressure=solution.pressure * dx / dy)


@caught_by("contact_never_pulls")
class Sticks(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        p = solution.pressure.copy()
        p[p == 0] = -1.0
        return spoiled(solution, pressure=p)


@caught_by("residuals_are_small")
class StopsEarly(Solver):
    def solve(self, problem, start=None):
        return spoiled(super().solve(problem, start), residuals=Residuals(0.0, 0.01, 0.0))


@caught_by("mirrored_gap_mirrors_the_pressure")
class OffByOneCell(Solver):
    def solve(self, problem, start=None):
        solution = super().solve(problem, start)
        return spoiled(solution, pressure=np.roll(solution.pressure, 1, axis=0))


@caught_by("moved_gap_moves_the_pressure")
class SofterAtTheEdge(Solver):
    def solve(self, problem, start=None):
        x, y = problem.system.grid.mesh
        edge = 2e-6 * (x / 0.36e-3) ** 2 * np.ones_like(y)
        return super().solve(replace(problem, gap=problem.gap + edge), start)


@caught_by("approach_counts_from_the_gaps_zero")
class ShiftsTheGap(Solver):
    def solve(self, problem, start=None):
        lowest = np.min(problem.gap)
        return super().solve(replace(problem, gap=problem.gap - lowest), start)


@caught_by("scaled_contact_scales_the_pressure")
class FixedModulus(Solver):
    def solve(self, problem, start=None):
        system = replace(problem.system, modulus=1.1e11)
        return super().solve(replace(problem, system=system), start)


@caught_by("more_load_goes_deeper")
class IgnoresTheLoad(Solver):
    def solve(self, problem, start=None):
        return super().solve(replace(problem, load=problem.system.load), start)


@caught_by("warm_start_changes_nothing")
class TrustsTheStart(Solver):
    def solve(self, problem, start=None):
        return super().solve(problem) if start is None else spoiled(start)


@caught_by("wear_compliance_adds_its_depth")
class IgnoresWear(Solver):
    def solve(self, problem, start=None):
        return super().solve(replace(problem, wear=None), start)


@caught_by("wear_compliance_adds_its_depth")
class ForgetsTheSweptBody(Solver):
    def solve(self, problem, start=None):
        if problem.wear is None:
            return super().solve(problem, start)
        wear = replace(problem.wear, swept=np.zeros_like(problem.wear.swept))
        return super().solve(replace(problem, wear=wear), start)


@caught_by("pressure_stays_below_the_cap")
class CutsOff(Solver):
    def solve(self, problem, start=None):
        system = replace(problem.system, cap=None)
        solution = super().solve(replace(problem, system=system), start)
        cap = problem.system.cap or np.inf
        return spoiled(solution, pressure=np.minimum(solution.pressure, cap))


@caught_by("cap_out_of_reach_does_nothing")
class YieldsTooEarly(Solver):
    def solve(self, problem, start=None):
        if problem.system.cap is None:
            return super().solve(problem, start)
        system = replace(problem.system, cap=0.4 * problem.system.cap)
        return super().solve(replace(problem, system=system), start)


@caught_by("no_mode_is_stiffer_than_stated")
class LongestWave(Solver):
    def smallest_compliance(self, system):
        return 2 * super().smallest_compliance(system)


# Motions.


@caught_by("motion_ends")
class Endless(Motion):
    @property
    def duration(self):
        return np.inf


@caught_by("path_begins_at_zero")
class RunsIn(Motion):
    def distance(self, time):
        return super().distance(time) + 1e-3


@caught_by("path_never_shrinks")
class PositionAsPath(Motion):
    def distance(self, time):
        return abs(np.sin(time)) + time / 2


@caught_by("time_inverts_distance")
class CountsHalfCycles(Motion):
    def time(self, distance):
        return 2 * super().time(distance)


@caught_by("cycles_add_up")
class SlowsDown(Motion):
    def distance(self, time):
        return np.sqrt(1 + time) - 1

    def time(self, distance):
        return (distance + 1) ** 2 - 1


@caught_by("every_body_is_exposed")
class ForgetsABody(Motion):
    def exposures(self, grid, bodies):
        return {bodies[1]: Track(grid, self.config.stroke)}


@caught_by("body_fields_fit_the_window")
class DropsAnAxis(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return super().average(rate)[0]


@caught_by("worn_volume_is_conserved")
@caught_by("runs_a_case")
class MeanOverTheWindow(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return np.mean(rate, axis=0, keepdims=True)


@caught_by("averages_are_linear")
class MeanSquare(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return np.sqrt(super().average(rate**2))


@caught_by("finer_window_averages_the_same")
class CountsCells(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return super().average(rate) * rate.shape[0] / 24


@caught_by("envelope_covers_the_field")
class AverageAsEnvelope(Motion):
    class track(Track):  # noqa: N801
        def envelope(self, field):
            return self.average(field)


@caught_by("compliance_is_the_average_of_a_linear_law")
class SweptAsLocal(Motion):
    class track(Track):  # noqa: N801
        def compliance(self, derivative, pressure):
            return Stationary(Grid((1.0, 1.0), derivative.shape)).compliance(derivative, pressure)


@caught_by("limitation_is_said_in_words")
class SaysYes(Motion):
    def limitation(self, grid, half_width_x):
        return half_width_x > 1e-3


@caught_by("runs_a_case", NumericalError)
class StandsStill(Motion):
    def time(self, distance):
        return super().time(distance) if distance == 0 or distance > 2.9 else 0.0


# Surfaces.


@caught_by("heights_are_finite_arrays")
class SwapsAxes(Hill):
    def height(self, grid):
        return super().height(grid).T


@caught_by("finer_cells_sample_the_same_surface")
class SamplesCorners(Hill):
    def height(self, grid):
        x, y = (np.arange(n) * d for n, d in zip(grid.cells, grid.spacing, strict=True))
        return -0.5 / self.config.radius * (x[:, None] ** 2 + 0.5 * y[None, :] ** 2)


@caught_by("smaller_window_sees_the_same_surface")
class FillsTheWindow(Hill):
    def height(self, grid):
        x, y = grid.mesh
        return -1e-5 * ((x / grid.size[0]) ** 2 + (y / grid.size[1]) ** 2)


@caught_by("curvature_is_that_of_the_heights")
class InwardHeight(Hill):
    def height(self, grid):
        return -super().height(grid)


@caught_by("curvature_is_that_of_the_heights")
class RadiusAsCurvature(Hill):
    @property
    def curvature(self):
        return self.config.radius, 2 * self.config.radius


# Effects.


@caught_by("provided_fields_are_declared")
class WithoutUnits(Traction):
    provides = (Field("traction", "", "Friction force per area."),)


@caught_by("every_declared_field_is_answered")
class OneBodyOnly(Traction):
    def fields(self, contact):
        answers = super().fields(contact)
        first = next(iter(contact.materials))
        return {"traction": {first: answers["traction"][first]}}


@caught_by("every_declared_field_is_answered")
class NotFinite(Traction):
    def fields(self, contact):
        answers = super().fields(contact)
        return {"traction": {name: np.log(-v - 1) for name, v in answers["traction"].items()}}


@caught_by("bodies_may_have_any_names")
class KnowsTheBall(Traction):
    def fields(self, contact):
        values = super().fields(contact)["traction"]
        return {"traction": {n: 0.1 * v if n == "ball" else v for n, v in values.items()}}


@caught_by("only_declared_fields_are_asked_for")
class RequiresNothing(Traction):
    requires = ()


@caught_by("inputs_stay_as_they_are")
class HeatsTheContact(Traction):
    def fields(self, contact):
        if contact.pressure.flags.writeable:
            contact.pressure[:] *= 1.1
        return super().fields(contact)


@caught_by("runs_in_a_case", RuntimeError)
class FailsLater(Traction):
    def fields(self, contact):
        if contact.distance < 0.99:
            raise RuntimeError("too early")
        return super().fields(contact)


# Observers.


@caught_by("watching_changes_no_bit")
class Polishes(Counts):
    def on_step(self, snapshot):
        wear = snapshot.state.bodies["ball"].wear
        if wear.flags.writeable:
            wear *= 0.99


@caught_by("inputs_stay_as_they_are")
class WritesToSnapshots(Counts):
    def on_step(self, snapshot):
        snapshot.state.contact.pressure[0, 0] = 1.0


@caught_by("every_end_is_survived", AttributeError)
class NeedsASnapshot(Counts):
    def on_finish(self, snapshot, reason):
        self.depth = snapshot.state.bodies["ball"].wear.max()


@caught_by("resumed_run_is_survived", AssertionError)
class NeedsTheFirstStep(Counts):
    first = None

    def on_step(self, snapshot):
        if snapshot.state.steps == 0:
            self.first = snapshot
        assert self.first is not None


@caught_by("second_run_is_survived", AssertionError)
class RunsOnce(Counts):
    started = False

    def on_start(self, run):
        assert not self.started
        self.started = True


@caught_by("nothing_is_printed")
class PrintsTheTime(Counts):
    def on_step(self, snapshot):
        print(snapshot.state.time)
