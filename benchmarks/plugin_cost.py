"""What the plugin layer adds to a run, as ratios against direct calls.

composition
    What a run from its case takes before the first step (registry made anew, entry
    points read, hooks called, configuration validated, names looked up) less what it
    takes to make the same objects directly and join them with `assemble`.
checks
    What holding every answer to the contract, naming who raises and keeping arrays from
    being written to adds to the steps: two runs of the same case, one with and one
    without, are taken step by step in turns, so that both meet the same machine.

Both are in per cent of the run without either, an observer that does nothing included.
Each figure is the mean over the repeats with its 95 % confidence interval, by bootstrap; single
repeats differ by some per cent, by where their arrays come to lie. The clock is the CPU time of
the process.

Run it with ``python benchmarks/plugin_cost.py``. A case that names an installed plugin shows
what importing it costs.
"""

from __future__ import annotations

import argparse
import statistics
import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar, Literal
from unittest.mock import patch

import numpy as np
from common import Row, Tables, main
from scipy.stats import bootstrap

from tribo import Simulation
from tribo.core.state import Snapshot
from tribo.interfaces.component import Component
from tribo.interfaces.observer import Observer, ObserverConfig
from tribo.registry.registry import default_registry
from tribo.simulation import exposed, motion, rates, solving, watching
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.simulation.measure import measure as scalars
from tribo.simulation.model import Body, Model
from tribo.templates import template


def composed(data: dict[str, Any]) -> Simulation:
    """Return the case, composed through a new registry."""
    default_registry.cache_clear()
    return Simulation(data)


def joined(model: Model) -> Simulation:
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


CHECKED = [(module, name, getattr(module, name)) for module, name, _ in UNCHECKED]


@contextmanager
def calls(chosen: list[tuple[Any, str, Callable[..., Any]]]) -> Iterator[None]:
    """Let what stands between a run and its components be `CHECKED`, or `UNCHECKED`."""
    with ExitStack() as patches:
        for module, name, function in chosen:
            patches.enter_context(patch.object(module, name, function))
        yield


class IdleConfig(ObserverConfig):
    """Nothing to set."""

    type: Literal["idle"] = "idle"


class Idle(Observer[IdleConfig]):
    """Looks on."""

    Config: ClassVar[type[IdleConfig]] = IdleConfig


def steps(model: Model) -> Iterator[int]:
    """Run, and pause after the first contact and after each step."""
    audience = watching.Audience((Idle(IdleConfig()),))
    state = begin(model)
    yield 0
    for accepted in march(model, state):
        snapshot = Snapshot(accepted.state, scalars(model, accepted.state))
        audience.step(snapshot, save=accepted.save)
        yield accepted.state.steps


def seconds(make: Callable[[], object]) -> tuple[float, Any]:
    """Return the processor time of a call, and what it returns."""
    begun = time.process_time()
    made = make()
    return time.process_time() - begun, made


def in_turns(checked: Model, plain: Model) -> tuple[float, float, int]:
    """Return the seconds of a run that is checked, of one that is not, and their steps."""
    runs = {"checked": steps(checked), "plain": steps(plain)}
    spent = dict.fromkeys(runs, 0.0)
    count = 0
    while True:
        # Each goes first as often as the other: what one leaves in the caches favours none.
        for way in sorted(runs, reverse=count % 2 == 1):
            # What is set before a step costs caches too, and so is set before either.
            with calls(UNCHECKED if way == "plain" else CHECKED):
                time_spent, step = seconds(lambda way=way: next(runs[way], None))
            spent[way] += time_spent
        if step is None:
            return spent["checked"], spent["plain"], count - 1
        count += 1


def measure(options: argparse.Namespace) -> Tables:
    """Return what composition, checks and both add."""
    data = tomllib.loads(options.case.read_text() if options.case else template("ball_on_disk"))
    data["grid"]["cells"] = options.cells
    model = Simulation(data).model
    added: dict[str, list[float]] = {"composition": [], "checks": [], "both": []}
    runs = []
    for _ in range(options.repeats):
        composing, made = seconds(lambda: composed(data))
        with calls(UNCHECKED):
            joining, direct = seconds(lambda: joined(model))
        checked, plain, count = in_turns(made.model, direct.model)
        runs.append(joining + plain)
        added["composition"].append((composing - joining) / runs[-1])
        added["checks"].append((checked - plain) / runs[-1])
        added["both"].append(added["composition"][-1] + added["checks"][-1])
    run = {"cells": options.cells, "steps": count, "run_ms": 1e3 * statistics.median(runs)}
    rows = [_row(part, ratios, run) for part, ratios in added.items()]
    return {"What the plugin layer adds to a run": rows}


def _row(part: str, ratios: list[float], run: Row) -> Row:
    percent = [100 * ratio for ratio in ratios]
    between = bootstrap((percent,), np.mean, rng=1).confidence_interval
    middle = statistics.mean(percent)
    return {
        "part": part,
        "percent": middle,
        "low": float(between.low),
        "high": float(between.high),
        "ms": middle / 100 * run["run_ms"],
        **run,
    }


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--case", type=Path, help="a case file; the paper's if left out")
    parser.add_argument("--cells", type=int, default=256)


if __name__ == "__main__":
    main(__doc__, add_options, measure)
