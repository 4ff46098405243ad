"""What the positions of a cycle cost, as a run estimates it, against every cell."""

from functools import partial

import numpy as np
import pytest
import stroke
from paper_models import last

from tribo import Grid, Simulation
from tribo.core import findings
from tribo.evolution.measure import cycle_error
from tribo.motion.cycle import missed_shares
from tribo.motion.stroke import Stroke

GRID = Grid((1.2e-3, 0.75e-3), (64, 20))
resolved = partial(stroke.resolved, duration=50, grid=GRID)


def quadrature(count):
    path = Stroke(2.0, 0.01, count)
    return path.cells * path.dx, path.shares


@pytest.mark.parametrize("count", [17, 33, 41])
def test_of_smooth_values_the_estimate_is_the_error(count):
    # Between most positions of 17 and 33 lie unequal numbers of cells.
    nodes, shares = quadrature(count)
    error = np.sin(3.0) / 3.0 - np.sum(shares * np.cos(3.0 * nodes))
    estimate = np.sum(missed_shares(nodes, shares) * np.cos(3.0 * nodes))
    assert estimate == pytest.approx(error, rel=0.08)


def true_error(state, finest, model):
    """Return the mean error over the contact, relative to the deepest wear, as it is estimated."""
    errors = []
    for name, body in state.bodies.items():
        off = np.abs(body.wear - finest.bodies[name].wear)
        weighed = sum(
            position.share * np.sum(contact.pressure * model.cycle.maps[name].see(off, at))
            for at, (position, contact) in enumerate(zip(model.cycle, state.contacts, strict=True))
        )
        errors.append(weighed * model.grid.cell_area / model.contact.system.load / body.wear.max())
    return max(errors)


@pytest.mark.slow
def test_a_run_knows_its_error_from_above_and_by_its_order():
    finest = last(resolved("cells"))
    estimates = {}
    for count in (7, 13):
        model = resolved(count)
        state = last(model)
        estimates[count] = cycle_error(model, state)
        true = true_error(state, finest, model)
        assert true < estimates[count] < 4 * true
    assert estimates[7] / estimates[13] == pytest.approx(4, rel=0.25)


def test_every_cell_and_the_average_have_no_such_error():
    for positions in ("cells", "average"):
        model = resolved(positions, duration=2)
        state = last(model)
        assert cycle_error(model, state) == 0
        assert all(body.missed is None for body in state.bodies.values())


def test_a_run_says_so_and_how_many_would_do(monkeypatch):
    # Positions so few that smooth bodies come to 5 % are refused.
    monkeypatch.setattr(findings, "COARSE", 0.01)
    simulation = Simulation(resolved(7, duration=5).case)
    with pytest.warns(match=r"7 positions.*0\.075 mm apart.*by about 2.* to 11 for 1 %"):
        result = simulation.run()
    with result:
        history = result.table("history")["cycle_error"]
    assert history[0] == 0
    assert 0.015 < history[-1] < 0.04
