"""How many calls a solve, a step and a resolved step make: their cost, on any machine."""

import sys
from pathlib import Path

import pytest

import tribo
from tribo import Case
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.stepping.contacts import solve_cycle, undeformed

ROOT = str(Path(tribo.__file__).parent)
INLINED = {"<listcomp>", "<dictcomp>", "<setcomp>"}
"""What is a call up to Python 3.11."""


def calls(function):
    """Return how many calls of Python functions of tribo a call makes."""
    count = 0

    def told(frame, event, _):
        nonlocal count
        code = frame.f_code
        own = code.co_filename.startswith(ROOT) and code.co_name not in INLINED
        count += event == "call" and own

    sys.setprofile(told)
    try:
        function()
    finally:
        sys.setprofile(None)
    return count


ARCHARD = {"type": "archard", "k": 1e-16}
RUNNING_IN = {"type": "running_in", "law": ARCHARD, "factor": 6, "over": "1 GPa m"}


def model(law=ARCHARD, **kinematics):
    ball = {"surface": {"type": "sphere", "radius": "5 mm"}}
    steel = {"material": {"young": "210 GPa", "poisson": 0.3}}
    wears = {"wear": law}
    motion = {"type": "reciprocating", "stroke": "1 mm", "frequency": "1 Hz", "duration": "100 s"}
    return assemble(
        Case.model_validate(
            {
                "grid": {"size": "0.6 mm", "cells": 32},
                "load": {"normal": "10 N"},
                "bodies": {
                    "ball": {**ball, **steel, **wears},
                    "disk": {"surface": "flat", **steel, **wears},
                },
                "contact": {"type": "dcfft", "plasticity": False},
                "kinematics": {**motion, **kinematics},
            }
        )
    )


def step(of):
    states = (accepted.state for accepted in march(of, begin(of)))
    state = next(state for state in states if state.previous)
    return lambda: of.case.stepping.advance(of, state, of.end_time)


def solve():
    of = model()
    state = begin(of)
    gaps, loads = undeformed(of, state), of.contact.loads.before(0.0)
    return lambda: solve_cycle(of, gaps, loads, state.contacts, state.bodies)


@pytest.mark.parametrize(
    ("made", "known"),
    [
        (solve, 69),
        (lambda: step(model()), 470),
        (lambda: step(model(positions=33)), 4010),
        (lambda: step(model(RUNNING_IN)), 4343),
    ],
    ids=["solve", "step", "resolved step", "step with states"],
)
def test_it_makes_no_more_calls_than_it_did(made, known):
    """Fails by more than 5 %: look for what became dearer, or write down what became cheaper."""
    assert calls(made()) == pytest.approx(known, rel=0.05, abs=0)
