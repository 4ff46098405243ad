"""What contact solvers must fulfil that declare a capability."""

from __future__ import annotations

import numpy as np

from tribo.core.contact import WearCompliance
from tribo.testing import samples
from tribo.testing.compare import expect_close
from tribo.testing.sample_contact import TOLERANCE, sample_gap, sample_problem, solved
from tribo.testing.subject import Subject, fact, require


def _takes_no_wear(subject: Subject) -> str | None:
    return None if subject.make().accepts_wear_compliance else "accepts_wear_compliance is False"


def _ignores_cap(subject: Subject) -> str | None:
    solver = subject.make()
    if not solver.honours_cap:
        return "honours_cap is False"
    return None if solver.plasticity else "its configuration has plasticity = false"


def _states_no_compliance(subject: Subject) -> str | None:
    known = subject.make().smallest_compliance(sample_problem().system) is not None
    return None if known else "smallest_compliance is None"


@fact(unless=_takes_no_wear)
def wear_compliance_adds_its_depth(subject: Subject) -> None:
    """A wear compliance acts as its depth in the gap would, on either kind of body."""
    plain = solved(subject, sample_problem())
    soft = 0.5 * abs(plain.approach) / float(np.max(plain.pressure))
    shape, dx = samples.GRID.cells, samples.GRID.spacing[0]
    local = soft * (0.5 + samples.pattern(shape))
    swept = soft / samples.GRID.size[0] * (0.5 + samples.pattern((shape[1],)))
    for what, wear in (
        ("a local", WearCompliance(local, np.zeros(shape[1]))),
        ("a swept", WearCompliance(np.zeros(shape), swept)),
        ("a local and a swept", WearCompliance(local, swept)),
    ):
        worn = solved(subject, sample_problem(wear=wear))
        gap = sample_gap(samples.GRID) + wear.depth(worn.pressure, dx)
        again = solved(subject, sample_problem(gap=gap))
        what = f"pressure under {what} compliance, and that with its depth in the gap"
        expect_close(what, worn.pressure, again.pressure, 10 * TOLERANCE)


@fact(unless=_ignores_cap)
def pressure_stays_below_the_cap(subject: Subject) -> None:
    """The cap limits the pressure, the load is carried, and overlap is where the cap acts."""
    elastic = solved(subject, sample_problem())
    cap = 0.6 * float(np.max(elastic.pressure))
    solution = solved(subject, sample_problem(cap=cap))
    most = float(np.max(solution.pressure))
    require(most <= cap * (1 + 1e-12), f"the pressure is {most:.6g} Pa under a cap of {cap:.6g} Pa")
    carried = float(np.sum(solution.pressure)) * samples.GRID.cell_area
    require(
        abs(carried / samples.LOAD - 1) <= TOLERANCE,
        f"under the cap the pressure carries {carried:.6g} N of {samples.LOAD:g} N",
    )
    require(np.min(solution.overlap) >= 0, "the overlap is negative somewhere")
    require(np.max(solution.overlap) > 0, "nothing overlaps although the cap acts")
    below = solution.pressure < cap * (1 - TOLERANCE)
    require(not np.any(solution.overlap[below]), "there is overlap where the cap does not act")


@fact(unless=_ignores_cap)
def cap_out_of_reach_does_nothing(subject: Subject) -> None:
    """A cap above the elastic pressure changes nothing, and nothing overlaps."""
    elastic = solved(subject, sample_problem())
    solution = solved(subject, sample_problem(cap=2 * float(np.max(elastic.pressure))))
    expect_close("pressure under a high cap", solution.pressure, elastic.pressure, TOLERANCE)
    require(not np.any(solution.overlap), "there is overlap although the cap is not reached")


@fact(unless=_states_no_compliance)
def no_mode_is_stiffer_than_stated(subject: Subject) -> None:
    """The smallest compliance is positive, and no more than the contact shows to a chequerboard."""
    problem = sample_problem()
    stated = subject.make().smallest_compliance(problem.system)
    require(stated > 0, f"smallest_compliance is {stated:.3g} m/Pa; it must be positive")
    plain = solved(subject, problem)
    core = plain.pressure > 0.3 * np.max(plain.pressure)
    signs = (-1.0) ** np.add.outer(*map(np.arange, samples.GRID.cells))
    change = np.where(core, 1e-4 * abs(plain.approach) * signs, 0.0)
    other = solved(subject, sample_problem(gap=problem.gap + change))
    both = (plain.pressure > 0) & (other.pressure > 0)
    response = np.where(both, other.pressure - plain.pressure, 0.0)
    # Where both touch, K (p2 - p1) is the change of the approach less that of the gap.
    work = float(np.sum(response * (other.approach - plain.approach - change)))
    shown = work / float(np.sum(response**2))
    require(
        stated <= 1.02 * shown,
        f"smallest_compliance is {stated:.4g} m/Pa, but the contact answers a chequerboard in "
        f"the gap with {shown:.4g} m/Pa: explicit steps would be allowed too long",
    )


CAPABILITY_CHECKS = (
    wear_compliance_adds_its_depth,
    pressure_stays_below_the_cap,
    cap_out_of_reach_does_nothing,
    no_mode_is_stiffer_than_stated,
)
