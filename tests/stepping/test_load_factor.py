"""A load that effects make of the state: a spring, a lever, a control."""

import numpy as np
import pytest
from paper_models import (
    archard,
    foundation,
    last,
    motion,
    pair,
    pin,
    small,
    states,
)

from tribo import (
    FRICTION_COEFFICIENT,
    Effect,
    Explicit,
    Grid,
    Implicit,
    PluginError,
    RunningIn,
    Stage,
)
from tribo.contact.periodic import Periodic
from tribo.core.errors import BadValues

GRID = Grid((0.7e-3, 0.7e-3), (32, 32))
FORCE, AREA = 40.0, 4e-6
"""Of the pin, in N and m²."""


class Spring(Effect):
    """A spring that relaxes as the bodies wear: F = F₀ − S h."""

    type = "test.spring"
    relaxes: float
    """Stiffness over the first load, S/F₀, in 1/m."""

    def load_factor(self, snapshot):
        return 1 - self.relaxes * sum(b.max_wear_depth for b in snapshot.measures.bodies.values())


class Control(Effect):
    """Half the load from a wear depth on."""

    type = "test.control"
    depth: float

    def load_factor(self, snapshot):
        first, *_ = snapshot.measures.bodies.values()
        return 0.5 if first.max_wear_depth >= self.depth else 1.0


class Gives(Effect):
    """A factor that is given."""

    type = "test.gives"
    factor: float

    def load_factor(self, snapshot):
        return self.factor


class Rubs(Effect):
    """A coefficient of friction that follows the pressure."""

    type = "test.rubs"
    provides = (FRICTION_COEFFICIENT,)

    def fields(self, contact):
        friction = 0.1 * (1 + contact.pressure / 1e9)
        return {"friction_coefficient": dict.fromkeys(contact.materials, friction)}


def ball(*effects, **changes):
    parts = {"grid": GRID, "contact": foundation(), "kinematics": motion(duration=20)}
    return small(effects=effects, **{**parts, **changes})


@pytest.mark.parametrize("stepping", [Implicit(), Explicit(time_step=0.1)], ids=lambda s: s.type)
def test_steps_follow_the_load_of_a_rigid_pin(stepping):
    # dh/ds = k (F₀ − S h)/A, so that h = F₀/S (1 − exp(−k S s/A)).
    parts = {"stepping": stepping, "contact": foundation(modulus=1e14)}
    model = pin(archard(1e-12), effects=[Spring(relaxes=1e5)], **parts)
    depth = float(np.max(last(model).bodies["pin"].wear))
    rate = 1e-12 * FORCE / AREA
    assert depth == pytest.approx(1e-5 * (1 - np.exp(-1e5 * rate)), rel=0.03, abs=0)


@pytest.mark.parametrize("contact", [foundation(modulus=1e15), Periodic()])
@pytest.mark.parametrize("part", [0.3, 0.5])
def test_a_control_that_jumps_halves_the_load_and_the_run_goes_on(part, contact):
    rate = 1e-12 * FORCE / AREA
    model = pin(archard(1e-12), effects=[Control(depth=part * rate)], contact=contact)
    depth = float(np.max(last(model).bodies["pin"].wear))
    assert depth == pytest.approx((part + 0.5 * (1 - part)) * rate, rel=1e-4, abs=0)


def test_what_yields_at_first_is_under_the_load_that_is_carried():
    def first(load, *effects):
        grid, hard = Grid((1e-3, 1e-3), (24, 24)), pair(hardness=("4 GPa", "4 GPa"))
        return states(ball(*effects, grid=grid, load=load, bodies=hard))[0]

    half, lighter = first(1600.0, Gives(factor=0.5)), first(800.0)
    assert half.reference_depth == lighter.reference_depth
    for name, body in lighter.bodies.items():
        np.testing.assert_array_equal(half.bodies[name].plastic, body.plastic)


@pytest.mark.parametrize("stepping", [Implicit(), Explicit(time_step=0.4)], ids=lambda s: s.type)
def test_several_multiply_and_the_first_contact_carries_what_they_make_of_the_load(stepping):
    model = ball(
        Gives(factor=0.5), Gives(factor=0.4), stepping=stepping, kinematics=motion(duration=1)
    )
    for state in states(model):
        carried = np.sum(state.contact.pressure) * GRID.cell_area
        assert carried == pytest.approx(20, rel=1e-8)
    assert state.load_distance == pytest.approx(20 * 0.1 * 1, rel=1e-12)


def test_half_of_a_ramp_is_the_ramp_of_half_the_load_where_laws_remember_and_friction_varies():
    def run(load, *effects):
        ramp = Stage(at=0, normal=load), Stage(at=4, normal=2 * load)
        law = RunningIn(law=archard(), factor=5.0, over="1 GPa m")
        of = {"bodies": pair(law, law), "load": ramp, "stepping": Explicit(time_step=0.4)}
        return last(ball(Rubs(), *effects, kinematics=motion(duration=4), **of))

    factor, halved = run(80, Gives(factor=0.5)), run(40)
    for name, body in halved.bodies.items():
        np.testing.assert_allclose(factor.bodies[name].wear, body.wear, rtol=1e-7, atol=1e-16)
    assert factor.friction_energy == pytest.approx(halved.friction_energy, rel=1e-9)


@pytest.mark.parametrize("factor", [-0.5, 0.0, float("nan"), float("inf")])
@pytest.mark.parametrize("stepping", [Implicit(), Explicit(time_step=0.4)], ids=lambda s: s.type)
def test_a_factor_that_cannot_be_is_refused_with_its_effect_and_value(factor, stepping):
    with pytest.raises(BadValues, match=f"effect 'test.gives' gave 'load_factor' .* {factor}"):
        last(ball(Gives(factor=factor), stepping=stepping))


def test_a_spring_that_would_pull_ends_the_run_where_it_does():
    with pytest.raises(PluginError, match=r"'test\.spring' gave 'load_factor' that is -.* s\)"):
        last(pin(archard(1e-12), effects=[Control(depth=2e-6), Pulls(depth=2e-6)]))


class Pulls(Control):
    """As a spring that is let go."""

    type = "test.spring"

    def load_factor(self, snapshot):
        return super().load_factor(snapshot) - 0.75
