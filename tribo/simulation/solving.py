"""Ask the contact solver, and hold its answer to the contract."""

from __future__ import annotations

from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, readonly
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    Residuals,
    WearCompliance,
)
from tribo.core.errors import PluginError
from tribo.simulation.answers import field, number
from tribo.simulation.calling import calling, named

Solver = ContactSolver

LOAD_BALANCE = 1e-6
ABOVE_CAP = 1e-6


def solve(
    solver: Solver, problem: ContactProblem, start: ContactSolution | None = None
) -> ContactSolution:
    """Solve `problem`, whose arrays the solver sees as read-only.

    Raises
    ------
    PluginError
        If the answer has a field that is not finite, negative or of another
        shape, does not carry the load, or exceeds the cap.
    NumericalError
        If the solver gives up.
    """
    wear = problem.wear
    if wear is not None:
        wear = WearCompliance(readonly(wear.local), readonly(wear.swept))
    asked = ContactProblem(problem.system, readonly(problem.gap), problem.load, wear)
    with calling(solver):
        answer = solver.solve(asked, start)
    return _checked(named(solver), problem, answer)


def smallest_compliance(solver: Solver, system: ContactSystem) -> float | None:
    """Return what the solver says is the smallest eigenvalue of K, in m/Pa, if it knows it."""
    with calling(solver):
        answer = solver.smallest_compliance(system)
    return None if answer is None else number(named(solver), "a smallest compliance", answer)


def _checked(who: object, problem: ContactProblem, answer: object) -> ContactSolution:
    if not isinstance(answer, ContactSolution):
        raise PluginError(f"{who} gave a {type(answer).__name__} instead of a ContactSolution")
    grid, cap = problem.system.grid, problem.system.cap
    pressure, lowest, highest = field(who, "a pressure", answer.pressure, grid.cells)
    overlap, least, _ = field(who, "an overlap", answer.overlap, grid.cells)
    for what, low in (("pressure", lowest), ("overlap", least)):
        if low < 0:
            raise PluginError(f"{who} gave a negative {what} ({low:.3g})")
    carried = float(pressure.sum()) * grid.cell_area
    if not abs(carried - problem.load) <= LOAD_BALANCE * problem.load:
        raise PluginError(
            f"{who} gave a pressure that carries {carried:.9g} N instead of {problem.load:.9g} N"
        )
    if cap is not None and highest > cap * (1 + ABOVE_CAP):
        raise PluginError(
            f"{who} gave a pressure of {highest:.9g} Pa, above the hardness of {cap:.9g} Pa "
            "that it says it honours"
        )
    if not isinstance(answer.residuals, Residuals):
        raise PluginError(f"{who} gave a {type(answer.residuals).__name__} instead of Residuals")
    _, *claimed = (
        number(who, f"a residual of {what}", getattr(answer.residuals, what))
        for what in ("force", "complementarity", "penetration")
    )
    return ContactSolution(
        pressure=_kept(pressure),
        approach=number(who, "an approach", answer.approach),
        overlap=_kept(overlap),
        iterations=int(number(who, "a number of iterations", answer.iterations)),
        residuals=Residuals(abs(carried / problem.load - 1), *claimed),
    )


def _kept(array: Array) -> Array:
    """Return an array that the solver cannot write to later, as if it were a buffer."""
    own = array if array.base is None else array.copy()
    own.setflags(write=False)
    return own
