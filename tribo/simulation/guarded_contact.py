"""The contact solver, held to its contract."""

from __future__ import annotations

from tribo.contact.solver import ContactSolver
from tribo.core.arrays import readonly
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    Residuals,
    WearCompliance,
)
from tribo.core.errors import BadValues
from tribo.simulation.guard import Guard

LOAD_BALANCE = 1e-6
ABOVE_CAP = 1e-6


class GuardedSolver(Guard[ContactSolver]):
    """A contact solver whose pressures carry the load and stay below the cap."""

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if the solver cannot serve `system`."""
        self.ask(self.component.check, system)

    def smallest_compliance(self, system: ContactSystem) -> float | None:
        """Return the smallest eigenvalue of K, in m/Pa, if the solver knows it."""
        answer = self.ask(self.component.smallest_compliance, system)
        return None if answer is None else self.number("a smallest compliance", answer)

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve `problem`, whose arrays the solver cannot write to.

        Raises
        ------
        BadValues
            If the answer has a field that is not finite, negative or of another
            shape, does not carry the load, or exceeds the cap.
        PluginError
            If it is not a solution at all.
        NumericalError
            If the solver gives up.
        """
        wear = problem.wear
        if wear is not None:
            wear = WearCompliance(readonly(wear.local), readonly(wear.swept))
        asked = ContactProblem(problem.system, readonly(problem.gap), problem.load, wear)
        answer = self.ask(self.component.solve, asked, start)
        if not isinstance(answer, ContactSolution):
            raise self.wrong(answer, "instead of a ContactSolution")
        if not isinstance(answer.residuals, Residuals):
            raise self.wrong(answer.residuals, "instead of Residuals")
        grid, cap = problem.system.grid, problem.system.cap
        pressure, lowest, highest = self.field("a pressure", answer.pressure, grid.cells)
        overlap, least, _ = self.field("an overlap", answer.overlap, grid.cells)
        for what, low in (("pressure", lowest), ("overlap", least)):
            if low < 0:
                raise BadValues(f"{self} gave a negative {what} ({low:.3g})")
        carried = float(pressure.sum()) * grid.cell_area
        if not abs(carried - problem.load) <= LOAD_BALANCE * problem.load:
            raise BadValues(
                f"{self} gave a pressure that carries {carried:.9g} N instead of "
                f"{problem.load:.9g} N"
            )
        if cap is not None and highest > cap * (1 + ABOVE_CAP):
            raise BadValues(
                f"{self} gave a pressure of {highest:.9g} Pa, above the hardness of {cap:.9g} Pa "
                "that it says it honours"
            )
        _, *claimed = (
            self.number(f"a residual of {what}", getattr(answer.residuals, what))
            for what in ("force", "complementarity", "penetration")
        )
        return ContactSolution(
            pressure=pressure,
            approach=self.number("an approach", answer.approach),
            overlap=overlap,
            iterations=int(self.number("a number of iterations", answer.iterations)),
            residuals=Residuals(abs(carried / problem.load - 1), *claimed),
        )
