"""Implicit steps are backward Euler, whatever the law."""

import numpy as np
import pytest
from paper_models import archard, foundation, half_space, last, pair, power, small

from tribo.core.contact import ContactProblem
from tribo.stepping.contacts import undeformed
from tribo.stepping.first_contact import first_contact
from tribo.stepping.implicit import Implicit


def one_step(model, increment=1.0):
    state = first_contact(model)
    return Implicit().step(model, state, increment, increment / 0.1)


LAWS = [(archard(), archard()), (power(1.5), power(1.5)), (power(2), archard()), (power(3), None)]


@pytest.mark.parametrize("laws", LAWS, ids=["archard", "p^1.5", "p^2, archard", "p^3, none"])
@pytest.mark.parametrize("contact", [half_space(tolerance=1e-11), foundation()])
def test_a_step_is_exact_backward_euler(laws, contact):
    model = small(bodies=pair(*laws), contact=contact)
    state = one_step(model)
    pressure = state.contact.pressure
    # The wear is the law's at the new pressure ...
    for name, body in model.case.bodies.items():
        if body.wear is None:
            assert not state.bodies[name].wear.any()
            continue
        local = type("Local", (), {"pressure": pressure, "material": body.material})
        rate = body.wear.rate(local).depth_rate
        np.testing.assert_allclose(
            state.bodies[name].wear,
            1.0 * model.cycle.maps[name].average(rate),
            rtol=1e-6,
            atol=1e-7 * state.bodies[name].wear.max(),
        )
    # ... and the pressure is that of the worn geometry.
    again = contact.solve(
        ContactProblem(model.contact.system, undeformed(model, state)[0], model.contact.system.load)
    )
    np.testing.assert_allclose(again.pressure, pressure, atol=2e-5 * pressure.max())


def test_a_change_of_pressure_shortens_the_next_step_and_rejects_none():
    def end(tolerance):
        stepping = Implicit(pressure_tolerance=tolerance, depth_tolerance=0.1)
        return last(small(contact=foundation(), stepping=stepping))

    loose, tight = end(1.0), end(0.02)
    assert loose.rejected_steps == tight.rejected_steps == 0
    assert tight.steps > 3 * loose.steps
