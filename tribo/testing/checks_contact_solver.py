"""What every contact solver must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.contact import ContactSolution
from tribo.testing import samples
from tribo.testing.checks_calls import Exercise, call_checks, locked
from tribo.testing.checks_config import own_scales
from tribo.testing.checks_contact_capabilities import CAPABILITY_CHECKS
from tribo.testing.compare import expect_array, expect_close
from tribo.testing.sample_contact import TOLERANCE, sample_gap, sample_problem, solved
from tribo.testing.subject import Subject, fact, require


def _inputs(subject: Subject, solver: Any, number: int) -> dict[str, Any]:
    problem = sample_problem(load=samples.LOAD * (1 + number))
    start = solved(subject, sample_problem(load=0.9 * samples.LOAD)) if number == 0 else None
    # Copies, so that they can be written to.
    return {"problem": replace(problem, gap=problem.gap.copy()), "start": start}


def _call(solver: Any, inputs: Any) -> Mapping[str, Any]:
    return {"solution": solver.solve(inputs["problem"], inputs["start"])}


EXERCISE = Exercise(_inputs, _call)


def _has_scales(subject: Subject) -> str | None:
    names = own_scales(subject.config)
    return f"its configuration has scales of its own: {', '.join(names)}" if names else None


@fact
def solutions_are_finite_arrays(subject: Subject) -> None:
    """Pressure and overlap are finite float64 arrays of the window's shape, approach a number."""
    solution = solved(subject, sample_problem())
    require(
        isinstance(solution, ContactSolution),
        f"solve gave {type(solution).__name__}, not a ContactSolution",
    )
    expect_array("pressure", solution.pressure, samples.GRID.cells)
    expect_array("overlap", solution.overlap, samples.GRID.cells)
    require(
        np.ndim(solution.approach) == 0 and np.isfinite(solution.approach),
        f"approach is {solution.approach!r}; a finite number is needed",
    )


@fact
def solutions_own_their_arrays(subject: Subject) -> None:
    """No array of a solution is one of the problem's, or of the start's."""
    start = solved(subject, sample_problem(load=0.9 * samples.LOAD))
    problem = sample_problem()
    solution = solved(subject, problem, start)
    for name in ("pressure", "overlap"):
        for what, given in (
            ("the gap", problem.gap),
            ("the start's pressure", start.pressure),
            ("the start's overlap", start.overlap),
        ):
            shared = np.shares_memory(getattr(solution, name), given)
            require(not shared, f"{name} shares memory with {what}; return a copy")


@fact
def pressure_carries_the_load(subject: Subject) -> None:
    """The pressure, summed over the cells, is the load."""
    for load in (0.5 * samples.LOAD, samples.LOAD):
        solution = solved(subject, sample_problem(load=load))
        carried = float(np.sum(solution.pressure)) * samples.GRID.cell_area
        require(
            abs(carried / load - 1) <= TOLERANCE,
            f"the pressure carries {carried:.6g} N of a load of {load:.6g} N",
        )


@fact
def contact_never_pulls(subject: Subject) -> None:
    """The pressure is nowhere negative."""
    least = float(np.min(solved(subject, sample_problem()).pressure))
    require(least >= 0, f"the pressure falls to {least:.3g} Pa; it must be at least 0")


@fact
def residuals_are_small(subject: Subject) -> None:
    """By its own residuals a solution fulfils the conditions of contact."""
    stated = solved(subject, sample_problem()).residuals
    for name in ("force", "complementarity", "penetration"):
        value = getattr(stated, name)
        require(
            0 <= value <= TOLERANCE,
            f"the {name} residual is {value:.3g}; between 0 and {TOLERANCE:g} is needed",
        )


@fact
def mirrored_gap_mirrors_the_pressure(subject: Subject) -> None:
    """The mirror image of a gap, along x or y, has the mirror image of its pressure."""
    problem = sample_problem()
    plain = solved(subject, problem).pressure
    for axis, name in enumerate("xy"):
        mirrored = solved(subject, sample_problem(gap=np.flip(problem.gap, axis).copy())).pressure
        expect_close(f"pressure mirrored along {name}", np.flip(mirrored, axis), plain, TOLERANCE)


@fact
def moved_gap_moves_the_pressure(subject: Subject) -> None:
    """A gap moved by whole cells has the same pressure, moved as far."""
    plain = solved(subject, sample_problem()).pressure
    moved = solved(subject, sample_problem(gap=sample_gap(samples.GRID, cells=(2, -3)))).pressure
    expect_close("pressure moved by (2, -3) cells", moved[4:, :-6], plain[2:-2, 3:-3], TOLERANCE)


@fact
def approach_counts_from_the_gaps_zero(subject: Subject) -> None:
    """A constant added to the gap adds to the approach and leaves the pressure as it is."""
    lift = 3e-6
    plain = solved(subject, sample_problem())
    lifted = solved(subject, sample_problem(gap=sample_gap(samples.GRID) + lift))
    expect_close("pressure on a lifted gap", lifted.pressure, plain.pressure, TOLERANCE)
    rise = lifted.approach - plain.approach
    require(
        abs(rise - lift) <= TOLERANCE * lift,
        f"with {lift:g} m added to the gap the approach grew by {rise:.6g} m",
    )


@fact(unless=_has_scales)
def scaled_contact_scales_the_pressure(subject: Subject) -> None:
    """With lengths times a and moduli times b, a load times a²b gives b times the pressure."""
    plain = solved(subject, sample_problem()).pressure
    for scale, stiffer in ((10.0, 1.0), (1.0, 0.01), (0.1, 3.0)):
        scaled = solved(subject, sample_problem(scale=scale, stiffer=stiffer)).pressure / stiffer
        what = f"pressure with lengths times {scale:g} and moduli times {stiffer:g}"
        expect_close(what, scaled, plain, TOLERANCE)


@fact
def more_load_goes_deeper(subject: Subject) -> None:
    """With the load grow approach, contact and the pressure in every cell."""
    loads = (25.0, 50.0, 100.0)
    solutions = [solved(subject, sample_problem(load=load)) for load in loads]
    for less, more, load in zip(solutions, solutions[1:], loads[1:], strict=False):
        require(
            more.approach > less.approach,
            f"at {load:g} N the approach is {more.approach:.6g} m, at half the load "
            f"{less.approach:.6g} m",
        )
        fall = float(np.max(less.pressure - more.pressure))
        require(
            fall <= TOLERANCE * float(np.max(more.pressure)),
            f"doubling the load to {load:g} N lowered the pressure by up to {fall:.3g} Pa",
        )


@fact
def warm_start_changes_nothing(subject: Subject) -> None:
    """From whatever solution it starts, a solve ends at the same one."""
    cold = solved(subject, sample_problem())
    moved = sample_problem(gap=sample_gap(samples.GRID, cells=(3, 2)), load=0.3 * samples.LOAD)
    for what, problem in (
        ("its own solution", sample_problem()),
        ("that of a heavier load", sample_problem(load=2 * samples.LOAD)),
        ("that of another place", moved),
    ):
        warm = solved(subject, sample_problem(), locked(solved(subject, problem)))
        expect_close(f"pressure from {what}", warm.pressure, cold.pressure, TOLERANCE)


CHECKS = (
    *call_checks(EXERCISE),
    solutions_are_finite_arrays,
    solutions_own_their_arrays,
    pressure_carries_the_load,
    contact_never_pulls,
    residuals_are_small,
    mirrored_gap_mirrors_the_pressure,
    moved_gap_moves_the_pressure,
    approach_counts_from_the_gaps_zero,
    scaled_contact_scales_the_pressure,
    more_load_goes_deeper,
    warm_start_changes_nothing,
    *CAPABILITY_CHECKS,
)
