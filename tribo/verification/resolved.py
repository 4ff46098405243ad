"""A cycle resolved into positions, against a moved contact, finer steps and the average."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from tribo.contact.dcfft import DcFft
from tribo.contact.solver import ContactSolver
from tribo.contact.winkler import Winkler
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.state import State
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.assembly import assemble, varied
from tribo.simulation.model import Model
from tribo.stepping.implicit import Implicit
from tribo.stepping.step import first_contact
from tribo.verification.moving import to_and_fro
from tribo.verification.problems import BALL, SPEED, WEAR_COEFFICIENT, on_flat, run_to_end
from tribo.verification.reference import Row, norm, reference

K = WEAR_COEFFICIENT
SHORT, PATH = 24, 5.0
"""Stroke in cells, three half-widths of the first contact, and what is slid over it, in m."""
LONG = 128
"""Stroke in cells: 20 half-widths."""
GRID = Grid((0.65e-3, 0.65e-3), (28, 28))
FINE = Implicit(depth_tolerance=1e-4, pressure_tolerance=2e-2, cycle_tolerance=1e-5)
SPRINGS = Winkler(modulus=1.2973e15)


def _model(
    stroke: int,
    positions: int | Literal["cells", "average"],
    path: float,
    *,
    grid: Grid = GRID,
    contact: ContactSolver | None = None,
    stepping: Implicit = FINE,
) -> Model:
    """Return the paper's ball on a flat, moved to and fro over a stroke of so many cells."""
    contact = contact or DcFft(tolerance=1e-8)
    model = on_flat(BALL, grid, contact, flat_k=K, distance=path)
    length = stroke * grid.spacing[0]
    kinematics = Reciprocating(
        stroke=length, frequency=0.5 * SPEED / length, distance=path, positions=positions
    )
    return assemble(varied(model.case, kinematics=kinematics, stepping=stepping))


def _worn(state: State) -> tuple[Array, Array]:
    return state.bodies["ball"].wear, state.bodies["flat"].wear


@lru_cache
def _every_cell() -> State:
    return run_to_end(_model(SHORT, "cells", PATH))


@reference(
    "resolved stroke of 3 half-widths against 4, 8, 16 passes of a moved contact",
    "every cell of every pass is solved",
    *(4, 8, 16),
)
def _against_passes(passes: int, placement: float) -> list[Row]:
    ball, flat = _worn(_every_cell())
    still = _model(SHORT, "average", PATH)
    moved = to_and_fro(still, K, K, stroke=SHORT, distance=PATH, passes=passes)
    words = "order in the wear of a pass"
    return [
        norm("depth of the ball", moved.ball, ball, 1e-2, 1.0, words),
        norm("depth of the flat", moved.flat, flat, 1e-2, 1.0, words),
    ]


@lru_cache
def _spaced(intervals: int) -> Array:
    grid = Grid((1.2e-3, 0.75e-3), (128, 12))
    model = _model(48, intervals + 1, 2.0, grid=grid, contact=SPRINGS, stepping=Implicit())
    return _worn(run_to_end(model))[0]


@reference(
    "spacing of the positions, a stroke of 3 half-widths",
    "48 intervals, every cell of the stroke",
    *(8, 12, 16),
)
def _intervals(intervals: int, placement: float) -> list[Row]:
    return [norm("depth of the ball", _spaced(intervals), _spaced(48), 5e-4, 2.0)]


@lru_cache
def _in_steps(steps: int) -> Array:
    model = _model(SHORT, 7, PATH, stepping=Implicit(cycle_tolerance=1e-7))
    state = first_contact(model)
    for step in range(1, steps + 1):
        state = model.stepping.step(model, state, PATH / steps, PATH / SPEED * step / steps)
    return _worn(state)[0]


@reference("steps of a resolved stroke", "64 steps", *(2, 4, 8))
def _steps(steps: int, placement: float) -> list[Row]:
    return [norm("depth of the ball", _in_steps(steps), _in_steps(64), 2e-2, 1.0)]


@reference("resolved stroke of 20 half-widths", "its limit, the average over the stroke", 65)
def _long_stroke(positions: int, placement: float) -> list[Row]:
    depths = []
    for taken in (positions, "average"):
        flat = _worn(run_to_end(_model(LONG, taken, 4.0, stepping=Implicit())))[1]
        depths.append(float(np.max(flat[len(flat) // 2])))
    note = "0.05 % is what the average costs"
    return [Row("depth of the groove at mid-stroke", "m", depths[1], depths[0], 3e-3, note=note)]
