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
    "'volume' is no objective; give a Volume": ({}, "volume"),
    "Volume.* is no objective; give a Volume": ({}, Volume),
    "(?i)none.* is no objective; give a Volume": ({}, {}),
    "has the time '20 s', which is no number": ({}, {"20 s": Volume("ball")}),
    "has the time nan, which is no number": ({}, {NAN: Volume("ball")}),
    "nothing is saved at 3 s": ({}, {3.0: Volume("ball")}),
    r"a depth ends the run at 6\.\d+ s, before the time 15 s": (ENDS, {15.0: Volume("ball")}),
    "stop.depth: is not given": ({}, EndTime()),
    r"after 20 s .* is 0\.5\d+ µm of 1 µm": ({"stop": Stop(depth="1 um")}, EndTime()),
    r" is 0\.04\d+ µm of 0\.2 µm": (
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
    ("make", "message"),
    [
        (lambda: Deepest("ball", 1), "an order of 1 of Deepest is not allowed"),
        (lambda: Depth("ball", "1 mm"), r"the place is x = '1 mm', y = 0\.0; give numbers, in m"),
        (lambda: Pressure(0.0, None), r"the place is x = 0\.0, y = None"),
    ],
)
def test_an_objective_that_means_nothing_is_refused(make, message):
    with pytest.raises(CaseError, match=message):
        make()


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (3.0, "mine gave 3.0; an objective gives its value and Seeds"),
        ((1.0, Seeds(np.ones((3, 3)))), "its value and Seeds, whose wear is by body"),
        ((NAN, Seeds()), "the value of mine is NaN, infinite or no number"),
        ((np.ones(2), Seeds()), r"the value of mine has the shape \(2,\), not \(\)"),
        ((1.0, Seeds(time=INF)), "the seed by time of mine is NaN, infinite"),
        ((1.0, Seeds(pressure=np.ones((3, 3)))), r"pressure of mine has the shape \(3, 3\), not"),
        ((1.0, Seeds({"ring": np.ones((3, 3))})), "there is no body 'ring'"),
        ((1.0, Seeds({"ball": [[1.0], [1.0, 2.0]]})), "wear of ball of mine is NaN, infinite or"),
        ((1.0, Seeds({"ball": np.ones((3, 3))})), r"wear of ball of mine has the shape \(3, 3\)"),
    ],
)
def test_an_objective_that_gives_no_value_and_seeds_is_refused(answer, message):
    def mine(view):
        return answer

    with pytest.raises(CaseError, match=message):
        gradient(run(), mine, [])
