"""The interface of contact solvers."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Sequence
from typing import Any, ClassVar

from tribo.component import Component
from tribo.contact.operator import Operator
from tribo.core.arrays import Mask
from tribo.core.box import Box
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    CycleCompliance,
)


class ContactSolver(Component):
    """Solves the normal contact of two bodies under a given load.

    Examples
    --------
    >>> class Elastic(tribo.ContactSolver):
    ...     def solve(self, problem, start=None):
    ...         grid, modulus = problem.system.grid, problem.system.modulus
    ...         half_space = tribo.HalfSpace(grid.cells, grid.spacing, modulus)
    ...         return tribo.solve_bounded(half_space, problem.gap, problem.load)
    >>> grid = tribo.Grid("0.4 mm", 32)
    >>> system = tribo.ContactSystem(grid, modulus=115e9, load=10.0)
    >>> gap = -tribo.Sphere(radius="5 mm").height(grid)
    >>> contact = Elastic().solve(tribo.ContactProblem(system, gap, load=10.0))
    >>> round(float(contact.pressure.max()) / 1e9, 1)  # GPa, as Hertz's
    1.0
    """

    accepts_wear_compliance: ClassVar[bool] = False
    """Whether `solve` honours ``problem.wear``; without it only `explicit` stepping works."""

    honours_cap: ClassVar[bool] = False
    """Whether `solve` limits the pressure to ``problem.system.cap``."""

    takes_coatings: ClassVar[bool] = False
    """Whether `solve` honours ``problem.system.coatings``, the elastic layers on the bodies."""

    takes_cap_map: ClassVar[bool] = False
    """Whether `solve` limits the pressure to ``problem.cap`` where that is given."""

    periodic: ClassVar[bool] = False
    """Whether the contact repeats with the window, so that it may reach the window's edge."""

    couples: ClassVar[bool] = False
    """Whether `solve_cycle` takes the wear that couples the positions of a cycle; if not, a step
    iterates over it in passes."""

    def __init_subclass__(cls, **named: Any) -> None:
        """Take the positions one by one where a subclass solves a contact of its own."""
        super().__init_subclass__(**named)
        one, several = (
            next(n for n, base in enumerate(cls.__mro__) if name in vars(base))
            for name in ("solve", "solve_cycle")
        )
        if one < several:
            cls.couples = False
            cls.solve_cycle = ContactSolver.solve_cycle  # type: ignore[method-assign]

    plasticity: bool = True
    """Whether the pressure is limited to the hardness of the softer body; `system.cap` is None
    where it is not."""

    @property
    def layer_thickness(self) -> float:
        """Thickness of the elastic layer that wears, in m; infinite for half-spaces."""
        return math.inf

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

    def solve_cycle(
        self,
        problems: Sequence[ContactProblem],
        starts: Sequence[ContactSolution],
        coupling: CycleCompliance | None = None,
    ) -> list[ContactSolution]:
        """Solve the contact at each position of a cycle.

        Parameters
        ----------
        problems : sequence of ContactProblem
            By position; without wear of their own where `coupling` is given.
        starts : sequence of ContactSolution
            A solution of a similar problem to start from, by position.
        coupling : CycleCompliance, optional
            Wear of the step that these solves are part of; given only where `couples`.

        Returns
        -------
        list of ContactSolution
            By position, as of `solve`.
        """
        return [self.solve(problem, start) for problem, start in zip(problems, starts, strict=True)]

    def smallest_compliance(self, system: ContactSystem) -> float | None:
        """Return the smallest eigenvalue of K, in m/Pa, or None when unknown.

        Explicit steps need it: Δs · d(rate)/dp < 2 · smallest compliance.
        """
        return None

    def operator(self, system: ContactSystem, touching: Mask) -> tuple[Box, Operator] | None:
        """Return K on a box with all touching cells of the window, or None when unknown.

        Gradients need it: with the cells in contact known, their pressure follows from K alone.
        `touching` marks the cells with pressure, shape (nx, ny).
        """
        return None
