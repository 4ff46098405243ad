"""What the plugin layer adds to a run, as a ratio against direct calls.

The layer is what lies between the loop and a model's own code: finding the
class in the registry and making the object, and checking every answer (shape,
finite, sign, load). Its functions are timed inside whole runs of the paper's
case; the ratio is that of a run with them to the same run without their time.
Measured inside one run, it does not suffer from what else the machine does.

Run it with ``python benchmarks/plugin_cost.py [--cells 256] [--repeats 7] [--json]``.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
import tomllib
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any
from unittest.mock import patch

from tribo import Simulation
from tribo.registry.registry import Registry, default_registry
from tribo.simulation import rates, step
from tribo.templates import template

LAYER = [(Registry, "lookup"), (rates, "_checked"), (step, "_check_solution")]


def ratio(data: dict[str, Any]) -> float:
    """Return the time of a run over its time without the layer's functions."""
    spent = 0.0

    def timed(function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **options: Any) -> Any:
            nonlocal spent
            begun = time.perf_counter()
            try:
                return function(*arguments, **options)
            finally:
                spent += time.perf_counter() - begun

        return call

    with ExitStack() as patches:
        for owner, name in LAYER:
            patches.enter_context(patch.object(owner, name, timed(getattr(owner, name))))
        begun = time.perf_counter()
        Simulation(data).run().close()
        whole = time.perf_counter() - begun
    return whole / (whole - spent)


def main() -> None:
    """Print the median ratio."""
    parser = argparse.ArgumentParser(description="What the plugin layer adds to a run.")
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--json", action="store_true")
    chosen = parser.parse_args()
    data = tomllib.loads(template("ball_on_disk"))
    data["grid"]["cells"] = chosen.cells
    # Importing the built-in models is not the layer's doing.
    default_registry()
    ratios = [ratio(data) for _ in range(chosen.repeats)]
    found = {
        "cells": chosen.cells,
        "repeats": chosen.repeats,
        "ratio_min": min(ratios),
        "ratio_median": statistics.median(ratios),
        "ratio_max": max(ratios),
    }
    if chosen.json:
        print(json.dumps(found, indent=2))
    else:
        print(f"the plugin layer adds {100 * (found['ratio_median'] - 1):.2f} % to the run")
        low, high = (100 * (found[f"ratio_{end}"] - 1) for end in ("min", "max"))
        print(f"({low:.2f} to {high:.2f} % in {chosen.repeats} runs on {chosen.cells}² cells)")


if __name__ == "__main__":
    main()
