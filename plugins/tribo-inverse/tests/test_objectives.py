"""Objectives of a gradient: their values and slopes, and those that are refused."""

import numpy as np
import pytest
from gradients import run
from tribo.case import Stop
from tribo.core.errors import CaseError

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import (
    Deepest,
    Depth,
    EndTime,
    Pressure,
    Volume,
)
from tribo_inverse.adjoint.view import Seeds

NAN, INF = np.nan, np.inf


ENDS = {"stop": Stop(depth="0.2 um"), "save_times": (15.0,)}
REFUSED = {
    "Deepest has the order 1; give 2": ({}, Deepest("ball", 1)),
    "'1 mm' is no place within 0.00025 m": ({}, Depth("ball", "1 mm")),
    "nan is no place within": ({}, Pressure(0.0, NAN)),
    # Of which all places along x are alike.
    "'middle' is no place within": ({}, Depth("disk", "middle")),
    "'volume' is no objective; give a Volume": ({}, "volume"),
    r"Volume gave Volume\(.*; an objective gives its value": ({}, Volume),
    "{} is no objective; give a Volume": ({}, {}),
    "nothing is saved at '20 s'": ({}, {"20 s": Volume("ball")}),
    "nothing is saved at 3.0, ": ({}, {3.0: Volume("ball")}),
    r"nothing is saved at 15.0, .* ends at 6\.\d+ s": (ENDS, {15.0: Volume("ball")}),
    r"stop.depth: .* after 20 s the largest is 0\.5\d+ µm": ({}, EndTime()),
    r"stop.depth: .* the largest is 0\.04\d+ µm": (
        {"stop": Stop(depth="0.2 um", body="disk")},
        EndTime(),
    ),
}


@pytest.mark.parametrize("words", REFUSED)
def test_what_a_run_does_not_answer_is_refused(words):
    changes, objective = REFUSED[words]
    with pytest.raises(CaseError, match=words):
        gradient(run(**changes), objective, [])


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (3.0, "mine gave 3.0; an objective gives its value and Seeds"),
        ((1.0, Seeds(np.ones((3, 3)))), "its value and Seeds by body"),
        ((NAN, Seeds()), "the value of mine must be finite"),
        ((np.ones(2), Seeds()), r"the value of mine must be finite, of the shape \(\)"),
        ((1.0, Seeds(time=INF)), "the seed by time of mine must be finite"),
        ((1.0, Seeds(pressure=np.ones((3, 3)))), r"pressure of mine must be .* \(10, 10\)"),
        ((1.0, Seeds({"ring": np.ones((3, 3))})), "there is no body 'ring'"),
        ((1.0, Seeds({"ball": [[1.0], [1.0, 2.0]]})), "wear of ball of mine must be finite"),
        ((1.0, Seeds({"ball": np.ones((3, 3))})), r"wear of ball of mine must be .* \(10, 10\)"),
    ],
)
def test_an_objective_that_gives_no_value_and_seeds_is_refused(answer, message):
    def mine(view):
        return answer

    with pytest.raises(CaseError, match=message):
        gradient(run(), mine, [])
