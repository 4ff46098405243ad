"""What the plugin layer adds to a run, as a ratio against direct calls.

The paper's run is made twice in turn, many times: through the whole layer
(lookup in the registry, composition, checks of every answer, blame), and with
objects made directly and every check taken out. Run it with
``python benchmarks/plugin_cost.py [--cells 256] [--repeats 7]``.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
import tomllib
from contextlib import nullcontext
from unittest.mock import patch

from tribo import Simulation
from tribo.config.load import validate_case
from tribo.registry.registry import default_registry
from tribo.simulation.compose import compose
from tribo.templates import template


def case(cells: int) -> dict[str, object]:
    """Return the paper's case on `cells`² cells."""
    data = tomllib.loads(template("ball_on_disk"))
    data["grid"]["cells"] = cells
    return data


def through_the_layer(data: dict[str, object]) -> float:
    """Return the processor time of a run as a user makes it, in s."""
    begun = time.process_time()
    Simulation(data).run().close()
    return time.process_time() - begun


def directly(data: dict[str, object]) -> float:
    """Return the processor time of a run of ready objects whose answers are not checked, in s."""
    model = compose(validate_case(data), default_registry())
    with (
        patch("tribo.simulation.rates._checked", lambda body, rate, shape, moment: rate),
        patch("tribo.simulation.step._check_solution", lambda model, solution: None),
        patch("tribo.simulation.run.blaming", nullcontext),
    ):
        begun = time.process_time()
        Simulation(model).run().close()
        return time.process_time() - begun


def main() -> None:
    """Print the ratio of the medians."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, default=256)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--json", action="store_true")
    chosen = parser.parse_args()
    data = case(chosen.cells)
    through_the_layer(data), directly(data)
    pairs = [(through_the_layer(data), directly(data)) for _ in range(chosen.repeats)]
    ratios = [layered / direct for layered, direct in pairs]
    found = {
        "cells": chosen.cells,
        "repeats": chosen.repeats,
        "ratio_of_medians": statistics.median(a for a, _ in pairs)
        / statistics.median(b for _, b in pairs),
        "ratio_min": min(ratios),
        "ratio_median": statistics.median(ratios),
        "ratio_max": max(ratios),
    }
    if chosen.json:
        print(json.dumps(found, indent=2))
    else:
        print(f"the plugin layer adds {100 * (found['ratio_median'] - 1):+.2f} % (median of pairs)")
        print(f"pairs range from {100 * (min(ratios) - 1):+.2f} to {100 * (max(ratios) - 1):+.2f} %")


if __name__ == "__main__":
    main()
