"""An explicit wear loop on any package, begun at states of the paper's run."""

from __future__ import annotations

from dataclasses import dataclass, replace

from benchmarks.lib.peers import Answer, Package, meet
from benchmarks.lib.problems import Contact, Verdict, hertz, judge
from tribo import Array, Result

WEAR, STROKE, SPEED = 3.11e-16, 2e-3, 0.1


@dataclass(frozen=True)
class State:
    """Where a block of steps begins: the undeformed gap in m, and the pressure across it in Pa."""

    gap: Array
    pressure: Array


@dataclass(frozen=True)
class Block:
    """Some steps from one state, always the same ones.

    Parameters
    ----------
    package : Package
        Which solves the contacts.
    gap : ndarray, shape (n, n)
        Undeformed gap at the beginning, in m.
    start : Answer
        The pressure across it.
    steps : int
        How many.
    distance : float
        Path slid in one, in m.
    """

    package: Package
    gap: Array
    start: Answer
    steps: int
    distance: float

    def run(self) -> State:
        """Take the steps: Archard's law, averaged over the stroke on the disk."""
        gap, answer = self.gap.copy(), self.start
        line = self.package.contact.spacing / STROKE
        for _ in range(self.steps):
            pressure = answer.pressure
            gap += WEAR * self.distance * (pressure + line * pressure.sum(axis=0))
            answer = self.package.solve(gap, answer)
        return State(gap, answer.pressure)

    def judged(self, after: State) -> Verdict:
        """Judge what `run` returned."""
        return judge(replace(self.package.contact, gap=after.gap), after.pressure)


def states(result: Result, gap: Array) -> list[State]:
    """Return the states of a run at its saves; `gap` is that of the unworn bodies."""
    bodies = [result.body(name) for name in result.body_names]
    return [
        State(gap + sum(body.wear_depth[save] for body in bodies), result.field("pressure", save))
        for save in range(len(result.times))
    ]


def blocks(
    package: type[Package],
    begin: list[State],
    load: float,
    width: float,
    *,
    duty: float,
    steps: int,
    time_step: float,
) -> list[Block]:
    """Return a block of steps from each state, by a package as good as `duty` at the first."""
    _, pressure, depth = hertz(load)
    made = meet(package, Contact(begin[0].gap, width, load, depth, pressure), duty).package
    return [
        Block(made, state.gap, made.solve(state.gap), steps, SPEED * time_step) for state in begin
    ]
