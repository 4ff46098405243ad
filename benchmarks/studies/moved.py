"""A ball moved along a flat, cell by cell: the contact that the track average stands for.

It gives the values that the cases ring_average and stroke_* of `tribo verify`
expect, extrapolated in the number of passes:

    python -m benchmarks.studies.moved
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tribo import (
    Archard,
    Body,
    Case,
    ContactSolver,
    DcFft,
    Flat,
    Grid,
    Material,
    Paraboloid,
    Unidirectional,
    Winkler,
)
from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution, WearCompliance
from tribo.model.model import Model
from tribo.simulation.assembly import assemble

STEEL = Material(young=207e9, poisson=0.3)
RADIUS, LOAD, WEAR_COEFFICIENT = 5e-3, 100.0, 3.11e-16


def on_flat(
    grid: Grid,
    contact: ContactSolver,
    *,
    load: float = LOAD,
    ball_k: float = WEAR_COEFFICIENT,
    flat_k: float = WEAR_COEFFICIENT,
    track_length: float = 2e-3,
    distance: float = 1.0,
) -> Model:
    """Return the model of the paper's ball, which slides on a flat along a track."""
    ball, law = Paraboloid(radius=RADIUS), Archard
    return assemble(
        Case(
            grid=grid,
            load=load,
            bodies={
                "ball": Body(surface=ball, material=STEEL, wear=law(k=ball_k)),
                "flat": Body(surface=Flat(), material=STEEL, wear=law(k=flat_k)),
            },
            contact=contact,
            kinematics=Unidirectional(speed=0.1, track_length=track_length, distance=distance),
        )
    )


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


def extrapolated(moved: Callable[[int], MovedWear], passes: int) -> tuple[Array, Array]:
    """Return the depths of ball and flat for ever more passes, from 1, 2 and 4 times as many."""
    worn = [moved(factor * passes) for factor in (1, 2, 4)]

    def limit(first: Array, second: Array, third: Array) -> Array:
        return np.asarray((first - 6 * second + 8 * third) / 3)

    return limit(*(each.ball for each in worn)), limit(*(each.flat for each in worn))


def main() -> None:
    """Print the depths in the middle of each contact, in m."""
    k = WEAR_COEFFICIENT
    free, springs = DcFft(tolerance=1e-8), Winkler(modulus=1.2973e15)
    ring = on_flat(Grid(0.6e-3, 24), free, load=5.0)
    worn = extrapolated(lambda n: round_a_ring(ring, k, k, rows=30, distance=320.0, passes=n), 12)
    print("ring_average", *(float(np.max(np.mean(depth, axis=0))) for depth in worn))
    for name, grid, contact, stroke, distance, passes in (
        ("stroke_resolved", Grid(0.65e-3, 28), free, 24, 5.0, 48),
        ("stroke_positions", Grid((1.2e-3, 0.75e-3), (128, 12)), springs, 48, 0.2, 32),
        ("stroke_average", Grid(1.3e-3, 28), free, 43, 360.0, 48),
        ("stroke_long", Grid(0.65e-3, 28), free, 128, 4.0, 16),
    ):
        model = on_flat(grid, contact)
        ball, flat = extrapolated(
            lambda n, m=model, s=stroke, d=distance: to_and_fro(
                m, k, k, stroke=s, distance=d, passes=n
            ),
            passes,
        )
        print(name, float(np.max(ball)), float(np.max(flat[len(flat) // 2])))


if __name__ == "__main__":
    main()
