"""A ball moved along a flat, cell by cell: the contact that the track average stands for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, WearCompliance
from tribo.model.model import Model


@dataclass(frozen=True)
class MovedWear:
    """What a moving contact has worn, in m: the ball, and the flat along its track.

    `contact` is the one at mid-stroke in the last pass; on a ring, the last one.
    """

    ball: Array
    flat: Array
    contact: ContactSolution


def to_and_fro(
    model: Model, ball_k: float, flat_k: float, *, stroke: int, distance: float, passes: int
) -> MovedWear:
    """Move the ball to and fro, and wear both bodies by Archard's law.

    A pass stands for many strokes, the more the longer it goes on: the path grows as the square of
    the number of passes. Every position is solved by backward Euler. Each is worn together with
    its mirror image about mid-stroke, so that half of the positions are solved and the bodies
    stay symmetrical, as many strokes leave them.

    `model` gives grid, gap, load and contact solver, and is symmetrical along x; the wear
    coefficients are in 1/Pa, the stroke in cells, the sliding distance, for which so many passes
    stand, in m.
    """
    nx, ny = model.grid.cells
    ball, flat = np.zeros((nx, ny)), np.zeros((nx + stroke, ny))
    share = np.full(stroke // 2 + 1, 1 / stroke)
    share[0] /= 2
    if stroke % 2 == 0:
        share[-1] /= 2
    last: dict[int, ContactSolution] = {}
    solution = None
    path = distance * np.linspace(0, 1, passes + 1) ** 2
    for number, length in enumerate(np.diff(path)):
        out = number % 2 == 0
        for position in range(len(share)) if out else reversed(range(len(share))):
            slid = float(length * share[position])
            rows = slice(position, position + nx)
            image = slice(stroke - position, stroke - position + nx)
            gap = model.contact.gap + ball + flat[rows]
            worn = (2 * ball_k + flat_k) * slid
            start = last.get(position, solution)
            solution = last[position] = _solve(model, gap, worn, start)
            depth = slid * solution.pressure
            ball += ball_k * (depth + depth[::-1])
            flat[rows] += flat_k * depth
            flat[image] += flat_k * depth[::-1]
    middle = last[stroke // 2]
    gap = model.contact.gap + ball + flat[stroke // 2 : stroke // 2 + nx]
    return MovedWear(ball, flat, _solve(model, gap, 0.0, middle))


def round_a_ring(
    model: Model, ball_k: float, flat_k: float, *, rows: int, distance: float, passes: int
) -> MovedWear:
    """Move the ball round a track of `rows` rows of cells that closes on itself.

    Parameters and result are those of `to_and_fro`; each pass slides as far.
    """
    nx, ny = model.grid.cells
    ball, flat = np.zeros((nx, ny)), np.zeros((rows, ny))
    slid = distance / (passes * rows)
    solution = None
    for position in range(passes * rows):
        under = (np.arange(nx) + position) % rows
        gap = model.contact.gap + ball + flat[under]
        solution = _solve(model, gap, (ball_k + flat_k) * slid, solution)
        ball += ball_k * slid * solution.pressure
        flat[under] += flat_k * slid * solution.pressure
    assert solution is not None
    return MovedWear(ball, flat, solution)


def _solve(model: Model, gap: Array, worn: float, start: ContactSolution | None) -> ContactSolution:
    nx, ny = model.grid.cells
    wear = WearCompliance(np.full((nx, ny), worn), np.zeros(ny))
    return model.case.contact.solve(
        ContactProblem(model.contact.system, gap, model.contact.system.load, wear), start
    )
