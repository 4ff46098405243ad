"""The positions of a cycle, chosen where a case leaves them open."""

from __future__ import annotations

from tribo.case import Case
from tribo.core.errors import CaseError, located
from tribo.core.measures import half_widths
from tribo.lab.against_hertz import hertz_half_width
from tribo.model.model import Model
from tribo.motion.reciprocating import Reciprocating
from tribo.motion.stroke import least_positions
from tribo.result.read import Result
from tribo.simulation.assembly import assemble
from tribo.stepping.explicit import Explicit
from tribo.stepping.first_contact import first_contact

LENGTHS = 20.0
"""Lengths of the first contact above which a stroke is averaged.

The average makes the groove of the paper's load and path 3 % deeper than 97 positions.
"""
SPARE = 0.85
"""Distance of positions over half a half-width, so that coarser grids take as many."""
FEWEST = 9
"""Positions that are chosen: with fewer, strokes of one or two half-widths are 1 % off."""


def composed(case: Case) -> Model:
    """Return the model of a case, the positions of its cycle chosen if they are ``"auto"``.

    The average is taken where the stroke is 20 lengths of the first contact or longer, where
    nothing that passes wears, and where stepping is explicit. Else positions are less than half the
    half-width of the first contact apart, 9 at least; they are at each cell where the average is
    refused or the contact repeats, and as they were where a run begins with worn bodies.

    The choice follows from the case alone. The model's case states it.
    """
    motion = case.kinematics
    if not isinstance(motion, Reciprocating) or motion.positions != "auto":
        return assemble(case)
    if case.begin is not None:
        with located("begin"), Result.open(case.begin) as result:
            given = result.case_tables["kinematics"].get("positions", "average")
        return assemble(_fixed(case, given))
    try:
        averaged = assemble(_fixed(case, "average"))
    except CaseError:
        return assemble(_fixed(case, "cells"))
    if isinstance(case.stepping, Explicit) or not averaged.changing:
        return averaged
    if case.contact.periodic:
        return assemble(_fixed(case, "cells"))
    # By Hertz where the bodies have such a contact, so that it does not depend on the grid.
    half_width = hertz_half_width(averaged.contact.system)
    half_width = half_width or half_widths(first_contact(averaged).contact, averaged.grid)[0]
    if motion.stroke >= LENGTHS * 2 * half_width:
        return averaged
    positions = max(FEWEST, least_positions(motion.stroke, SPARE * half_width))
    return assemble(_fixed(case, positions))


def _fixed(case: Case, positions: int | str) -> Case:
    motion = case.kinematics.model_copy(update={"positions": positions})
    return case.model_copy(update={"kinematics": motion})
