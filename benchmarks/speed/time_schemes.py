"""Backward Euler against schemes of higher order, on the paper's hour.

Each scheme takes increments in proportion to the path, halved before a save, so that
it is compared with the others at an equal number of contact solves. Errors are those
of the worst save against the program's own steps at a far tighter tolerance; the
overshoot is that of the largest pressure, over all steps.

A scheme that gives part of a step's wear to the pressure at its beginning leaves cells
touched during the step with the implicit part alone. To wear as deep as their
neighbours they need 1/β times the pressure, where β is that part: the overshoot at the
edge of a worn contact, whatever the length of the steps.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import tribo.templates
from benchmarks.lib.common import Row, Tables, main
from tribo import Result, Simulation
from tribo.config.load import load_case
from tribo.core.contact import ContactProblem, ContactSolution, WearCompliance
from tribo.core.measures import centre

CASE = Path(tribo.templates.__file__).with_name("ball_on_disk.toml")
TIGHT = ("depth_tolerance=1e-5", "pressure_tolerance=0.005", "settle=0.001")
ONSET = 2.0
"""Path in m before which increments do not grow, where wear does not yet shape the contact."""

GAMMA = 1 - np.sqrt(0.5)


@dataclass(frozen=True)
class Worn:
    """A ball and a track, worn so far, and the pressure between them."""

    ball: Any
    track: Any
    contact: ContactSolution


class Hour:
    """The paper's contact, with both bodies wearing by Archard's law."""

    def __init__(self, cells: int, duration: float) -> None:
        self.case = load_case(CASE, overrides=[f"grid.cells={cells}", *_lasting(duration)])
        self.model = Simulation(self.case).model
        ball, disk = self.model.case.bodies.values()
        assert ball.wear is not None
        assert disk.wear is not None
        self.ball_rate = float(ball.wear.k)
        self.track_rate = float(disk.wear.k) / float(self.model.case.kinematics.stroke)
        self.ends = [
            self.model.case.kinematics.distance_at(time)
            for time in sorted({*self.model.case.output.save_times, self.model.end_time})
            if time > 0
        ]
        self.solves = 0

    def begin(self) -> Worn:
        """Return the first contact."""
        self.solves = 0
        unworn = np.zeros(self.model.grid.cells)
        return Worn(unworn, unworn[:1], self._solve(self.model.contact.gap, 0.0, None))

    def implicit(self, worn: Worn, increment: float) -> Worn:
        """Return `worn` after wear under the pressure at the end."""
        gap = self.model.contact.gap + worn.ball + worn.track
        contact = self._solve(gap, increment, worn.contact)
        return self.explicit(Worn(worn.ball, worn.track, contact), increment)

    def explicit(self, worn: Worn, increment: float, pressure: Any = None) -> Worn:
        """Return `worn` after wear under a pressure, its own if left out; nothing is solved."""
        p = worn.contact.pressure if pressure is None else pressure
        line = p.sum(axis=0, keepdims=True) * self.model.grid.spacing[0]
        return Worn(
            worn.ball + self.ball_rate * increment * p,
            worn.track + self.track_rate * increment * line,
            worn.contact,
        )

    def _solve(self, gap: Any, increment: float, start: ContactSolution | None) -> ContactSolution:
        self.solves += 1
        cells = self.model.grid.cells
        wear = WearCompliance(
            np.full(cells, self.ball_rate * increment),
            np.full(cells[1], self.track_rate * increment),
        )
        problem = ContactProblem(
            self.model.contact.system,
            gap,
            self.model.contact.system.load,
            wear if increment else None,
        )
        return self.model.case.contact.solve(problem, start)


def backward_euler(hour: Hour, worn: Worn, step: float) -> Worn:
    """Wear under the pressure at the end."""
    return hour.implicit(worn, step)


def weighted(share: float) -> Callable[[Hour, Worn, float], Worn]:
    """Give `share` of the wear to the pressure at the beginning; ½ is Crank and Nicolson."""

    def step_on(hour: Hour, worn: Worn, step: float) -> Worn:
        return hour.implicit(hour.explicit(worn, share * step), (1 - share) * step)

    return step_on


def sdirk2(hour: Hour, worn: Worn, step: float) -> Worn:
    """Take Alexander's (1977) L-stable step of second order: two solves."""
    inner = hour.implicit(worn, GAMMA * step)
    begun = hour.explicit(worn, (1 - GAMMA) * step, inner.contact.pressure)
    return hour.implicit(Worn(begun.ball, begun.track, inner.contact), GAMMA * step)


def tr_bdf2(hour: Hour, worn: Worn, step: float) -> Worn:
    """Take the step of Bank et al. (1985), second order and L-stable: two solves."""
    before = worn.contact.pressure
    inner = hour.implicit(hour.explicit(worn, GAMMA * step), GAMMA * step)
    both = before + inner.contact.pressure
    begun = hour.explicit(worn, np.sqrt(0.125) * step, both)
    return hour.implicit(Worn(begun.ball, begun.track, inner.contact), GAMMA * step)


SCHEMES: dict[str, tuple[float | None, Callable[[Hour, Worn, float], Worn]]] = {
    "backward Euler": (1.0, backward_euler),
    "weighted, 0.8 at the end": (0.8, weighted(0.2)),
    "weighted, 0.6 at the end": (0.6, weighted(0.4)),
    "TR-BDF2": (GAMMA, tr_bdf2),
    "SDIRK2": (GAMMA, sdirk2),
}


def measure(options: argparse.Namespace) -> Tables:
    """Run every scheme with every ratio of increment to path."""
    hour = Hour(options.cells, options.duration)
    tight = [f"stepping.{setting}" for setting in TIGHT]
    overrides = [f"grid.cells={options.cells}", *_lasting(options.duration), *tight]
    with Simulation(load_case(CASE, overrides=overrides)).run() as reference:
        return {
            "Time schemes": [
                _row(hour, reference, name, growth) for name in SCHEMES for growth in options.growth
            ]
        }


def _row(hour: Hour, reference: Result, name: str, growth: float) -> Row:
    implicit, step_on = SCHEMES[name]
    history = reference.table("history")
    saves = reference.saves()[1:]
    worn, path = hour.begin(), 0.0
    overshoot = 0.0
    errors = np.zeros((len(hour.ends), 3))
    for i, end in enumerate(hour.ends):
        while path < end:
            step = _increment(growth, path, end)
            worn = step_on(hour, worn, step)
            path = end if step == end - path else path + step
            expected = np.interp(path, history["distance_m"], history["max_pressure_Pa"])
            overshoot = max(overshoot, float(worn.contact.pressure.max()) / float(expected) - 1)
        bodies = list(saves[i]["bodies"].values())
        errors[i] = (
            centre(worn.ball) / bodies[0]["centre_wear_depth_m"] - 1,
            centre(worn.track) / bodies[1]["centre_wear_depth_m"] - 1,
            centre(worn.contact.pressure) / saves[i]["centre_pressure_Pa"] - 1,
        )
    worst = 100 * np.abs(errors).max(axis=0)
    return {
        "scheme": name,
        "implicit_part": float(implicit) if implicit is not None else None,
        "increment_per_path": growth,
        "contact_solves": hour.solves,
        "depth_error_percent": float(worst[:2].max()),
        "centre_pressure_error_percent": float(worst[2]),
        "peak_pressure_overshoot_percent": 100 * overshoot,
    }


def _increment(growth: float, path: float, end: float) -> float:
    remaining = end - path
    step = min(growth * (path + ONSET), max(0.5 * remaining, 0.02 * end))
    if remaining <= step * (1 + 1e-9):
        return remaining
    return 0.5 * remaining if remaining < 2 * step else step


def _lasting(duration: float) -> list[str]:
    times = [time for time in (0, 200, 500, 1500, 3600) if time <= duration]
    return [f"kinematics.duration={duration}", f"output.save_times={times}"]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what is particular to this benchmark."""
    parser.add_argument("--cells", type=int, default=128)
    parser.add_argument("--duration", type=float, default=3600.0, help="in s")
    parser.add_argument("--growth", type=float, nargs="+", default=[0.1, 0.2, 0.4])


if __name__ == "__main__":
    main(__doc__, add_options, measure)
