"""The average over a track against a contact that is moved along it, cell by cell."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from tribo.contact.dcfft import DcFft
from tribo.core.grid import Grid
from tribo.core.measures import half_widths
from tribo.core.state import State
from tribo.motion.averaging import groove_excess
from tribo.simulation.model import Model
from tribo.verification.moving import round_a_ring, to_and_fro
from tribo.verification.problems import BALL, WEAR_COEFFICIENT, on_flat, run_to_end
from tribo.verification.reference import Row, norm, reference

K = WEAR_COEFFICIENT
PATH = 360.0

RING_GRID = Grid((0.6e-3, 0.6e-3), (24, 24))
RING = 30
# Light, so that the groove of 2 µm is 3.6 times as deep as the elastic approach.
RING_LOAD, RING_PATH = 5.0, 320.0

STROKE_GRID = Grid((1.3e-3, 1.3e-3), (28, 28))


def _model(grid: Grid, rows: int, load: float, path: float) -> Model:
    length = rows * grid.spacing[0]
    contact = DcFft(tolerance=1e-6)
    return on_flat(BALL, grid, contact, load=load, flat_k=K, track_length=length, distance=path)


@lru_cache
def _ring_average() -> tuple[Model, State]:
    model = _model(RING_GRID, RING, RING_LOAD, RING_PATH)
    return model, run_to_end(model)


@reference(
    "track average against 8, 16, 32 passes of a ring, groove of 3.6 approaches",
    "every cell of every pass is solved",
    *(8, 16, 32),
)
def _ring(passes: int, placement: float) -> list[Row]:
    model, averaged = _ring_average()
    worn = round_a_ring(model, K, K, rows=RING, distance=RING_PATH, passes=passes)
    ball, flat = (averaged.bodies[name].wear for name in ("ball", "flat"))
    by_pass, by_steps = "order in the wear of a pass", "error of both steppings, 1e-4"
    return [
        norm("depth of the ball", worn.ball, ball, 1e-2, 1.0, by_pass),
        norm("depth of the flat", np.mean(worn.flat, axis=0), flat[0], 1e-3, note=by_steps),
    ]


def _hour(stroke: float, passes: int) -> tuple[float, float]:
    """Return by how much the average's groove is too deep, and what a run says of that."""
    rows = round(stroke / STROKE_GRID.spacing[0])
    model = _model(STROKE_GRID, rows, 100.0, PATH)
    averaged = run_to_end(model)
    moved = to_and_fro(model, K, K, stroke=rows, distance=PATH, passes=passes)
    middle = (len(moved.flat) - 1) // 2, len(moved.flat) // 2
    groove = float(np.max(averaged.bodies["flat"].wear))
    resolved = float(np.max(np.mean(moved.flat[list(middle)], axis=0)))
    half_width = half_widths(averaged.contact, STROKE_GRID)[0]
    told = groove_excess(
        rows * STROKE_GRID.spacing[0], half_width, groove, averaged.reference_depth
    )
    return groove / resolved - 1, told


@reference(
    "stroke average, the paper's hour, against a contact moved to and fro",
    "every cell of a pass is solved; two other codes",
    32,
)
def _strokes(passes: int, placement: float) -> list[Row]:
    two, _ = _hour(2e-3, passes)
    codes, fitted = "two other codes: 17.4 and 18 %", "the statement is a fit to many runs"
    return [
        Row("excess depth of the groove, stroke of 2 mm", "1", 0.177, two, 4.5e-2, note=codes),
        *(
            Row(
                f"excess depth, {stroke} mm, as a run states it",
                "1",
                *_hour(1e-3 * stroke, passes),
                0.1,
                note=fitted,
            )
            for stroke in (3, 5)
        ),
    ]
