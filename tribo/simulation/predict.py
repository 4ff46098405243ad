"""What a case will do, from a cheap run on a coarse grid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from tribo.case import Case, Output
from tribo.component import components
from tribo.core.errors import CaseError, NumericalError, PluginError, TooWorn
from tribo.core.findings import Finding, outgrown, trial_failed
from tribo.core.grid import Grid
from tribo.core.measures import Measures
from tribo.evolution.local_fields import effect_fields
from tribo.evolution.measure import measure
from tribo.guards.guard import Guard
from tribo.lab.against_hertz import HertzContact, hertz_contact, softer_known
from tribo.model.model import Model
from tribo.simulation.assembly import assemble, varied
from tribo.simulation.march import begin, march
from tribo.simulation.memory import memory_needed
from tribo.simulation.validity import doubting, few_cells, implausible, limitation
from tribo.simulation.watch import Watch
from tribo.stepping.implicit import Implicit
from tribo.stepping.step import start_sliding

WIDER = 1.5
"""Edges of the window to try, relative to the case's: the contact may outgrow its window."""
LOOSE = Implicit(depth_tolerance=2e-2, pressure_tolerance=0.5, settle=0.1)
"""Ten to twenty times the usual tolerances."""
COARSE = 72
"""Cells along the window of a trial run: a first contact of a ninth of it has `FEW_CELLS`."""


@dataclass(frozen=True)
class Prediction:
    """An estimate of a run before it is made.

    `first` is the first contact, `hertz` the same by Hertz's theory, `last` the end of a run on a
    coarse grid in a wider window, good to some percent. `problems` are expected failures, each with
    its remedy, `exit_code` is the code of `tribo run`. Unknown values are None.
    """

    first: Measures
    hertz: HertzContact | None
    cells_across: tuple[float, float] | None
    last: Measures | None
    worn_through: tuple[Finding, ...]
    window_holds: bool | None
    positions: int
    """Of a cycle in which the contact is solved; 1 for an average."""
    memory: float
    """About the most that a run takes, in bytes."""
    facts: Mapping[str, Mapping[str, str]]
    """The facts of components, by their place in the case."""
    problems: tuple[Finding, ...]
    exit_code: int


@dataclass(frozen=True)
class Trial:
    """The end of a run on a coarse grid, or why it has none.

    Its contact outgrew the case's window at `outgrown`, in s; None if it did not. `exit_code` is
    the code of the run itself where it must `fail` too, 0 where it may succeed on finer cells.
    """

    last: Measures | None = None
    outgrown: float | None = None
    worn_through: tuple[Finding, ...] = ()
    findings: tuple[Finding, ...] = ()
    failure: Finding | None = None
    exit_code: int = 0


def predict(model: Model) -> Prediction:
    """Estimate what `model` will do, in about a second.

    `CaseError` or `NumericalError` if the run would stop at once.
    """
    state = begin(model)
    with doubting(model.case):
        effect_fields(model, state)
        start_sliding(model, state)
    first = measure(model, state)
    hardness = {name: each.materials()[0].hardness for name, each in model.case.bodies.items()}
    system = softer_known(model.contact.system, hardness)
    hertz = None if model.case.begin else hertz_contact(system)
    dx, dy = model.grid.spacing
    trial = _trial(model, first)
    last, failure, code = trial.last, trial.failure, trial.exit_code
    holds = None if last is None else _inside(model, last) or model.contact.may_reach_edge
    if holds is False:
        failure = outgrown(model.grid.size, trial.outgrown, model.end_time)
        code = NumericalError.exit_code
    problems = (failure, *few_cells(state.contact), *trial.findings)
    facts = {place: Guard(c).ask(c.facts) for place, c in components(model.case)}
    return Prediction(
        first=first,
        hertz=hertz,
        cells_across=None
        if hertz is None
        else (2 * hertz.half_width_x / dx, 2 * hertz.half_width_y / dy),
        last=last,
        worn_through=trial.worn_through,
        window_holds=holds,
        positions=len(model.cycle),
        memory=memory_needed(model.case, len(model.cycle)),
        facts={place: dict(stated) for place, stated in facts.items() if stated},
        problems=tuple(problem for problem in problems if problem is not None),
        exit_code=code,
    )


def _inside(model: Model, measures: Measures) -> bool:
    (lx, ly), (dx, dy) = model.grid.size, model.grid.spacing
    return measures.half_width_x < lx / 2 - dx and measures.half_width_y < ly / 2 - dy


def _trial(model: Model, first: Measures) -> Trial:
    # The wear on one grid is unknown on another.
    if not model.case.contact.accepts_wear_compliance or model.case.begin is not None:
        return Trial()
    # Contacts that repeat keep their positions however long the path: for the average they end.
    half_width = np.inf if model.case.contact.periodic else first.half_width_x
    # A body or a period that ends at the window has no more to give in a wider one.
    margin = 1.0 if model.contact.may_reach_edge else WIDER
    state, when = None, None
    try:
        coarse = coarsened(model.case, COARSE, margin, half_width)
        state = begin(coarse)
        # The trial's case has no observers, which may end a run too.
        watch = Watch(coarse, model.case.observers)
        for accepted in march(coarse, state, watch):
            state = accepted.state
            if when is None and not _inside(model, measure(coarse, state)):
                when = state.time
    except (CaseError, NumericalError) as error:
        # What is refused on its way does not hang on the cells.
        refused = state is not None and isinstance(error, CaseError | TooWorn)
        certain = refused or isinstance(error, PluginError)
        code = error.exit_code if certain else 0
        return Trial(failure=trial_failed(error, on_any_cells=certain), exit_code=code)
    last = measure(coarse, state)
    limit = limitation(model, last.half_width_x)
    findings = (
        *(finding for finding, _ in implausible(coarse, state)),
        *(replace(each, words=f"at {each.time:.3g} s {each.words}") for each in watch.said),
        *([limit] if limit else []),
    )
    layers = tuple(each for each in state.findings if each.kind == "layer")
    return Trial(last, when, layers, findings)


def coarsened(case: Case, cells: int, margin: float, half_width_x: float = 0.0) -> Model:
    """Return the model of a case on a coarse grid, smooth and unworn, its steps long.

    It has `cells` along the longer edge of a window `margin` times as large. With half the extent
    of the first contact along x, in m, a short stroke keeps a few positions; every stroke is
    averaged without.
    """
    largest = max(case.grid.size)
    nx, ny = (max(8, 2 * round(0.5 * cells * size / largest)) for size in case.grid.size)
    lx, ly = (margin * size for size in case.grid.size)
    grid = Grid((lx, ly), (nx, ny), ends_at_window=True)
    motion = case.kinematics.coarsened(half_width_x)
    changes = {
        "kinematics": motion,
        "load": case.load.thinned(),
        "stepping": LOOSE,
        "begin": None,
    }
    return assemble(varied(smoothed(case), grid=grid, output=Output(), **changes))


def smoothed(case: Case) -> Case:
    """Return a case without the relief of its surfaces and of its wear laws."""
    bodies = {}
    for name, body in case.bodies.items():
        layers = (
            each.model_copy(update={"wear": each.wear and each.wear.smoothed()})
            for each in body.layers
        )
        form = {"surface": body.surface.smoothed(), "wear": body.wear and body.wear.smoothed()}
        bodies[name] = body.model_copy(update={**form, "layers": tuple(layers)})
    return case.model_copy(update={"bodies": bodies})
