"""The paper's hour: tribo's steps against an explicit loop of 0.25 s on each peer.

tribo runs its template `ball_on_disk` at its default tolerances, with NumPy and
with tribo-fast; at loose ones (--loose), and explicitly. The loop is Archard's
law for both bodies, the disk's averaged over the stroke, on each package's
contact solver: warm, at the loosest tolerance that a judge finds good to --duty
in the first contact. Its hour is extrapolated: from the state of tribo's default
run at each save it takes --steps steps, and the time of a step is integrated from
save to save.

Errors are against reference values good to 0.3 % in the depths and 1 % in the
pressure at the centre, and the largest over saves and bodies. A loop's are those
of `explicit`, whose scheme is the same: `differs` is by how much its pressures
after its steps are off those of the loop on tribo's solver, in the mean.
Ratios are times over that of the default run.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np

import tribo.templates
from benchmarks.lib.common import Row, Tables, interleaved, main, ratio
from benchmarks.lib.explicit_loop import Block, blocks, states
from benchmarks.lib.peers import TriboFast, compiled, packages
from benchmarks.lib.problems import LOAD, WINDOW, ball
from tribo import Result, Simulation, load_case

CASE = Path(tribo.templates.__file__).with_name("ball_on_disk.toml")
DEFAULT, LOOSE, EXPLICIT = "tribo, default", "tribo, loose", "tribo, explicit"
FAST = "tribo, compiled"

# An independent backward Euler run with increments of at most 0.25 m, on 128² to 192² cells
# of 1.3 mm; the whole table is in examples/paper.py.
REFERENCE = {
    "ball": {200: 5.660e-6, 500: 9.142e-6, 1500: 15.84e-6, 3600: 24.31e-6},
    "disk": {200: 0.955e-6, 500: 1.896e-6, 1500: 4.252e-6, 3600: 8.040e-6},
}
CENTRE_PRESSURE = {200: 495e6, 500: 300e6, 1500: 167e6, 3600: 106e6}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--duration", type=float, default=3600.0, help="in s; at least 200")
    parser.add_argument(
        "--loose",
        nargs="+",
        default=[
            "stepping.depth_tolerance=0.03",
            "stepping.pressure_tolerance=0.6",
            "stepping.settle=0.3",
        ],
        help="settings of the loose run, as for tribo run --set",
    )
    parser.add_argument("--time-step", type=float, default=0.25, help="of explicit steps, in s")
    parser.add_argument("--steps", type=int, default=5, help="of a loop from each save")
    parser.add_argument("--duty", type=float, default=1e-6, help="complementarity in a loop")


def measure(options: argparse.Namespace) -> Tables:
    """Return the methods with their errors, and their times relative to the default run."""
    explicit = ("stepping.type=explicit", f"stepping.time_step={options.time_step}")
    runs = {
        DEFAULT: _simulation(options),
        LOOSE: _simulation(options, *options.loose),
        EXPLICIT: _simulation(options, *explicit),
    }
    if TriboFast.present():
        runs[FAST] = _simulation(options)
    results = {}

    def run(name: str) -> None:
        with compiled(int(name == FAST)):
            results[name] = runs[name].run()

    run(DEFAULT)
    first = results[DEFAULT]
    begin = states(first, runs[DEFAULT].model.contact.gap)
    loops = {
        f"loop on {package.name}": blocks(
            package,
            begin,
            LOAD,
            WINDOW,
            duty=options.duty,
            steps=options.steps,
            time_step=options.time_step,
        )
        for package in packages(ball(options.cells))
    }
    actions: dict[str, Callable[[], object]] = {
        name: partial(run, name) for name in runs if name != EXPLICIT
    }
    for name, loop in loops.items():
        actions |= {f"{name} {save}": block.run for save, block in enumerate(loop)}
    times = interleaved(actions, options.repeats, options.threads)
    # Once: it takes longer than all the rest.
    once = interleaved({EXPLICIT: partial(run, EXPLICIT)}, 1, options.threads)
    times[EXPLICIT] = once[EXPLICIT] * options.repeats

    own = times[DEFAULT]
    rows = [{**_run(name, results[name]), **ratio(times[name], own)} for name in runs]
    for name, loop in loops.items():
        spent = np.array([times[f"{name} {save}"] for save in range(len(loop))]) / options.steps
        whole = np.trapezoid(spent, first.times, axis=0) / options.time_step
        solves = round(options.duration / options.time_step)
        rows.append({**_loop(name, solves, loop, loops["loop on tribo"]), **ratio(whole, own)})
    return {"The paper's hour": rows}


def _simulation(options: argparse.Namespace, *settings: str) -> Simulation:
    saves = [0, *(t for t in CENTRE_PRESSURE if t < options.duration), options.duration]
    return Simulation(
        load_case(
            CASE,
            overrides=[
                f"grid.cells={options.cells}",
                f"kinematics.duration={options.duration}",
                f"output.save_times={saves}",
                *settings,
            ],
        )
    )


def _run(name: str, result: Result) -> Row:
    saves = [save for save in result.saves() if save["time_s"] in CENTRE_PRESSURE]
    depth = [
        save["bodies"][body]["centre_wear_depth_m"] / expected[save["time_s"]] - 1
        for save in saves
        for body, expected in REFERENCE.items()
    ]
    pressure = [save["centre_pressure_Pa"] / CENTRE_PRESSURE[save["time_s"]] - 1 for save in saves]
    return {
        "method": name,
        "solves": result.totals()["contact_solves"],
        "depth_error": float(np.max(np.abs(depth))),
        "final_depth_error": float(np.max(np.abs(depth[-2:]))),
        "pressure_error": float(np.max(np.abs(pressure))),
        "complementarity": None,
        "differs": None,
    }


def _loop(name: str, solves: int, loop: Sequence[Block], own: Sequence[Block]) -> Row:
    after = [block.run() for block in loop]
    right = [block.run().pressure for block in own]
    return {
        "method": name,
        "solves": solves,
        "depth_error": None,
        "final_depth_error": None,
        "pressure_error": None,
        "complementarity": max(
            b.judged(state).complementarity for b, state in zip(loop, after, strict=True)
        ),
        "differs": max(
            float(np.mean(np.abs(state.pressure - p)) / np.mean(p))
            for state, p in zip(after, right, strict=True)
        ),
    }


if __name__ == "__main__":
    main(__doc__, add_options, measure)
