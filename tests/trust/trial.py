"""The run that the trials are made with, and what its result holds."""

from pathlib import Path

import h5py
import numpy as np
from paper_models import case, motion, pair
from strangers.debris import Debris
from testing.conformance.honest_laws import RunningIn

from tribo import Grid, Simulation
from tribo.observers.observer import Observer

LAW = RunningIn(k_first=9e-16, k_last=3e-16, length=5.0)


def simulation(**changes):
    """Eight seconds of a ball on a disk, whose laws remember, and debris between them."""
    parts = {
        "grid": Grid((0.7e-3, 0.7e-3), (20, 20)),
        "bodies": pair(LAW, LAW),
        "kinematics": motion(duration=8),
        "effects": [Debris(length=0.5)],
        "save_times": (2, 4, 6),
    }
    return Simulation(case(**{**parts, **changes}))


class Acknowledge(Observer):
    """Calls `tell` with the time of each save, once the recorder has it."""

    tell: object

    def on_save(self, snapshot):
        self.tell(snapshot.state.time)


def contents(path):
    """Every dataset of a result, read without tribo."""
    with h5py.File(path) as file:
        return {name: dataset[()] for name, dataset in file.items()}


def same(first, second):
    """Whether two results hold the same bits."""
    return first.keys() == second.keys() and all(
        # Densities that are not given are NaN.
        np.array_equal(first[name], second[name], equal_nan=first[name].dtype.kind == "f")
        for name in first
    )


def whole(folder):
    """Make the run that nothing disturbs."""
    path = Path(folder) / "whole.h5"
    simulation().run(path).close()
    return path
