"""The paper's first contact by tamaas and by tribo's own solver: pressures and times."""

from time import perf_counter

import numpy as np
from tribo import ContactProblem, ContactSolution, Simulation


def solve(contact: str, load: float, width: float, cells: int) -> tuple[ContactSolution, float]:
    """Return the first contact, and the time it took in s (the best of three)."""
    steel = {"young": "207 GPa", "poisson": 0.3, "hardness": "4 GPa"}
    model = Simulation(
        {
            "grid": {"size": [width, width], "cells": [cells, cells]},
            "load": {"normal": load},
            "bodies": {
                "ball": {"surface": {"type": "sphere", "radius": "5 mm"}, "material": steel},
                "disk": {"surface": {"type": "flat"}, "material": steel},
            },
            "contact": {"type": contact},
            "kinematics": {
                "type": "reciprocating",
                "stroke": "2 mm",
                "frequency": "25 Hz",
                "duration": "1 s",
                "positions": "average",
                "swept": "disk",
            },
            "stepping": {"type": "explicit", "time_step": "1 s"},
        }
    ).model
    problem = ContactProblem(model.contact.system, model.contact.gap, model.contact.system.load)
    times = []
    for _ in range(3):
        begun = perf_counter()
        solution = model.case.contact.solve(problem)
        times.append(perf_counter() - begun)
    return solution, min(times)


def main() -> None:
    """Print a line for each case."""
    for load, width in ((100.0, 0.7e-3), (1000.0, 1.2e-3)):
        for cells in (64, 128):
            theirs, slow = solve("tamaas.half_space", load, width, cells)
            ours, fast = solve("dcfft", load, width, cells)
            off = np.abs(theirs.pressure - ours.pressure).max() / ours.pressure.max()
            deep = np.abs(theirs.overlap - ours.overlap).max()
            print(
                f"{load:g} N on {cells}² cells: pressures differ by {off:.1e} of the largest, "
                f"plastic depths by {1e9 * deep:.1e} nm; {slow:.3f} s against {fast:.4f} s "
                f"({slow / fast:.0f} times)"
            )


if __name__ == "__main__":
    main()
