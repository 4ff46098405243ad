"""Partial slip out of two normal contacts, after Ciavarella and Jäger."""

from __future__ import annotations

from dataclasses import replace

from tribo import Array, ContactProblem, ContactSolver


def first_loading(
    solver: ContactSolver, problem: ContactProblem, ratio: float, friction: float, stretch: float
) -> tuple[float, Array]:
    """Return the displacement δ (m) and the traction (Pa) under a tangential force Q = ratio μP.

    With p, d the pressure and approach under P, and p′, d′ under P − Q/μ, for bodies of one
    material: q = μ (p − p′), δ = μ χ (d − d′). Exact for ν = 0 and for line contacts. The
    `stretch` χ is the tangential over the normal compliance: (2 − ν)/(2 − 2ν) for balls, else 1.

    References
    ----------
    Ciavarella, M. (1998), Int. J. Solids Struct. 35, 2349-2362. Jäger, J. (1998), Arch. Appl. Mech.
    68, 255-269.
    """
    loads = problem.load, (1 - ratio) * problem.load
    whole, stuck = (solver.solve(replace(problem, load=load)) for load in loads)
    traction = friction * (whole.pressure - stuck.pressure)
    return friction * stretch * (whole.approach - stuck.approach), traction
