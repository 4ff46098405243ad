"""Errors of grid and steps in a user's own case."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from tribo.case import Output
from tribo.core.errors import TriboWarning, about
from tribo.core.grid import Grid
from tribo.lab.scar import scar
from tribo.model.model import Model
from tribo.result.read import Result
from tribo.simulation.assembly import assemble, varied
from tribo.simulation.run import Simulation
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.verification.convergence import Convergence, convergence

# Above the 1.3 that Celik et al. (2008) ask for, and mild on cases that are coarse already.
RATIO = 1.5
UNITS = {"pressure": "Pa", "volume": "m^3"}
"""SI units of quantities, by a word in their names; of the others m."""


@dataclass(frozen=True)
class Level:
    """A run of the study: its cells, its steps, and its quantities at the end, in SI units."""

    cells: tuple[int, int]
    steps: int
    end: dict[str, float]


@dataclass(frozen=True)
class UncertainValue:
    """A quantity at the end of the run, with its numerical uncertainty."""

    name: str
    """Its name; with the body's name where it belongs to a body."""
    unit: str
    value: float
    """As the case itself gives it, without saves on the way, in the SI unit `unit`."""
    grid: Convergence
    """Over three grids."""
    steps: Convergence
    """Over three lengths of step."""
    floor: float
    """Least uncertainty on these cells: a counted width is good to half a cell."""
    uncertainty: float
    """To quote with `value`: the errors of grid and steps added, at least `floor`. They are not
    added as squares, as they are not random."""


@dataclass(frozen=True)
class Refinement:
    """The study of a case: its runs, coarse to fine, and its results with their uncertainties."""

    grids: tuple[Level, ...]
    steps: tuple[Level, ...]
    estimates: tuple[UncertainValue, ...]


def refine(model: Model, started: Callable[[str], None] = lambda _: None) -> Refinement:
    """Run a case on three grids and with three lengths of step.

    The finest grid is the case's own; cells grow by 1.5 towards the coarser
    ones. Implicit steps of the case are the finest too, and tolerances are
    loosened to make steps 1.5 and 2.25 times as long; explicit steps are
    shortened instead, which stays within their stability limit. Nothing is
    saved on the way, since a save cuts a step short on all levels alike.

    `started` gets the name of each run before it starts; five runs in all. An error of a run names
    the run.
    """
    cells, stepping = model.grid.cells, model.case.stepping
    explicit = isinstance(stepping, Explicit)

    def run(cells: tuple[int, int], factor: float = 1.0) -> Level:
        what = f"{cells[0]} × {cells[1]} cells, steps {'÷' if explicit else '×'} {factor:g}"
        started(what)
        with about(what):
            return _run(model, cells, _changed(stepping, factor))

    base = run(cells)
    grids = *(run(_coarser(cells, factor)) for factor in (RATIO**2, RATIO)), base
    most, more = (run(cells, factor) for factor in (RATIO**2, RATIO))
    steps = (base, more, most) if explicit else (most, more, base)
    return Refinement(grids, steps, tuple(_estimates(model, grids, steps)))


def _coarser(cells: tuple[int, int], factor: float) -> tuple[int, int]:
    """Return fewer cells, of the same parity, so that the centre stays in place."""
    nx, ny = (n % 2 + 2 * round(0.5 * (n / factor - n % 2)) for n in cells)
    return nx, ny


def _changed(config: Implicit | Explicit, factor: float) -> Implicit | Explicit:
    """Return explicit steps that are as many times shorter, or implicit ones that are longer."""
    if isinstance(config, Explicit):
        return config.model_copy(update={"time_step": config.time_step / factor})
    # The depth error of a step grows as its square, the pressure's in proportion.
    longer = {key: factor * getattr(config, key) for key in ("pressure_tolerance", "settle")}
    longer["depth_tolerance"] = factor**2 * config.depth_tolerance
    return config.model_copy(update=longer)


def _run(model: Model, cells: tuple[int, int], config: Implicit | Explicit) -> Level:
    grid = Grid(model.grid.size, cells, model.grid.ends_at_window)
    level = assemble(varied(model.case, grid=grid, stepping=config, output=Output()))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        result = Simulation(level).run()
    return Level(cells, result.totals()["steps"], _quantities(result))


def _estimates(
    model: Model, grids: Sequence[Level], steps: Sequence[Level]
) -> Iterator[UncertainValue]:
    dx, dy = model.grid.spacing
    floors = {"contact width along": dx, "contact width across": dy}
    own = steps.index(grids[-1])
    for name, value in grids[-1].end.items():
        of_grids, of_steps = ([level.end[name] for level in each] for each in (grids, steps))
        if not any(of_grids + of_steps):
            continue
        sizes = [1 / level.cells[0] for level in grids], [1 / level.steps for level in steps]
        grid = convergence(of_grids, sizes[0], formal_order=2.0)
        step = convergence(of_steps, sizes[1], formal_order=1.0, own=own)
        floor = floors.get(name, 0.0)
        uncertainty = max(grid.uncertainty + step.uncertainty, floor)
        unit = next((unit for word, unit in UNITS.items() if word in name), "m")
        yield UncertainValue(name, unit, value, grid, step, floor, uncertainty)


def _quantities(result: Result) -> dict[str, float]:
    last = result.saves()[-1]
    found = {
        "peak pressure": last["max_pressure_Pa"],
        "pressure at the centre": last["centre_pressure_Pa"],
        "contact width along": 2 * last["contact_half_width_x_m"],
        "contact width across": 2 * last["contact_half_width_y_m"],
    }
    if result.case_tables["stop"]["depth"] is not None:
        found["path slid"] = last["distance_m"]
    for name, body in last["bodies"].items():
        worn = result.body(name)
        marks = scar(worn.wear_depth[-1], result.grid)
        found |= {
            f"{name}: largest depth": body["max_wear_depth_m"],
            f"{name}: depth at the centre": body["centre_wear_depth_m"],
            f"{name}: scar across": marks.across,
            f"{name}: scar along sliding": 0.0 if worn.swept else marks.along,
            f"{name}: volume": body["wear_volume_m3"],
            f"{name}: largest plastic depth": body["max_plastic_depth_m"],
        }
    return found
