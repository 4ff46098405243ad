"""The gradient of a run through fields that reach across the contact, by their stated products."""

import numpy as np
import pytest
from gradient_effects import Heat, Softens
from gradients import CLOSE, LONG, SHAPE, TIGHT, Kind, difference, few, kind, resolved, run
from paper_models import K, archard, motion, pair
from tribo.case import Case
from tribo.core.errors import CaseError
from tribo.core.fields import FRICTION_COEFFICIENT
from tribo.effects.effect import Effect
from tribo.simulation.march import begin, march
from tribo.simulation.positions import composed

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import Depth, Volume
from tribo_inverse.adjoint.view import Seeds


class Rubs(Effect):
    """Friction that falls with the pressure of each point."""

    type = "rubs"
    reach = "point"
    most: float = 0.5
    falls: float = 1e9
    provides = (FRICTION_COEFFICIENT,)

    def fields(self, contact):
        friction = self.most / (1 + contact.pressure / self.falls)
        return {"friction_coefficient": dict.fromkeys(contact.materials, friction)}


class Flows(Heat):
    """The heat of friction, which flows to each point from all around, and warms a bulk."""

    type = "flows"
    requires = ("friction_coefficient",)
    reach = "contact"
    strength: float = 2e-9

    def blurred(self, contact, values):
        waves = (np.fft.fftfreq(n) * n / 4 for n in values.shape)
        decay = np.exp(-np.add.outer(*(wave**2 for wave in waves)))
        return np.fft.ifft2(decay * np.fft.fft2(values)).real

    def fields(self, contact):
        friction = contact.fields["friction_coefficient"]["ball"]
        source = friction * contact.pressure * contact.speed**0.5
        found = self.strength * self.blurred(contact, source)
        return {"temperature": dict.fromkeys(contact.materials, found + contact.state["bulk"])}

    def pull_back(self, contact, cotangents):
        by = sum(cotangents["temperature"].values())
        friction = contact.fields["friction_coefficient"]["ball"]
        source = self.strength * contact.speed**0.5 * self.blurred(contact, by)
        total = float(np.sum(source * friction * contact.pressure))
        return {
            "pressure": friction * source,
            "fields.friction_coefficient.ball": contact.pressure * source,
            "state.bulk": np.sum(by, keepdims=True),
            "strength": total / self.strength,
            "speed": 0.5 * total / contact.speed,
        }


FLOWS = [*SHAPE, *(f"effects.{name}" for name in ("1.most", "1.falls", "2.strength", "2.capacity"))]
HOT = {"bodies": pair(Softens(k=K), archard()), "stepping": LONG}
KINDS = {
    "heat that flows": kind(
        Depth("ball"),
        ["load.normal", *(f"kinematics.{of}" for of in ("frequency", "stroke")), *FLOWS],
        effects=[Rubs(), Flows()],
        kinematics=motion(duration=4),
        **HOT,
    ),
    "at several speeds": kind(
        Volume("ball"),
        ["load.normal", *FLOWS],
        effects=[Rubs(), Flows()],
        kinematics=motion(duration=1, waveform="sinusoidal"),
        **HOT,
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_it_is_that_of_the_same_steps(kind):
    assert KINDS[kind].off() < CLOSE


def test_several_positions_are_refused():
    case = run(effects=[Rubs(), Flows()], kinematics=resolved(duration=0.1), **HOT)
    with pytest.raises(CaseError) as refused:
        gradient(case, Volume("ball"), [])
    assert refused.value.path == "kinematics.positions"


STEEL = {"young": "207 GPa", "poisson": 0.3}


def fretting(**motion):
    """A ball of 10 mm on a flat under 100 N, in a few steps."""
    pytest.importorskip("tribo_fretting")
    moves = {"type": "fretting.motion", "frequency": "20 Hz", "cycles": 4e4}
    return Case.model_validate(
        {
            "grid": {"size": "0.5 mm", "cells": 24},
            "load": {"normal": "100 N"},
            "friction": {"coefficient": 0.6},
            "bodies": {
                "ball": {
                    "surface": {"type": "sphere", "radius": "10 mm"},
                    "material": STEEL,
                    "wear": archard(1e-15),
                },
                "flat": {"surface": {"type": "flat"}, "material": STEEL},
            },
            "kinematics": moves | motion,
            "contact": TIGHT,
            "stepping": few(nonlinear_tolerance=1e-13, depth_tolerance=0.03),
        }
    )


RING = Depth("ball", 1.3e-4, 2e-5)
"""A depth in the ring of slip."""


def friction_energy(view):
    """The work of friction by V = (k/μ) W, which holds for the law of Archard."""
    case = view.model.case
    factor = case.friction.coefficient / case.bodies["ball"].wear.k
    volume, seeds = Volume("ball")(view)
    return factor * volume, Seeds({"ball": factor * seeds.wear["ball"]})


def answers(view):
    return np.array([Volume("ball")(view)[0], RING(view)[0], view.state.friction_energy]), None


FRETTING = {
    "partial slip": {"amplitude": "2.2 um", "cycles": 1e5},
    "free on a rig": {"amplitude": "5 um", "stiffness": "50 N/um", "direction": "free"},
    "force held": {"amplitude": "4 um", "force_amplitude": "55 N"},
    "gross slip": {"amplitude": "6 um", "cycles": 2e4},
}
PATHS = ["bodies.ball.wear.k", "friction.coefficient", "kinematics.amplitude", "load.normal"]


@pytest.mark.slow
@pytest.mark.parametrize("name", FRETTING)
def test_depth_volume_and_energy_of_fretting_follow_each_number(name):
    case = fretting(**FRETTING[name])
    model = composed(case)
    states = [accepted.state for accepted in march(model, begin(model))]
    steps = [(state.time, state.distance) for state in states]
    rig = FRETTING[name].keys() & {"stiffness", "force_amplitude"}
    paths = [*PATHS, *(f"kinematics.{key}" for key in rig)]
    random = np.random.default_rng(0)
    change = {path: random.uniform(0.5, 1.5) for path in paths}
    direct = difference(model, steps, answers, change, {}, 1e-5)
    for looks, by in zip((Volume("ball"), RING, friction_energy), direct, strict=True):
        found = gradient(case, looks, paths)
        follows = sum(part * found.relative[path] for path, part in change.items())
        assert follows == pytest.approx(by / found.value, abs=CLOSE)


@pytest.mark.slow
def test_stages_and_friction_of_an_effect_count_in_fretting():
    stages = [{"until": f"{t} s", "amplitude": a} for t, a in ((400, "2.2 um"), (600, "3 um"))]
    case = fretting(amplitude=stages, cycles=None, duration=600)
    changes = {"friction": None, "effects": (Rubs(),)}
    paths = [f"kinematics.amplitude.{stage}.amplitude" for stage in (1, 2)]
    paths += ["effects.1.most", "effects.1.falls", "load.normal", *SHAPE]
    paths = [path.replace("disk", "flat") for path in paths]
    assert Kind(case.model_copy(update=changes), Volume("ball"), paths, 1e-5).off() < CLOSE
