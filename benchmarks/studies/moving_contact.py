"""What the average over a stroke costs: depths by it over those of a ball moved cell by cell.

The page on the paper shows the figures. They come from a run of some minutes:

    python -m benchmarks.studies.moving_contact --json docs/_data/moving_contact.json
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.optimize import brentq

from benchmarks.lib.common import Row, Tables, main
from benchmarks.studies.moved import LOAD, RADIUS, WEAR_COEFFICIENT, on_flat, to_and_fro
from examples.ball_on_track import ball_on_track
from tribo.contact.dcfft import DcFft
from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution
from tribo.core.grid import Grid
from tribo.core.measures import centre, half_widths
from tribo.lab.scar import crown
from tribo.simulation.march import march
from tribo.stepping.first_contact import first_contact

K = WEAR_COEFFICIENT
STROKE = 2e-3
PATH = 360.0
WINDOW = 1.35e-3
SPLIT = 7.08e-15, 7.08e-16
SPLIT_WINDOW = 2.7e-3
# Where a is 0.25 mm the groove of strokes and loads is compared.
HALF_WIDTH = 0.25e-3
APPROACH = 4.4e-6
"""Hertz's for the load of the paper."""
HERTZ = 148.8e-6

WIDTHS = (4, 6, 10, 20)
SHORT = (3, 2, 1, 0.25)


def compared(
    grid: Grid, stroke: int, ball_k: float, flat_k: float, load: float, path: float, passes: int
) -> Row:
    """Wear by the average and by the moving contact; compare them."""
    length = stroke * grid.spacing[0]
    model = on_flat(
        grid,
        DcFft(tolerance=1e-7),
        load=load,
        ball_k=ball_k,
        flat_k=flat_k,
        track_length=length,
        distance=path,
    )
    state = first_contact(model)
    for accepted in march(model, state):
        state = accepted.state
    average = state.bodies["flat"].wear
    moved = to_and_fro(model, ball_k, flat_k, stroke=stroke, distance=path, passes=passes)
    rows = len(moved.flat)
    middle = np.mean(moved.flat[(rows - 1) // 2 : rows // 2 + 1], axis=0)
    half_width = half_widths(state.contact, grid)[0]
    deep = float(np.max(average))
    return {
        "stroke_mm": 1e3 * length,
        "half_widths": length / half_width,
        "groove_average_um": 1e6 * deep,
        "groove_resolved_um": 1e6 * float(np.max(middle)),
        "too_deep_percent": 100 * (deep / float(np.max(middle)) - 1),
        "groove_over_approach": deep / state.reference_depth,
        **_contact("average", state.contact, state.bodies["ball"].wear, model.contact.gap, grid),
        **_contact("resolved", moved.contact, moved.ball, model.contact.gap, grid),
    }


def _contact(name: str, contact: ContactSolution, worn: Array, gap: Array, grid: Grid) -> Row:
    nx = grid.cells[0]
    across = slice((nx - 1) // 2, nx // 2 + 1)
    shape = -np.mean(gap[across], axis=0) - np.mean(worn[across], axis=0)
    return {
        f"ball_{name}_um": 1e6 * centre(worn),
        f"crown_{name}_um": 1e6 * crown(shape, np.mean(worn[across], axis=0)),
        f"along_{name}_mm": 2e3 * half_widths(contact, grid)[0],
        f"centre_{name}_MPa": 1e-6 * centre(contact.pressure),
    }


def papers(cells: int, passes: int) -> Iterator[Row]:
    """Yield the paper's hour, and that with the weighed losses."""
    for case, window, (ball_k, flat_k) in (
        ("equal coefficients", WINDOW, (K, K)),
        ("weighed losses", SPLIT_WINDOW, SPLIT),
    ):
        grid = Grid((window, window), (cells, cells))
        stroke = round(STROKE / grid.spacing[0])
        yield {"case": case, **compared(grid, stroke, ball_k, flat_k, LOAD, PATH, passes)}


def grooves(cells: int, passes: int) -> Iterator[Row]:
    """Yield strokes and depths of groove; `cells` is that of a half-width."""
    dx = HALF_WIDTH / cells
    for ratio in (1.0, 10.0):
        for widths in WIDTHS:
            q = 2 * ratio / (widths * HALF_WIDTH)
            across = np.sqrt(HALF_WIDTH**2 + 2 / 3 * q * HALF_WIDTH**3)
            groove = q * HALF_WIDTH**3 / (3 * RADIUS)
            many = 2 * int(np.ceil(1.3 * across / dx))
            grid = Grid((many * dx, many * dx), (many, many))
            for over in (1, 2, 5):
                load = LOAD * (groove / (over * APPROACH)) ** 1.5
                given: dict[str, Any] = {
                    "load": load,
                    "radius": RADIUS,
                    "track_length": widths * HALF_WIDTH,
                    "ball_wear_coefficient": K,
                    "flat_wear_coefficient": ratio * K,
                }
                path = brentq(
                    lambda s, given=given: (
                        ball_on_track(s, **given).half_width_along[0] - HALF_WIDTH
                    ),
                    1e-6,
                    1e12,
                )
                row = compared(grid, widths * cells, K, ratio * K, load, path, passes)
                yield {
                    "flat_over_ball": ratio,
                    "deep": over,
                    "asked_half_widths": widths,
                    **row,
                }


def unworn_ball(cells: int, passes: int) -> Iterator[Row]:
    """Yield strokes and depths of groove of a ball that does not wear, under the paper's load.

    `cells` is that of Hertz's half-width.
    """
    dx = HERTZ / cells
    for widths in WIDTHS:
        stroke = widths * cells
        for over in (1, 2, 5):
            groove = over * APPROACH
            half_chord = np.sqrt(2 * RADIUS * groove)
            many = 2 * int(np.ceil(1.2 * max(half_chord, HERTZ) / dx))
            grid = Grid((many * dx, many * dx), (many, many))
            path = 4 / 3 * half_chord * groove * stroke * dx / (K * LOAD)
            row = compared(grid, stroke, 0.0, K, LOAD, path, passes)
            yield {"deep": over, "asked_half_widths": widths, **row}


def short_strokes(cells: int, passes: int) -> Iterator[Row]:
    """Yield strokes shorter than 4 half-widths, worn little; `cells` is that of a half-width."""
    dx = HERTZ / cells
    many = 4 * cells
    grid = Grid((many * dx, many * dx), (many, many))
    for widths in SHORT:
        row = compared(grid, max(1, round(widths * cells)), K, K, LOAD, 0.3, passes)
        yield {"asked_half_widths": widths, **row}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add grids and passes."""
    parser.add_argument("--cells", type=int, default=48, help="of the paper's window, a side")
    parser.add_argument("--half-width", type=int, default=8, help="cells of a half-width")
    parser.add_argument(
        "--passes", type=int, default=50, help="four times as many for the paper's hour"
    )


def measure(options: argparse.Namespace) -> Tables:
    """Return a table for each kind of stroke."""
    return {
        "paper": list(papers(options.cells, 4 * options.passes)),
        "grooves": list(grooves(options.half_width, options.passes)),
        "ball that does not wear": list(unworn_ball(options.half_width, options.passes)),
        "short strokes, worn little": list(short_strokes(options.half_width, options.passes)),
    }


if __name__ == "__main__":
    main(__doc__, add_options, measure)
