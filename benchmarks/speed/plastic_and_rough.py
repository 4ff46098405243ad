"""Elastic-plastic and rough contacts, against tamaas and ContactMechanics.

A paraboloid of 5 mm under 1000 N, whose pressure is capped at 4 GPa, and the
same without a cap; a self-affine surface pressed to about a tenth of contact,
in free space and, where tribo has the solver, periodic. Each package is at the
loosest tolerance at which one judge finds a complementarity of at most --duty,
relative to Hertz's approach or the rms height.

Ratios are times over that of tribo; `to elastic` and `to free` are a
package's own time over that of its first contact.
"""

from __future__ import annotations

import argparse
import statistics

import numpy as np

from benchmarks.lib.common import Row, Tables, interleaved, main, ratio
from benchmarks.lib.peers import meet, packages
from benchmarks.lib.problems import HARDNESS, Contact, ball, rough
from tribo.registry.registry import default_registry

LOAD = 1000.0


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this benchmark's own options."""
    parser.add_argument("--plastic-cells", type=int, default=256)
    parser.add_argument("--rough-cells", type=int, default=512)
    parser.add_argument("--duty", type=float, default=1e-8, help="complementarity to reach")


def measure(options: argparse.Namespace) -> Tables:
    """Return a table for the ball and one for the rough surface."""
    cells = options.plastic_cells
    balls = {"elastic": ball(cells, LOAD), "capped": ball(cells, LOAD, cap=HARDNESS)}
    surfaces = {"free": rough(options.rough_cells)}
    if "periodic" in default_registry().names("contact_solver"):
        surfaces["periodic"] = rough(options.rough_cells, periodic=True)
    return {
        "Elastic-plastic contact": _rows(balls, options),
        "Rough surface": _rows(surfaces, options),
    }


def _rows(contacts: dict[str, Contact], options: argparse.Namespace) -> list[Row]:
    found = {
        (name, package.name): meet(package, contact, options.duty)
        for name, contact in contacts.items()
        for package in packages()
    }
    times = interleaved(
        {" ".join(key): meeting.again for key, meeting in found.items()},
        options.repeats,
        options.threads,
    )
    first = next(iter(contacts))
    rows = []
    for (name, package), meeting in found.items():
        own = times[f"{first} {package}"]
        spent, pressure = times[f"{name} {package}"], meeting.answer.pressure
        rows.append(
            {
                "contact": name,
                "cells": len(pressure),
                "package": package,
                "complementarity": meeting.verdict.complementarity,
                "penetration": meeting.verdict.penetration,
                "iterations": meeting.answer.iterations,
                "contact_fraction": float(np.mean(pressure > 0)),
                **ratio(spent, times[f"{name} tribo"]),
                f"to_{first}": statistics.median(spent) / statistics.median(own),
            }
        )
    return rows


if __name__ == "__main__":
    main(__doc__, add_options, measure)
