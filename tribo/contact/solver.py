"""The interface of contact solvers."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

from tribo.component import Component
from tribo.core.contact import ContactProblem, ContactSolution, ContactSystem


class ContactSolver(Component):
    """Solves the normal contact of two bodies under a given load."""

    accepts_wear_compliance: ClassVar[bool] = False
    """Whether `solve` honours ``problem.wear``; without it only `explicit` stepping works."""

    honours_cap: ClassVar[bool] = False
    """Whether `solve` limits the pressure to ``problem.system.cap``."""

    periodic: ClassVar[bool] = False
    """Whether the contact repeats with the window, so that it may reach the window's edge."""

    mirrors: ClassVar[bool] = False
    """Whether a problem mirrored along x has the mirrored solution: it is not solved anew then."""

    plasticity: bool = True
    """Whether the pressure is limited to the hardness of the softer body; `system.cap` is None
    where it is not."""

    def check(self, system: ContactSystem) -> None:
        """Raise `CaseError` if this configuration cannot serve `system`."""

    @abstractmethod
    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact problem.

        Parameters
        ----------
        problem : ContactProblem
            What to solve; its arrays must not be written to.
        start : ContactSolution, optional
            A solution of a similar problem, to start from.

        Returns
        -------
        ContactSolution
            A new solution that owns its arrays; they become read-only.

        Raises
        ------
        NumericalError
            If the tolerance was not reached, with the residual.
        """

    def smallest_compliance(self, system: ContactSystem) -> float | None:
        """Return the smallest eigenvalue of K, in m/Pa, or None when unknown.

        It limits explicit steps: Δs · d(rate)/dp < 2 · smallest compliance.
        """
        return None
