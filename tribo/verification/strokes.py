"""The average over a track against a contact that is moved along it, cell by cell."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactProblem, ContactSolution
from tribo.core.grid import Grid
from tribo.simulation.model import Model
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import ball, half_space, norm, on_flat, slide

GRID = Grid((0.6e-3, 0.6e-3), (24, 24))
RING = 30
# Wear coefficient times distance, in m/Pa, on both bodies: some 5 µm off the ball.
WORN = 5e-15
AVERAGED_STEPS = 300


def _model(track_length: float, distance: float) -> Model:
    k = WORN / distance
    return on_flat(ball(), GRID, half_space(1e-7), ball_k=k, flat_k=k, track_length=track_length)


@lru_cache
def _averaged(track_length: float) -> tuple[Array, Array]:
    """Return the depths of the ball, and of the flat across the track."""
    _, state = slide(_model(track_length, 1.0), 1.0, AVERAGED_STEPS, explicit=True)
    return state.bodies["ball"].wear, state.bodies["flat"].wear[0]


def _moved(
    model: Model, positions: Iterable[int], track: int, step_wear: float
) -> tuple[Array, Array]:
    """Move the ball along `track` rows of a flat that closes on itself; return both depths."""
    nx, ny = model.grid.cells
    worn_ball, worn_flat = np.zeros((nx, ny)), np.zeros((track, ny))
    solution: ContactSolution | None = None
    for position in positions:
        rows = (np.arange(nx) + position) % track
        gap = model.gap + worn_ball + worn_flat[rows]
        solution = model.contact.solve(ContactProblem(model.system, gap, model.load), solution)
        depth = step_wear * solution.pressure
        worn_ball += depth
        worn_flat[rows] += depth
    return worn_ball, worn_flat


def _ring(passes: int, placement: float) -> Found:
    dx = GRID.spacing[0]
    length = RING * dx
    model = _model(length, passes * length)
    positions = range(passes * RING)
    worn_ball, worn_flat = _moved(model, positions, RING, WORN / (passes * RING))
    ball_average, flat_average = _averaged(length)
    return {
        "depth of the ball": norm(worn_ball, ball_average),
        "depth of the flat": norm(np.mean(worn_flat, axis=0), flat_average),
    }


def _reciprocating(stroke: int, placement: float) -> Found:
    strokes = 8
    length = stroke * GRID.spacing[0]
    model = _model(length, strokes * length)
    there = range(stroke)
    back = range(stroke, 0, -1)
    positions = [position for i in range(strokes) for position in (back if i % 2 else there)]
    # Long enough never to close on itself.
    track = stroke + GRID.cells[0]
    worn_ball, worn_flat = _moved(model, positions, track, WORN / len(positions))
    ball_average, flat_average = _averaged(length)
    middle = np.mean(worn_flat[track // 2 - 1 : track // 2 + 1], axis=0)
    return {
        "depth of the ball": norm(worn_ball, ball_average),
        "depth of the flat at mid-stroke": norm(middle, flat_average),
        "largest depth there, by the average": (float(middle.max()), float(flat_average.max())),
    }


SOURCE = "brute force: every cell of every pass is solved"
# Where the groove runs out it shapes the ball too.
ENDS = "ends of the stroke: 4 % at 4 half-widths, falling as the stroke squared"
CHECKS = (
    Check(
        "track average against 8, 16, 32 passes of a ring",
        SOURCE,
        _ring,
        (
            Quantity("depth of the ball", "1", 5e-3, 1.0, "order in the wear of a pass"),
            Quantity("depth of the flat", "1", 1e-3, note="error of both steppings, 1e-4"),
        ),
        levels=(8, 16, 32),
        cost=6.0,
    ),
    Check(
        "track average against 8 strokes of 4, 6, 8 half-widths",
        SOURCE,
        _reciprocating,
        (
            Quantity("depth of the ball", "1", 2e-2, note=ENDS),
            Quantity("depth of the flat at mid-stroke", "1", 2e-2, note=ENDS),
            Quantity("largest depth there, by the average", "m", 2e-2, note=ENDS),
        ),
        levels=(38, 57, 76),
        cost=6.0,
    ),
)
