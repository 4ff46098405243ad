"""A law, an effect and a motion of one's own, as short as the contract lets them be."""

import inspect

import numpy as np
import pytest

from tribo.testing import check

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(("name", "most"), [("Shielded", 25), ("Film", 45), ("Rosette", 60)])
def test_each_is_short_and_keeps_the_contract(example, name, most):
    model = getattr(example, name)
    assert len(inspect.getsource(model).splitlines()) <= most
    check(model)


def test_each_body_has_its_own_film(example):
    short = example.case().model_copy(update={"kinematics": example.Rosette(duration=0.5)})
    with short.run() as result:
        ball, plate = (result.field("film", -1, body) for body in ("ball", "plate"))
        wear = result.body("plate").wear_depth[-1]
    # The ball is pressed all the way, a place of the plate for a part of it.
    assert ball.max() > 2 * plate.max() > 0
    assert np.count_nonzero(wear) > 3 * np.count_nonzero(ball)
