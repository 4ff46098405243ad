"""Conjugate gradients on discs: the traction |q| ≤ μp of a contact that is dragged along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from tribo import Array, NumericalError

from tribo_fretting.cerruti import Cerruti

ON_RIM = 1e-12
"""Relative distance from its rim within which a traction is on it: thousands of roundings."""
MOST = 500
"""Iterations; a ball on 128² cells takes 43 at most, with two components of traction."""
TOLERANCE = 1e-9
"""What slip within discs and along rims falls to, over δ: a millionth of a step's tolerance."""


@dataclass(frozen=True)
class Drag:
    """A contact that was dragged along x from a traction of 0.

    By a displacement of what drags it, in m, to a traction in Pa, shape (components, nx, ny).
    Points have slipped by `slip` (nx, ny), in m: 0 where they stick.
    """

    displacement: float
    traction: Array
    slip: Array
    iterations: int


def dragged(operator: Cerruti, displacement: float, limit: Array) -> Drag:
    """Minimise ½ qᵀA q − δ Σ qₓ over |q| ≤ μp in each cell.

    The gradient is the slip δ − A q reversed: it is 0 within the disc, and points outward on its
    rim. Preconditioned conjugate gradients move the cells within their discs, from μp along x on;
    on a rim the cells move along it alone. There its curvature adds λ/(μp) to the stiffness, with
    the slip λ: without that the tractions of two components do not converge.

    A is the `operator`, δ the positive `displacement` (m), μp the `limit` (Pa), shape (nx, ny), 0
    beyond the contact. NumericalError after `MOST` iterations.
    """
    drive = np.zeros((operator.components, 1, 1))
    drive[0] = displacement
    pressed = limit > 0
    safe = np.where(pressed, limit, 1.0)
    q = np.zeros((operator.components, *limit.shape))
    q[0] = limit
    moved = operator.apply(q)
    direction = before = np.zeros_like(q)
    decrease = 1.0
    for iteration in range(MOST + 1):
        slip = drive - moved
        normal = q / safe
        outward = np.sum(slip * normal, axis=0)
        sliding = pressed & (np.linalg.norm(q, axis=0) >= limit * (1 - ON_RIM)) & (outward > 0)
        normal *= sliding
        residual = pressed * slip - outward * normal
        error = float(np.max(np.abs(residual)))
        if error <= TOLERANCE * displacement:
            return Drag(displacement, q, np.where(sliding, outward, 0.0), iteration)
        curved = np.where(sliding, outward / safe, 0.0)
        scale = pressed / np.sqrt(1 + curved / operator.typical)
        z = tangent(scale * operator.preconditioned(scale * residual), normal)
        beta = max(0.0, float(np.sum(z * (residual - before))) / decrease)
        direction = z + beta * tangent(direction, normal)
        decrease, before = float(np.sum(residual * z)), residual
        response = operator.apply(direction)
        stiffness = np.sum(direction * (response + curved * direction))
        length = float(np.sum(residual * direction) / stiffness)
        ahead = q + length * direction
        q = _on_discs(ahead, limit)
        # Where no cell left its disc the displacement is known.
        moved = moved + length * response if np.array_equal(q, ahead) else operator.apply(q)
    raise NumericalError(
        f"partial slip did not converge in {MOST} iterations: slip is off by "
        f"{error / displacement:.1e} of the displacement, allowed are {TOLERANCE:.1e}"
    )


def tangent(vectors: Array, normal: Array) -> Array:
    """Return vectors without their normal part, all (components, nx, ny)."""
    return np.asarray(vectors - np.sum(vectors * normal, axis=0) * normal)


def _on_discs(traction: Array, limit: Array) -> Array:
    length = np.linalg.norm(traction, axis=0)
    beyond = length > limit
    return np.asarray(traction * np.where(beyond, limit / np.where(beyond, length, 1.0), 1.0))
