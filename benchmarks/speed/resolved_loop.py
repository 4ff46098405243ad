"""The paper's resolved hour against explicit loops over its positions, at their stability limit.

A loop jumps cycles by forward Euler: Archard's law for both bodies under the contacts at all
positions, each solved from its last answer by tribo, a peer, or the NumPy below at the loosest
tolerance that a judge finds good to --duty in the first contact. `steps of tribo` are its own
explicit ones, which mirror half of the positions. A loop's hour is extrapolated: from the state
of tribo's resolved run at each save it takes --steps jumps of the limit there, and the time of a
jump over its length is integrated from save to save; so it is for loops over every cycle. `differs`
is by how much pressures after the first jumps are off those of tribo's steps, in the mean.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from benchmarks.lib.common import Row, Tables, interleaved, main, ratio
from benchmarks.lib.explicit_loop import SPEED, WEAR
from benchmarks.lib.peers import Answer, Package, TriboFast, compiled, meet, packages
from benchmarks.lib.problems import LOAD, MODULUS, Contact, hertz
from benchmarks.studies.resolved_hour import CASES, paper_case
from tribo import Array, Simulation
from tribo.contact.love import wrapped_kernel
from tribo.core.contact import ContactSolution
from tribo.core.state import State
from tribo.evolution.interval import interval_from
from tribo.model.model import Model
from tribo.simulation.march import begin, march
from tribo.stepping.contacts import undeformed
from tribo.stepping.explicit import Explicit, largest_stable_increment

EQUAL = "equal coefficients"
OWN, FAST, AVERAGED = "tribo, resolved", "tribo, resolved, compiled", "tribo, averaged"
CYCLE = 0.04
"""Duration of one, in s."""


class PlainNumPy(Package):
    """Polonsky and Keer (1999) with NumPy's transforms, on the whole window."""

    name = "numpy"
    module = "numpy"

    def __init__(self, contact: Contact, tolerance: float) -> None:
        super().__init__(contact, tolerance)
        cells, dx = len(contact.gap), contact.spacing
        self.kernel = np.fft.rfft2(wrapped_kernel((2 * cells, 2 * cells), (dx, dx)) / MODULUS)

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        total = self.contact.load / self.contact.spacing**2
        p = np.ones_like(gap) if start is None else start.pressure
        p = p * (total / p.sum())
        direction, before, iterations = np.zeros_like(p), np.inf, 0
        while True:
            iterations += 1
            loaded = p > 0
            g = gap + self._displaced(p)
            g -= g[loaded].mean()
            if (p * np.abs(g)).sum() <= self.tolerance * total * self.contact.depth:
                return Answer(p, iterations, None)
            square = (g[loaded] ** 2).sum()
            direction = np.where(loaded, g + square / before * direction, 0.0)
            r = self._displaced(direction)
            r -= r[loaded].mean()
            length = (g * direction)[loaded].sum() / (r * direction)[loaded].sum()
            p = np.maximum(p - length * direction, 0.0)
            overlaps = (p == 0) & (g < 0)
            p[overlaps] = -length * g[overlaps]
            before = np.inf if overlaps.any() else square
            p *= total / p.sum()

    def _displaced(self, pressure: Array) -> Array:
        n = len(pressure)
        return np.fft.irfft2(np.fft.rfft2(pressure, (2 * n, 2 * n)) * self.kernel)[:n, :n]


@dataclass(frozen=True)
class Jumps:
    """So many jumps from one state, always the same ones."""

    package: Package
    model: Model
    state: State
    start: Sequence[Answer]
    count: int

    def run(self, length: float) -> list[Answer]:
        """Take jumps of a length in m; a gap is the unworn one, the ball's wear and its rows."""
        starts, shares = _rows(self.model), [at.share for at in self.model.cycle]
        ball, disk = (body.wear.copy() for body in self.state.bodies.values())
        answers = list(self.start)
        for _ in range(self.count):
            for row, share, answer in zip(starts, shares, answers, strict=True):
                depth = WEAR * length * share * answer.pressure
                ball += depth
                disk[row : row + len(depth)] += depth
            answers = [
                self.package.solve(gap + ball + disk[row : row + len(ball)], answer)
                for row, gap, answer in zip(starts, self.model.contact.gaps, answers, strict=True)
            ]
        return answers


def own_jumps(model: Model, state: State, count: int, length: float) -> Sequence[ContactSolution]:
    """Take explicit steps of tribo; return the contacts after them."""
    scheme = Explicit(time_step=length / SPEED)
    for _ in range(count):
        state = scheme.step(model, state, length, state.time + scheme.time_step)
    return state.contacts


def measure(options: argparse.Namespace) -> Tables:
    """Return the methods, their jumps, and their times relative to the resolved hour's."""
    runs = {
        name: Simulation(paper_case(EQUAL, options.cells, positions, options.duration))
        for name, positions in ((OWN, options.positions), (AVERAGED, "average"))
    }
    if TriboFast.present():
        runs[FAST] = runs[OWN]
    model = runs[OWN].model
    begun = begin(model)
    states = [begun, *_at_saves(model, begun, options.saves)]
    limits = [_limit(model, state) for state in states]
    _, pressure, depth = hertz(LOAD)
    contact = Contact(model.contact.gap, CASES[EQUAL][1], LOAD, depth, pressure)
    makers: dict[str, Callable[[State], Callable[[float], Sequence[Any]]]] = {
        "steps of tribo": lambda state: partial(own_jumps, model, state, options.steps)
    }
    for kind in (*packages(contact), PlainNumPy):
        made = meet(kind, contact, options.duty).package
        makers[f"loop on {kind.name}"] = partial(_jumps, made, model, options.steps)
    actions: dict[str, Callable[[], Any]] = {
        name: partial(_run, run, int(name == FAST)) for name, run in runs.items()
    }
    for save, (state, limit) in enumerate(zip(states, limits, strict=True)):
        for name, maker in makers.items():
            jumps = maker(state)
            actions[f"{name} {save}"] = partial(jumps, limit)
            actions[f"{name}, every cycle {save}"] = partial(jumps, CYCLE * SPEED)
    spent = interleaved(actions, options.repeats, options.threads)

    times = np.array([state.time for state in states])
    rows = [_row(name, None, None, spent[name], spent[OWN]) for name in runs]
    right = actions["steps of tribo 0"]()
    for name in makers:
        off = _differs(actions[f"{name} 0"](), right)
        for title, lengths in ((name, limits), (f"{name}, every cycle", [CYCLE * SPEED])):
            often = SPEED / np.array(lengths)[:, None] * np.ones((len(times), 1))
            jump = np.array([spent[f"{title} {save}"] for save in range(len(times))])
            whole = np.trapezoid(jump / options.steps * often, times, axis=0)
            count = round(float(np.trapezoid(often[:, 0], times)))
            rows.append(_row(title, count, off, whole, spent[OWN]))
    limit = {"shortest_limit_s": min(limits) / SPEED, "longest_limit_s": max(limits) / SPEED}
    return {"resolved hour": rows, "limit": [limit]}


def _run(simulation: Simulation, threads: int) -> None:
    with compiled(threads):
        simulation.run()


def _jumps(
    package: Package, model: Model, count: int, state: State
) -> Callable[[float], Sequence[Answer]]:
    gaps = undeformed(model, state)
    last = [Answer(contact.pressure, None, contact) for contact in state.contacts]
    start = [package.solve(gap, answer) for gap, answer in zip(gaps, last, strict=True)]
    return Jumps(package, model, state, start, count).run


def _differs(after: Sequence[Any], right: Sequence[Any]) -> float:
    """Return by how much pressures are off others, over their mean, at the worst position."""
    pairs = [(one.pressure, other.pressure) for one, other in zip(after, right, strict=True)]
    return max(float(np.mean(np.abs(p - q)) / np.mean(q)) for p, q in pairs)


def _row(
    name: str, jumps: int | None, off: float | None, times: Sequence[float], own: Sequence[float]
) -> Row:
    return {"method": name, "jumps": jumps, "differs": off, **ratio(times, own)}


def _rows(model: Model) -> Sequence[int]:
    starts = model.cycle.maps["disk"].starts
    assert starts is not None
    return starts


def _at_saves(model: Model, begun: State, saves: Sequence[float]) -> list[State]:
    """Return the states of the run at the first step that reaches each time."""
    found: list[State] = []
    for accepted in march(model, begun):
        if accepted.last or accepted.state.time >= saves[len(found)]:
            found.append(accepted.state)
    return found


def _limit(model: Model, state: State) -> float:
    limit = largest_stable_increment(
        model, state, interval_from(state, 1e-3, state.time + 1e-2).end
    )
    assert limit is not None
    return limit


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add grid, positions, duration and what the loops do."""
    parser.set_defaults(repeats=1)
    parser.add_argument("--cells", type=int, default=128)
    parser.add_argument("--positions", type=int, default=33)
    parser.add_argument("--duration", type=float, default=3600.0, help="in s")
    parser.add_argument("--saves", type=float, nargs="+", default=[200.0, 1500.0, 3600.0])
    parser.add_argument("--steps", type=int, default=1, help="of a loop from each save")
    parser.add_argument("--duty", type=float, default=1e-6, help="complementarity in a loop")


if __name__ == "__main__":
    main(__doc__, add_options, measure)
