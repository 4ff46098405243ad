"""Gross slip in fretting: a stroke a tenth of the contact, resolved into every cell of it."""

import numpy as np
import pytest
from paper_models import archard, flat, foundation, motion, named, small, states, steel

from tribo import Cylinder, Grid, Measured
from tribo.simulation.assembly import assemble
from tribo.simulation.predict import predict

RADIUS, LINE_LOAD, K = 10e-3, 137e3, 1e-15
DX = 20e-6
GRID = Grid((100 * DX, 4 * DX), (100, 4))


@pytest.fixture(scope="module")
def worn():
    """A cylinder on a flat, both of which wear, until their form is worn far beyond elasticity."""
    cylinder = Cylinder(radius=RADIUS)
    model = small(
        grid=GRID,
        ends_at_window=True,
        load=LINE_LOAD * GRID.size[1],
        bodies=[
            named("cylinder", cylinder, steel(), archard(K)),
            named("flat", flat(), steel(), archard(K)),
        ],
        contact=foundation(modulus=2.3e14),
        kinematics=motion(stroke=2 * DX, duration=20000, positions="cells"),
    )
    return model, states(model)


def test_the_worn_profile_is_that_of_a_rigid_contact_under_even_pressure(worn):
    # Under p = W / 2a on a worn width of 2a = 2 √(2 R d) both lose d' = 2 k p per metre.
    model, (first, *_, end) = worn
    contact = 2 * np.sqrt(2 * RADIUS * first.contact.approach)
    assert model.motion.component.stroke == pytest.approx(0.1 * contact, rel=0.05)
    depth = (1.5 * K * LINE_LOAD * end.distance / np.sqrt(2 * RADIUS)) ** (2 / 3)
    x = GRID.mesh[0]
    rigid = np.maximum(depth - x**2 / (2 * RADIUS), 0.0)
    assert depth > 5 * first.contact.approach
    lost = end.bodies["cylinder"].wear + end.bodies["flat"].wear[1:-1]
    assert np.max(lost) == pytest.approx(depth, rel=3e-3)
    # The largest difference is where the flat wears beyond the contact's ends.
    assert np.max(np.abs(lost - rigid)) < 0.025 * depth
    assert np.sqrt(np.mean((lost - rigid) ** 2)) < 5e-3 * depth
    mean = sum(
        position.share * contact.pressure
        for position, contact in zip(model.cycle, end.contacts, strict=True)
    )
    inside = np.abs(x) < 0.9 * np.sqrt(2 * RADIUS * depth)
    even = LINE_LOAD / (2 * np.sqrt(2 * RADIUS * depth))
    np.testing.assert_allclose(mean[inside[:, 0]], even, rtol=0.03)


@pytest.mark.parametrize("path", [None, [(0, 0), (0.02, 2 * DX), (0.04, 0)]])
def test_check_estimates_the_worn_depth_and_blames_no_average(worn, path):
    model, (*_, end) = worn
    if path is not None:
        measured = Measured(path=path, duration=20000, positions="cells")
        model = assemble(model.case.model_copy(update={"kinematics": measured}))
    prediction = predict(model)
    assert prediction.problems == ()
    for name, body in prediction.last.bodies.items():
        assert body.max_wear_depth == pytest.approx(end.bodies[name].wear.max(), rel=0.05), name
