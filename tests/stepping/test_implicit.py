"""Implicit steps are backward Euler, whatever the law."""

from dataclasses import replace

import numpy as np
import pytest
from paper_models import K, archard, foundation, half_space, last, pair, power, small

from tribo.core.contact import ContactProblem
from tribo.core.fields import ContactConditions, Field, WearRate
from tribo.effects.effect import Effect
from tribo.stepping.contacts import extrapolated, undeformed
from tribo.stepping.first_contact import first_contact
from tribo.stepping.implicit import Errors, Implicit
from tribo.wear.law import WearLaw


def one_step(model, increment=1.0):
    state = first_contact(model)
    return Implicit().step(model, state, increment, increment / 0.1)


@pytest.mark.parametrize("part", [0.05, 1.0, 3.0])
def test_a_step_begins_with_pressures_that_go_on_as_in_the_last_one(part):
    """Under any load that followed."""
    first = one_step(small(bodies=pair(archard(), None)))
    (contact,) = first.contacts
    flatter = contact.pressure * np.where(contact.pressure > 0.5 * np.max(contact.pressure), 0.9, 1)
    heavier = replace(contact, pressure=part * contact.pressure)
    (start,) = extrapolated(replace(first, contacts=(heavier,), previous=(flatter,)))
    share = np.sum(contact.pressure) / np.sum(flatter)
    expected = part * (2 * contact.pressure - share * flatter)
    np.testing.assert_allclose(start.pressure, np.maximum(expected, 0), rtol=1e-12)
    assert np.sum(start.pressure) == pytest.approx(part * np.sum(contact.pressure), rel=1e-2)


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


def test_wear_is_never_negative_however_long_the_step():
    state = one_step(small(), increment=1000.0)
    assert all(np.all(body.wear >= 0) for body in state.bodies.values())


def test_halving_tolerances_changes_the_answer_within_them(paper_small):
    # The default tolerances claim 0.5 % in depth and 2 % in centre pressure.
    fine = last(
        small(stepping=Implicit(depth_tolerance=1e-4, pressure_tolerance=0.02, settle=0.002))
    )
    coarse = paper_small[-1]
    for name in ("ball", "disk"):
        assert coarse.bodies[name].wear.max() == pytest.approx(
            fine.bodies[name].wear.max(), rel=5e-3
        )
    middle = slice(23, 25)
    assert coarse.contact.pressure[middle, middle].mean() == pytest.approx(
        fine.contact.pressure[middle, middle].mean(), rel=0.02
    )


class Warmth(Effect):
    type = "test.warmth"

    provides = (Field("warmth", "1", "Twice as much on the ball as on the disk."),)

    def fields(self, contact: ContactConditions):
        rise = contact.pressure / contact.pressure.max()
        return {"warmth": {"ball": 2 * rise, "disk": rise}}


class Warm(WearLaw):
    type = "test.warm"

    requires = ("warmth",)

    def rate(self, local):
        k = K * (1 + local.fields["warmth"])
        return WearRate(k * local.pressure, k)


def test_a_law_gets_the_fields_it_requires_for_its_own_body():
    law = Warm()
    model = small(bodies=pair(law, law), effects=[Warmth()])
    state = one_step(model)
    p = state.contact.pressure
    rise = p / p.max()
    np.testing.assert_allclose(
        state.bodies["ball"].wear, K * (1 + 2 * rise) * p, atol=1e-6 * K * p.max()
    )


def test_an_error_of_nothing_holds_no_step_back():
    nothing, rounding = (Errors(depth=0.09, pressure=0.37, volume=v) for v in (0.0, 1e-14))
    assert nothing.factor == rounding.factor
