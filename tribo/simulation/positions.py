"""The positions of a cycle, chosen where a case leaves them open."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

from tribo.case import Begin, Case
from tribo.core.errors import CaseError, NumericalError
from tribo.core.findings import FINE, UNLIKE, averaged_although, positions_chosen
from tribo.core.measures import half_widths
from tribo.core.words import readable
from tribo.lab.against_hertz import hertz_half_width
from tribo.model.model import Model
from tribo.motion.reciprocating import Reciprocating
from tribo.motion.stroke import Stroke, least_positions, spacing_for
from tribo.result.read import Result
from tribo.simulation.assembly import assemble, varied
from tribo.simulation.predict import smoothed
from tribo.simulation.validity import is_endless
from tribo.stepping.explicit import Explicit
from tribo.stepping.first_contact import first_contact

LENGTHS = 20.0
"""Lengths of the first contact above which a stroke is averaged.

The average makes the groove of the paper's load and path 3 % deeper than 97 positions.
"""
NEARLY = 2 / 3
"""Part of the cells of a stroke above which positions are at all of them."""
SPARE = 0.85
"""Distance of positions over half a half-width, so that coarser grids take as many."""
MUST = "the load changes along the stroke"
UNEVEN = "what passes is not the same all along"
FEWEST, MOST = 9, 1001
"""Positions that are chosen: with fewer, strokes of one or two half-widths are 1 % off."""


def composed(case: Case) -> Model:
    """Return the model of a case, the positions of its cycle chosen if they are ``"auto"``.

    The average is taken where the stroke is 20 lengths of the first contact or longer, where
    stepping is explicit, and where the case cannot be resolved. Else positions are less than half
    the half-width of the first contact apart, 9 at least; a flat pin has them as close as its first
    contact needs for 1 %, a swept body that varies along x at each cell. A load that changes along
    the stroke is resolved always, and worn bodies of a result as they were.

    The choice follows from the case alone. The model's case states it.
    """
    motion = case.kinematics
    if not isinstance(motion, Reciprocating) or motion.positions != "auto":
        return assemble(case)
    if case.begin is not None:
        return assemble(_as_begun(case, case.begin))
    # The first contact is that in the middle of the stroke.
    even = case.model_copy(update={"load": case.load.in_the_middle()})
    try:
        averaged = assemble(_fixed(even, "average"))
    except CaseError:
        model = assemble(_fixed(case, _cells(case, motion.stroke)))
        return replace(model, chosen=positions_chosen(len(model.cycle), UNEVEN))
    must = bool(case.load.along)
    if not must and not (_resolvable(case) and averaged.changing):
        return averaged
    half_width = _first_half_width(averaged)
    if half_width is None:
        return assemble(_fixed(case, FEWEST)) if must else averaged
    words = MUST if must else _why(averaged, motion.stroke, half_width)
    if words is None:
        return averaged
    # What repeats has its positions over the window alone.
    length = min(motion.stroke, case.grid.size[0] if case.contact.periodic else math.inf)
    cells = _cells(case, length)
    apart = _spacing(averaged, motion.stroke, half_width)
    count = max(FEWEST, least_positions(length, 2 * apart))
    count = cells if NEARLY * cells < count <= MOST else count
    try:
        if count > MOST:
            raise CaseError(f"it would take {count} positions")
        resolved = assemble(_fixed(case, count))
    except CaseError as error:
        if must or (error.path == "kinematics.stroke" and motion.stroke < half_width):
            # The average would be refused for its own reason.
            raise
        return replace(averaged, chosen=averaged_although(words, error))
    chosen = positions_chosen(len(resolved.cycle), words, optional=not must)
    return replace(resolved, chosen=chosen)


def is_open(case: Case) -> bool:
    """Whether a case leaves the positions of its cycle to be chosen."""
    motion = case.kinematics
    return isinstance(motion, Reciprocating) and motion.positions == "auto"


def chosen(case: Case, model: Model) -> dict[str, Any]:
    """Return the choice that a model has made for a case, as settings; none if it had none."""
    if not is_open(case):
        return {}
    return {"kinematics.positions": model.data["kinematics"]["positions"]}


def alike(cases: Mapping[str, Case]) -> dict[str, Case]:
    """Return cases with open positions chosen alike.

    Resolved cases take the largest number that any of them needs; long strokes stay averaged. If a
    case cannot be resolved all take the average; the other choice if the average is refused.
    """
    left = {label: case for label, case in cases.items() if is_open(case)}
    models = {label: composed(case) for label, case in left.items()}
    averaged = {label: model for label, model in models.items() if len(model.cycle) == 1}
    most = max((len(model.cycle) for model in models.values()), default=1)
    held = any(
        model.chosen is not None or not _resolvable(left[label])
        for label, model in averaged.items()
    )
    choices: list[int | str] = ["average"] if most == 1 else [most, "average"]
    fixed: dict[str, Case] = {}
    for taken in reversed(choices) if held else choices:
        fixed = {
            label: _fixed(case, "average" if label in averaged and not held else taken)
            for label, case in left.items()
        }
        with suppress(CaseError):
            for case in fixed.values():
                assemble(case)
            break
    return {label: fixed.get(label, case) for label, case in cases.items()}


def _fixed(case: Case, positions: int | str) -> Case:
    motion = case.kinematics.model_copy(update={"positions": positions})
    return case.model_copy(update={"kinematics": motion})


def _resolvable(case: Case) -> bool:
    """Whether the steps of a run are as long as its accuracy allows."""
    return case.contact.accepts_wear_compliance and not isinstance(case.stepping, Explicit)


def _as_begun(case: Case, begin: Begin) -> Case:
    """Return a case with the positions of the run whose worn bodies it begins with."""
    positions: int | str = "average"
    # What is wrong with the file is said when the run begins.
    with suppress(CaseError), Result.open(begin.result) as result:
        given = result.case_tables["kinematics"].get("positions")
        positions = given if isinstance(given, int | str) else "average"
    if positions == "average" and case.load.along:
        raise CaseError(
            f"the run of {begin.result} averaged its cycle, and the bodies that it wore cannot be "
            "resolved afterwards, as a load that changes along the stroke needs; run that case "
            "again with a number of kinematics.positions, as 33, or leave load.along out",
            "begin.result",
        )
    return _fixed(case, positions)


def _cells(case: Case, stroke: float) -> int:
    """Return how many cells a stroke (m) has, up to the most positions that are chosen."""
    return len(Stroke(stroke, case.grid.spacing[0], MOST).cells)


def _first_half_width(model: Model) -> float | None:
    """Return half the length along x of the first contact, in m; None where it cannot be solved.

    By Hertz where the bodies have such a contact, so that it does not depend on the grid.
    """
    try:
        hertz = hertz_half_width(model.contact.system)
        return hertz or half_widths(first_contact(model).contact, model.grid)[0]
    except (CaseError, NumericalError):
        return None


def _spacing(model: Model, stroke: float, half_width: float) -> float:
    """Return the largest distance (m) between positions, for the form without asperities."""
    apart, dx = 0.5 * SPARE * half_width, model.grid.spacing[0]
    if _goes_round(model, stroke, half_width):
        return 0.5 * dx
    # A contact that wear does not widen, as a flat pin's, keeps its edge.
    with suppress(NumericalError):
        form = assemble(varied(smoothed(model.case)))
        if form.contact.system.curvature is None:
            return min(apart, spacing_for(first_contact(form).contact.pressure, FINE) * dx)
    return apart


def _goes_round(model: Model, stroke: float, half_width: float) -> bool:
    """Whether a contact that repeats meets what passed its neighbour."""
    beyond = stroke > (1 + UNLIKE) * model.grid.size[0]
    return is_endless(model, half_width) or (model.case.contact.periodic and beyond)


def _why(model: Model, stroke: float, half_width: float) -> str | None:
    """Return why a cycle that can be averaged is to be resolved; None if it is not."""
    window = model.grid.size[0]
    if _goes_round(model, stroke, half_width):
        if abs(stroke - window) <= UNLIKE * window:
            return None
        return (
            f"the contact repeats every {1e3 * window:.3g} mm, and the average would spread what "
            f"it wears there over the stroke of {1e3 * stroke:.3g} mm"
        )
    if stroke >= LENGTHS * 2 * half_width:
        return None
    return f"the stroke is {lengths_of(stroke, half_width)} (from {LENGTHS:g} on it is averaged)"


def lengths_of(stroke: float, half_width: float) -> str:
    """Return how many lengths of the first contact a stroke (m) has, in words."""
    length = 2 * half_width
    return f"{stroke / length:.3g} lengths of the first contact, {readable(1e6 * length, '.3g')} µm"
