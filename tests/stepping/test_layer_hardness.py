"""Layers of another hardness: each limits the pressure where it is at the surface."""

import numpy as np
import pytest
from coated_pins import SLOW, STEEL, coated, flat

from tribo import CaseError, Simulation, Winkler
from tribo.simulation.march import begin, march
from tribo.stepping.contacts import solve_cycle, undeformed
from tribo.stepping.step import start_sliding


def yielding(top, below, thickness, **more):
    """A coated ball on a hard flat, under a load at which both hardnesses are reached."""
    pin = {
        "surface": {"type": "sphere", "radius": "5 mm"},
        "material": {**STEEL, "hardness": below},
        "wear": SLOW,
        "layers": [{"thickness": thickness, "hardness": top}],
    }
    grid = {"size": "0.5 mm", "cells": 32}
    return flat(pin=pin, contact={"type": "dcfft"}, grid=grid, load="100 N", **more)


def test_the_pressure_is_limited_to_the_hardness_of_the_layer_at_the_surface():
    # The layer is worn through in the middle, and what it bore is borne around.
    case = yielding("1.6 GPa", "0.9 GPa", "20 nm", distance="0.03 m")
    with Simulation(case).run() as result:
        first, last = (result.field("pressure", save) / 1e9 for save in (0, -1))
        worn = result.body("pin").wear_depth[-1]
        plastic = result.body("pin").plastic_depth
    through = worn >= 20e-9
    assert first.max() == pytest.approx(1.6, rel=1e-9)
    # What the last step alone has worn through yields as the next one begins.
    assert np.median(last[through]) == pytest.approx(0.9, rel=1e-9)
    assert 0.9 < last[~through].max() <= 1.6 * (1 + 1e-9)
    assert 10 < np.count_nonzero(through & (last > 0)) < np.count_nonzero(last)
    assert np.all(plastic[-1][through & (last > 0)] > plastic[0][through & (last > 0)])


def test_nothing_yields_twice_under_one_load():
    model = Simulation(yielding("1.6 GPa", "0.9 GPa", "20 nm", distance="0.03 m")).model
    for _, state in zip(range(4), march(model, begin(model)), strict=False):
        worn = start_sliding(model, state.state)
    again = solve_cycle(
        model,
        undeformed(model, worn),
        model.contact.loads.before(worn.time),
        worn.contacts,
        worn.bodies,
    )
    deepest = max(np.max(body.plastic) for body in worn.bodies.values())
    assert deepest > 1e-7
    assert max(np.max(contact.overlap) for contact in again) < 1e-5 * deepest


def test_a_solver_that_knows_one_hardness_refuses_two(monkeypatch):
    monkeypatch.setattr(Winkler, "takes_cap_map", False)
    case = flat(pin=coated(hardness="10 GPa"), contact={"type": "winkler", "modulus": 1e15})
    case["bodies"]["pin"]["material"] = {**STEEL, "hardness": "4 GPa"}
    with pytest.raises(CaseError, match=r"^bodies\.pin\.layers: contact.type = 'winkler' limits"):
        Simulation(case)
