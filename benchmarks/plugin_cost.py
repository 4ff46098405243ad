"""What the plugin layer adds to a run, as a ratio against direct calls.

The same run is timed twice, by turns: composed from its case, with the
registry made anew (entry points read, hooks called, the configuration
validated, names looked up), and from objects that are made directly and joined
with `assemble`. Both solve the same steps with the same code, so that all the
layer adds lies in making the simulation, which is timed apart too: two equal
runs differ by more, as the spread of the ratios shows.

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
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from tribo import Simulation
from tribo.interfaces.component import Component
from tribo.registry.registry import default_registry
from tribo.simulation.model import Body, Model, assemble
from tribo.templates import template


def composed(data: dict[str, Any]) -> Simulation:
    """Return the case, composed through a new registry."""
    default_registry.cache_clear()
    return Simulation(data)


def direct(model: Model) -> Simulation:
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


def seconds(make: Callable[[], Simulation]) -> tuple[float, float]:
    """Return how long it takes to make a simulation, and to make and run it."""
    begun = time.perf_counter()
    simulation = make()
    made = time.perf_counter() - begun
    simulation.run().close()
    return made, time.perf_counter() - begun


def measure(data: dict[str, Any], repeats: int) -> dict[str, Any]:
    """Return the ratios of the repeats, and what the two ways to make a simulation take."""
    model = Simulation(data).model
    ways = [lambda: composed(data), lambda: direct(model)]
    times: list[list[tuple[float, float]]] = [[], []]
    for repeat in range(repeats):
        # Each goes first as often as the other: what warms up in between favours neither.
        for way in (0, 1) if repeat % 2 == 0 else (1, 0):
            times[way].append(seconds(ways[way]))
    pairs = list(zip(*times, strict=True))
    ratios = [layered[1] / plain[1] for layered, plain in pairs]
    added = statistics.median(layered[0] - plain[0] for layered, plain in pairs)
    return {
        "ratio_min": min(ratios),
        "ratio_median": statistics.median(ratios),
        "ratio_max": max(ratios),
        "making_added_s": added,
        "making_added_ratio": added / statistics.median(plain[1] for _, plain in pairs),
    }


def main() -> None:
    """Print the median ratio and its spread."""
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
    low, middle, high = (100 * (found[f"ratio_{end}"] - 1) for end in ("min", "median", "max"))
    print(f"the plugin layer adds {middle:.2f} % to the run")
    print(f"({low:.2f} to {high:.2f} % in {chosen.repeats} pairs on {chosen.cells}² cells)")
    added, share = 1e3 * found["making_added_s"], 100 * found["making_added_ratio"]
    print(
        f"composing it takes {added:.1f} ms more than making it directly, {share:.2f} % of the run"
    )


if __name__ == "__main__":
    main()
