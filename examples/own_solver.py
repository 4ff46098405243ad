"""A contact solver of one's own: half-spaces with a thin, soft coating.

The largest pressure without and with the coating, before and after wear. Takes some seconds::

    python examples/own_solver.py
"""

from typing import Annotated

from tribo import (
    Array,
    Case,
    ContactProblem,
    ContactSolution,
    ContactSolver,
    HalfSpace,
    Quantity,
    solve_bounded,
)


class CoatedHalfSpace:
    """The operator u = K p + c p, with K the half-space and c the compliance of the coating."""

    def __init__(self, base: HalfSpace, compliance: float) -> None:
        self.base, self.compliance = base, compliance
        self.shape, self.spacing = base.shape, base.spacing

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under a pressure, in m."""
        return self.base.apply(pressure) + self.compliance * pressure

    def symbol(self) -> Array:
        """Return estimates of the eigenvalues, in m/Pa, which precondition the solver."""
        return self.base.symbol() + self.compliance


class Coated(ContactSolver):
    """u = K p + c p, where the coating is thin beside the contact and much softer than its base."""

    type = "own.coated"
    examples = ({}, {"compliance": "0.1 um/GPa"})
    accepts_wear_compliance = True
    honours_cap = True
    compliance: Annotated[float, Quantity("m/Pa", at_least=0)] = 0.0
    """Depth by which the coating gives way per pressure."""

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve one contact problem, from the pressure of another if there is one."""
        grid, modulus = problem.system.grid, problem.system.modulus
        operator = CoatedHalfSpace(HalfSpace(grid.cells, grid.spacing, modulus), self.compliance)
        first = None if start is None else start.pressure
        cap = problem.system.cap
        return solve_bounded(operator, problem.gap, problem.load, cap, problem.wear, start=first)


if __name__ == "__main__":
    steel = {"young": "207 GPa", "poisson": 0.3}
    archard = {"type": "archard", "k": 1e-15}
    sphere = {"type": "sphere", "radius": "5 mm"}
    case = Case(
        grid={"size": "0.6 mm", "cells": 40},
        load="20 N",
        bodies={
            "pin": {"surface": sphere, "material": steel, "wear": archard},
            "disk": {"surface": "flat", "material": steel},
        },
        kinematics={"type": "unidirectional", "speed": 0.1, "distance": 6, "track_length": 0.02},
    )
    for compliance in ("0 um/GPa", "0.5 um/GPa"):
        with case.with_values({"contact": Coated(compliance=compliance)}).run() as result:
            first, last = (1e-6 * result.pressure[i].max().item() for i in (0, -1))
        print(f"{compliance}: largest pressure {first:.0f} MPa at first, {last:.0f} MPa after 6 m")
