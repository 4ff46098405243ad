"""An increment gone through once more: its stages along each row of the extrapolation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from math import prod
from typing import Generic, TypeVar

import numpy as np
from tribo import Array
from tribo.kernel_api import EXACT, PLAIN, RELAXING, apart, bending, lasting, part_of, relaxing

from tribo_inverse.adjoint.rate_stage import RatePlace, RateStage
from tribo_inverse.adjoint.response import NUDGE, Arrays, Field
from tribo_inverse.adjoint.slopes import Slopes, Sloping

Kind = TypeVar("Kind", bound=RateStage)


@dataclass(frozen=True)
class ReplayedPart(Generic[Kind]):
    """A part of an increment: its stages along each row of the extrapolation.

    `moved` has each state that relaxes, the stage where it is moved by a little, and by how much.
    """

    length: float
    relaxing: Sequence[Field]
    rows: Sequence[Sequence[Kind]]
    moved: Sequence[tuple[int, Kind, Array]]

    @cached_property
    def lasting(self) -> list[list[Field]]:
        """What a step of each row counts for in each state."""
        return [[lasting(self.length / len(row), of) for of in self.relaxing] for row in self.rows]

    @cached_property
    def bending(self) -> list[list[Field]]:
        """The derivatives of that in how fast the state relaxes."""
        return [[bending(self.length / len(row), of) for of in self.relaxing] for row in self.rows]

    @property
    def stages(self) -> list[Kind]:
        """All of them; rows may begin with the same one."""
        return [*chain(*self.rows), *(stage for _, stage, _ in self.moved)]


def replayed(increment: Sloping) -> list[ReplayedPart[Slopes]]:
    """Go through an increment as it was divided, once more."""
    passed = 0.0
    states, divided = increment.begin, list[ReplayedPart[RateStage]]()
    if not increment.along:
        divided.append(
            ReplayedPart(increment.slid.increment, [0.0] * len(states), [[increment.start]], [])
        )
    for share, relaxes in increment.slid.plan.parts if increment.along else ():
        part, states = _part(increment, states, passed, share, relaxes=relaxes)
        divided.append(part)
        passed += share
    stages = {id(stage): stage for part in divided for stage in part.stages}
    slopes = dict(zip(stages, increment.sloped(list(stages.values())), strict=True))
    return [
        ReplayedPart(
            part.length,
            part.relaxing,
            [[slopes[id(stage)] for stage in row] for row in part.rows],
            [(at, slopes[id(stage)], by) for at, stage, by in part.moved],
        )
        for part in divided
    ]


def _part(
    increment: Sloping, states: Arrays, passed: float, share: float, *, relaxes: bool
) -> tuple[ReplayedPart[RateStage], Arrays]:
    """Return the stages of a part of the increment, and the states at its end."""
    span, own = share * increment.slid.increment, len(increment.own)
    begin = RatePlace(passed, span)
    start = increment.at([states], [begin])[0] if passed else increment.start
    of_states: list[Field] = [0.0] * len(states)
    moved = []
    if relaxes:

        def nearby(others: Sequence[Array], *_: float) -> Arrays:
            return increment.at([others], [begin])[0].means[own:]

        of_states = relaxing(nearby, states, start.means[own:], span, increment.limits)
        falling = [at for at, of in enumerate(of_states) if np.any(np.asarray(of) < 0)]
        nudges = increment.nudges(states, start.rates, span, NUDGE)
        for at in falling:
            other = [*states[:at], states[at] + nudges[at], *states[at + 1 :]]
            moved.append((at, increment.at([other], [begin])[0], nudges[at]))
    rows, ends = _rows(increment, states, start, of_states, passed, share, relaxes=relaxes)
    counts = [weight(len(row), [len(each) for each in rows]) for row in rows]
    total = [
        np.sum([by * end[at] for by, end in zip(counts, ends, strict=True)], axis=0)
        for at in range(len(states))
    ]
    return ReplayedPart(span, of_states, rows, moved), increment.held(total)


def _rows(
    increment: Sloping,
    states: Arrays,
    start: RateStage,
    of_states: Sequence[Field],
    passed: float,
    share: float,
    *,
    relaxes: bool,
) -> tuple[list[list[RateStage]], list[Arrays]]:
    """Return the stages of each row of Euler steps, and the states at its end.

    The rows are gone along side by side. Where means over one step and over two agree, as exact
    ones do under one load, one step is all.
    """
    own = len(increment.own)
    exact = increment.advances and increment.model.laws.advances and not increment.loads_change
    rows: list[list[RateStage]] = [[] for _ in (RELAXING if relaxes else PLAIN)]
    ends = [states] * len(rows)
    for taken in range(len(rows)):
        going = range(taken, len(rows))
        begin = [
            RatePlace(passed + share * taken / (1 + i), share * increment.slid.increment / (1 + i))
            for i in going
        ]
        if taken or increment.of_steps:
            found = increment.at([ends[i] for i in going], begin)
        else:
            found = [start] * len(rows)
        for i, stage, (_, step, *_) in zip(going, found, begin, strict=True):
            rows[i].append(start if i == taken == 0 else stage)
            changes = zip(ends[i], rows[i][-1].means[own:], of_states, strict=True)
            ends[i] = [state + lasting(step, of) * mean for state, mean, of in changes]
        if taken == 1 and exact:
            once, twice = (
                [*end, *np.mean([stage.means[:own] for stage in row], axis=0)]
                for row, end in zip(rows[:2], ends[:2], strict=True)
            )
            pairs = zip(once, twice, strict=True)
            if all(part_of(apart(fine, one), np.abs(fine)) <= EXACT for one, fine in pairs):
                return rows[:1], ends[:1]
    return rows, ends


def weight(steps: int, rows: Sequence[int]) -> float:
    """Return what a row of so many steps counts for in the extrapolation of all rows."""
    return prod(steps / (steps - other) for other in rows if other != steps)
