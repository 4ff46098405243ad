"""The vector-Jacobian product of a first loading: one linear solve, two where a force is held."""

from __future__ import annotations

from functools import partial
from math import pi

import numpy as np
from tribo import Array, ContactConditions, Mask, NumericalError

from tribo_fretting.cerruti import Cerruti, cerruti, tangential_compliances
from tribo_fretting.drive import Drive
from tribo_fretting.projected_cg import MOST, Drag, tangent

TOLERANCE = 1e-12
"""Residual of the linear solve, relative to its right side."""


def pulled_back(
    drive: Drive, contact: ContactConditions, limit: Array, drag: Drag, by: Array
) -> tuple[Array, dict[str, float]]:
    """Return derivatives in μp and in numbers, by path, from derivatives in slip and traction.

    `by` has the latter in this order, shape (1 + components, nx, ny).
    With n the direction of the slip s, points that stick keep d(δ − A q) = 0; points that slip have
    ds = n d(δ − A q), and dq = n d(μp) + w with w along the rim. Which points stick adds nothing:
    where that changes s = 0 and |q| = μp, and both hold. For derivatives ŝ and q̂ the adjoint is
    v = n ŝ + w, with A v + λ/(μp) w = q̂ wherever q may move. The derivative in δ is Σ vₓ, in μp it
    is n (q̂ − A v), and −v q in A.
    """
    grid, materials = contact.grid, contact.materials
    operator = partial(cerruti, grid.cells, grid.spacing, components=drive.components)
    rig = drive.rig(grid)
    a = operator(tangential_compliances(materials.values()), rig=rig)
    q, pressed = drag.traction[: drive.components], limit > 0
    force, pull = float(np.sum(q[0])), np.zeros_like(by)
    pull[1] = 1.0
    safe = np.where(pressed, limit, 1.0)
    normal = np.where(drag.slip > 0, q / safe, 0.0)

    def adjoint(by: Array) -> Array:
        direct: Array = by[0] * normal
        return direct + _response(a, by[1:] - a.apply(direct), pressed, normal, drag.slip / safe)

    v, numbers = adjoint(by), dict[str, float]()
    if drag.displacement < drive.amplitude_at(contact.time):
        # The force is held, not the amplitude.
        of_force = adjoint(pull)
        by_force = float(np.sum(v[0]) / np.sum(of_force[0]))
        v, by = v - by_force * of_force, by - by_force * pull
        numbers["force_amplitude"] = by_force / grid.cell_area
    numbers["amplitude"] = float(np.sum(v[0]))
    if drive.stiffness:
        numbers["stiffness"] = numbers["amplitude"] * rig * force / drive.stiffness
    units = (1.0, 0.0), (0.0, 1.0)
    by_whole, by_less = (-float(np.sum(v * operator(unit).apply(q))) for unit in units)
    for name, of in materials.items():
        by_shear = (1 + of.poisson) * (by_whole + of.poisson * by_less)
        numbers[f"system.materials.{name}.young"] = -by_shear / (pi * of.young**2)
        by_poisson = by_whole + (1 + 2 * of.poisson) * by_less
        numbers[f"system.materials.{name}.poisson"] = by_poisson / (pi * of.young)
    return np.sum(normal * (by[1:] - a.apply(v)), axis=0), numbers


def _response(operator: Cerruti, slip: Array, free: Mask, normal: Array, curved: Array) -> Array:
    """Return w with P (A w + λ/(μp) w) = P slip, by conjugate gradients.

    P lets `free` cells move along the rim where they have a `normal`, and as they like elsewhere.
    """
    scale = free / np.sqrt(1 + curved / operator.typical)
    residual = tangent(free * slip, normal)
    found, direction = np.zeros_like(residual), np.zeros_like(residual)
    least, before = TOLERANCE * float(np.max(np.abs(slip))), 1.0
    for _ in range(MOST):
        if np.max(np.abs(residual)) <= least:
            return found
        z = tangent(scale * operator.preconditioned(scale * residual), normal)
        now = float(np.sum(residual * z))
        direction = z + now / before * direction
        moved = tangent(free * operator.apply(direction) + curved * direction, normal)
        length, before = now / float(np.sum(direction * moved)), now
        found += length * direction
        residual -= length * moved
    raise NumericalError(f"the gradient of partial slip took over {MOST} iterations")
