"""What the plugin layer adds to a run, as ratios against direct calls.

The same run is made in three ways, by turns:

composed
    from its case, with the registry made anew: entry points read, hooks
    called, the configuration validated, names looked up;
joined
    from objects that are made directly and joined with `assemble`;
unchecked
    as joined, but every component is called as it is: nothing holds its
    answers to the contract, names it where it raises, or keeps its arrays
    from being written to.

*Composition* is composed over joined, *checks* is joined over unchecked, and
*all* is composed over unchecked. All three solve the same steps. What counts
is the processor time of the process, all threads together: each ratio is the
median of those of single turns, with their smallest and largest, beside the
ratio of the fastest runs, which other work on the machine disturbs least. Two
equal runs differ by some per cent on a busy machine: what the spread does not
tell apart from 1 is not measured. What takes place before the run, composing, is timed apart too.

Run it with ``python benchmarks/plugin_cost.py [--case CASE] [--cells 256] [--repeats 7] [--json]``.
A case that names an installed plugin shows what that costs: once in a process of
its own, unless it was found to import before; ``XDG_CACHE_HOME=$(mktemp -d)``
makes the first repeat find it out.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from tribo import Simulation
from tribo.interfaces.component import Component
from tribo.registry.registry import default_registry
from tribo.simulation import exposed, motion, rates, solving, watching
from tribo.simulation.model import Body, Model, assemble
from tribo.templates import template


def composed(data: dict[str, Any], model: Model) -> Simulation:
    """Return the case, composed through a new registry."""
    default_registry.cache_clear()
    return Simulation(data)


def joined(data: dict[str, Any], model: Model) -> Simulation:
    """Return the same case, made of objects of the classes that `model` is made of."""
    return Simulation(
        assemble(
            grid=model.grid,
            load=model.load,
            bodies=[_body(body) for body in model.bodies],
            contact=_new(model.contact),
            kinematics=_new(model.kinematics),
            stepping=model.stepping,
            friction_coefficient=model.friction_coefficient,
            effects=[_new(effect) for effect in model.effects],
            observers=[_new(observer) for observer in model.observers],
            save_times=model.save_times,
            stop=model.stop,
            ends_at_window=model.ends_at_window,
            requires=model.requires,
        )
    )


def _body(body: Body) -> Body:
    return replace(body, surface=_new(body.surface), wear=body.wear and _new(body.wear))


def _new(component: Component[Any]) -> Any:
    return type(component)(component.config)


UNGUARDED = nullcontext()
UNCHECKED: list[tuple[Any, str, Callable[..., Any]]] = [
    *[(m, "calling", lambda *_: UNGUARDED) for m in (exposed, motion, rates, solving, watching)],
    *[(m, "named", lambda *_: "") for m in (motion, rates, solving)],
    *[(m, "readonly", lambda array: array) for m in (rates, solving)],
    (motion, "CheckedExposure", lambda exposure, *_: exposure),
    (motion, "number", lambda who, what, value: value),
    (rates, "spread", lambda who, what, values, shape, *_: (np.broadcast_to(values, shape), 0, 0)),
    (rates, "_checked", lambda who, law, rate, *_: rate),
    (solving, "_checked", lambda who, problem, answer: answer),
    (watching, "_view", lambda snapshot: snapshot),
]
"""What stands between a run and its components: where, its name, and nothing in its place."""


@contextmanager
def unchecked() -> Iterator[None]:
    """Let components be called directly."""
    with ExitStack() as patches:
        for module, name, plain in UNCHECKED:
            patches.enter_context(patch.object(module, name, plain))
        yield


def seconds(make: Callable[[], Simulation]) -> tuple[float, float, int]:
    """Return how long it takes to make a simulation, to make and run it, and its steps."""
    begun = time.process_time()
    simulation = make()
    made = time.process_time() - begun
    with simulation.run() as result:
        return made, time.process_time() - begun, result.totals()["steps"]


def measure(data: dict[str, Any], repeats: int) -> dict[str, Any]:
    """Return the ratios of the repeats, and what the ways to make a simulation take."""
    model = Simulation(data).model
    times: dict[str, list[tuple[float, float, int]]] = {
        "composed": [],
        "joined": [],
        "unchecked": [],
    }
    for repeat in range(repeats):
        # Each goes first as often as the others: what warms up in between favours none.
        for turn in range(3):
            way = list(times)[(repeat + turn) % 3]
            with unchecked() if way == "unchecked" else UNGUARDED:
                make = composed if way == "composed" else joined
                times[way].append(seconds(lambda make=make: make(data, model)))
    (steps,) = {steps for runs in times.values() for _, _, steps in runs}
    whole = {way: [run for _, run, _ in runs] for way, runs in times.items()}
    making = {way: statistics.median(made for made, _, _ in runs) for way, runs in times.items()}
    return {
        "steps": steps,
        "run_s": statistics.median(whole["unchecked"]),
        "composition": _spread(whole["composed"], whole["joined"]),
        "checks": _spread(whole["joined"], whole["unchecked"]),
        "all": _spread(whole["composed"], whole["unchecked"]),
        "making_added_s": making["composed"] - making["unchecked"],
    }


def _spread(dividends: list[float], divisors: list[float]) -> dict[str, float]:
    ratios = [a / b for a, b in zip(dividends, divisors, strict=True)]
    return {
        "min": min(ratios),
        "median": statistics.median(ratios),
        "max": max(ratios),
        "fastest": min(dividends) / min(divisors),
    }


def main() -> None:
    """Print the median ratios and their spread."""
    parser = argparse.ArgumentParser(description="What the plugin layer adds to a run.")
    parser.add_argument("--case", type=Path, help="a case file; the paper's if left out")
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--json", action="store_true")
    chosen = parser.parse_args()
    data = tomllib.loads(chosen.case.read_text() if chosen.case else template("ball_on_disk"))
    data["grid"]["cells"] = chosen.cells
    found = {
        "cells": chosen.cells,
        "repeats": chosen.repeats,
        **measure(data, chosen.repeats),
    }
    if chosen.json:
        print(json.dumps(found, indent=2))
        return
    words = {"composition": "composing the run", "checks": "checking answers", "all": "both"}
    for part, what in words.items():
        low, middle, high, fastest = (
            100 * (found[part][end] - 1) for end in ("min", "median", "max", "fastest")
        )
        print(f"{what:18} {middle:6.2f} % ({low:.2f} to {high:.2f} %; fastest {fastest:.2f} %)")
    print(f"of {found['run_s']:.2f} s, {found['steps']} steps on {chosen.cells}² cells")
    added = found["making_added_s"]
    print(f"composing takes {1e3 * added:.1f} ms, {100 * added / found['run_s']:.2f} % of the run")


if __name__ == "__main__":
    main()
