"""Models that alter the process that they run in, as a whole run or another model would see.

They were written without sight of the checks.
"""

import os
import random
import tempfile
import warnings

import numpy as np
from testing.conformance.honest import Counts, Hill, Law, Motion, Solver, Wavy
from testing.conformance.honest_effects import Debris, Flash, Heating, Tribofilm
from testing.conformance.mistaken import mistake


def after(honest, method, deed):
    """Return the parts of a model that does a deed in a method, and then answers soundly."""

    def does(self, *given, **named):
        deed()
        return getattr(honest, method)(self, *given, **named)

    return {method: does}


def silenced():
    np.seterr(all="ignore")


def elsewhere():
    os.chdir(tempfile.gettempdir())


def seeded():
    np.random.seed(1)  # noqa: NPY002


def one_thread():
    os.environ["OMP_NUM_THREADS"] = "1" + os.environ.get("OMP_NUM_THREADS", "")


for words, honest, method, deed in (
    ("A law silences numpy's errors", Law, "rate", silenced),
    ("A law seeds Python's random numbers", Law, "rate", lambda: random.seed(1)),
    ("A law silences all warnings", Law, "rate", lambda: warnings.simplefilter("ignore")),
    ("An effect silences numpy's errors for 0 by 0", Heating, "fields", silenced),
    (
        "An effect draws a random number from numpy's global ones",
        Debris,
        "fields",
        lambda: np.random.rand(),  # noqa: NPY002
    ),
    ("An effect's rates draw from Python's random numbers", Debris, "state_rates", random.random),
    ("An effect sets the number of threads in the environment", Flash, "fields", one_thread),
    (
        "An effect's rates silence all warnings",
        Tribofilm,
        "state_rates",
        lambda: warnings.simplefilter("ignore"),
    ),
    ("A surface changes the working folder to read its file", Hill, "height", elsewhere),
    ("Roughness seeds numpy's global random numbers", Wavy, "height", seeded),
    ("A solver silences numpy's errors", Solver, "solve", silenced),
    ("A solver sets the number of threads in the environment", Solver, "solve", one_thread),
    ("A solver seeds numpy's global random numbers to start from", Solver, "solve", seeded),
    ("A motion changes the working folder", Motion, "exposures", elsewhere),
    ("A motion draws a random number in each distance", Motion, "distance_at", random.random),
    ("An observer seeds numpy's global random numbers", Counts, "on_start", seeded),
    ("An observer changes the working folder", Counts, "on_start", elsewhere),
    (
        "An observer silences all warnings",
        Counts,
        "on_step",
        lambda: warnings.simplefilter("ignore"),
    ),
):
    mistake(words, honest, **after(honest, method, deed))
