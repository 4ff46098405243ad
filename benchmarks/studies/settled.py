"""Two rough bodies that slide over each other: the roughness at which the one that wears settles.

The patch loses particles (`roughening.detachment`), the plate is rough and hard, or with `--both`
loses particles too. The README of
tribo-roughening, which must be installed, states the figures. About an hour on one core on 256²
cells, and five on 512²:

    python -m benchmarks.studies.settled --json docs/_data/settled.json
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from tribo_topography.roughness import parameters

from benchmarks.lib.common import Row, Tables, main
from tribo import Simulation

sys.path.append(str(Path(__file__).parents[2] / "plugins/tribo-roughening/examples"))
STARTS = (100e-9, 20e-9)
"""Sq of the patch before it wears, in m."""
LOOSE = 1e-5
"""Tolerance of a contact; with the default of 1e-8 Sa is the same to four digits."""


def patch(cells: int, sq: float, particles: int, layers: int, both: bool) -> Iterator[Row]:
    """Yield the roughness of the patch, every half of a layer of particles that it has worn."""
    from rough_on_rough import rough_on_rough

    data = rough_on_rough(sq, both, cells=cells, particles=particles, layers=layers)
    data["contact"]["tolerance"] = LOOSE
    with Simulation(data).run() as result:
        for save in range(len(result.times)):
            found = parameters(result.body("patch").surface(save))
            yield {
                "cells": cells,
                "first_Sq_nm": 1e9 * sq,
                "layers": 0.5 * save,
                "Sa_nm": 1e9 * found.Sa_m,
                "along_nm": 1e9 * found.Ra_along_m,
                "across_nm": 1e9 * found.Ra_across_m,
            }


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add grids, particles and layers."""
    parser.add_argument("--cells", type=int, nargs="+", default=[256, 512])
    parser.add_argument("--particles", type=int, default=32)
    parser.add_argument("--layers", type=int, default=4)
    parser.add_argument("--both", action="store_true", help="the plate wears too")


def measure(options: argparse.Namespace) -> Tables:
    """Return the table; the first grid has both starts, the others the smoother."""
    runs = [(options.cells[0], sq) for sq in STARTS]
    runs += [(cells, STARTS[-1]) for cells in options.cells[1:]]
    fixed = options.particles, options.layers, options.both
    return {"patch": [row for cells, sq in runs for row in patch(cells, sq, *fixed)]}


if __name__ == "__main__":
    main(__doc__, add_options, measure)
