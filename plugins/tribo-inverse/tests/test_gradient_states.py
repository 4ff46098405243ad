"""The gradient of a run whose laws keep a state, or whose bodies have layers."""

import numpy as np
import pytest
from gradients import (
    CLOSE,
    FINE,
    FRESH,
    LONG,
    MIDDLE,
    OF_FRESH,
    OF_SMOOTH,
    RAMP,
    SHAPE,
    SMALL,
    SMOOTH,
    STAGES,
    Kind,
    kind,
    layered,
    resolved,
    run,
)
from paper_models import Faster, K, archard, motion, pair
from tribo import WearLaw, WearRate
from tribo.contact.winkler import Winkler
from tribo.wear.running_in import RunningIn

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import Depth

OF_SPEED = RunningIn(law=Faster(), factor=4.0, over="1 GPa m")
FAST = RunningIn(law=archard(2 * K), factor=4.0, over="0.5 GPa m")
SLOW = SMOOTH.model_copy(update={"law": archard(K / 2), "depth": 1e-7})
FLEETING = SMOOTH.model_copy(update={"law": archard(4 * K), "depth": 5e-9})
"""Of which a cell, in a step of many parts, would lose many times the roughness there is."""
OF_BALL = ["bodies.ball.layers.1.thickness", "bodies.ball.layers.1.wear.law.k"]
OF_LAYER = ["bodies.disk.layers.1.thickness", "bodies.disk.layers.1.wear.over"]


class Stiff(WearLaw):
    """A wear law that reads Young's modulus of the material that wears."""

    type = "stiff"

    def rate(self, local):
        k = K * local.material.young / 2e11
        return WearRate(k * local.pressure, np.full_like(local.pressure, k))


def exact(objective, paths, part=1e-5, **changes):
    return kind(objective, paths, part, **{"stepping": LONG} | changes)


KINDS = {
    "comes to rest": exact(
        Depth("ball"),
        ["bodies.ball.wear.settled"],
        bodies=pair(SMOOTH.model_copy(update={"depth": 1e-8}), None),
    ),
    "remembers, follows the speed": exact(
        Depth("ball"),
        [*STAGES[:2], *SHAPE, *OF_FRESH[:2], "kinematics.frequency", "kinematics.stroke"],
        load=RAMP[:2],
        kinematics=motion(duration=5),
        bodies=pair(OF_SPEED),
    ),
    "layers, reads its material below": exact(
        Depth("disk"),
        ["bodies.disk.material.young"],
        bodies=layered(None, ("0.01 um", archard()), archard(), Stiff()),
    ),
    "layers, remembers": exact(
        Depth("disk"),
        ["load.normal", *SHAPE, *OF_LAYER, "bodies.disk.wear.over"],
        1e-6,
        bodies=layered(None, ("0.05 um", FAST), archard(), FRESH),
        kinematics=motion(duration=5),
    ),
    "load on a plateau, remembers": exact(
        Depth("disk"),
        ["load.normal.2.normal", "load.normal.3.normal"],
        load=[{"at": 0, "normal": 10.0}, {"at": 10, "normal": 20.0}, {"at": 20, "normal": 20.0}],
        bodies=pair(FRESH, archard()),
    ),
    "layers, remembers for a small part of a step": exact(
        Depth("disk"),
        ["load.normal", "bodies.disk.layers.1.thickness"],
        1e-6,
        grid=SMALL,
        bodies=layered(None, ("0.01 um", SLOW), None, FLEETING),
        kinematics=motion(duration=4),
    ),
    "layers, passed late in a step, remembers": exact(
        Depth("ball"),
        ["load.normal", "bodies.ball.layers.1.thickness", "bodies.ball.wear.over"],
        grid=FINE,
        bodies=layered(("0.05 um", archard()), of_ball=FRESH),
        kinematics=motion(duration=1.75537),
        save_times=(0.63749,),
    ),
    "layers, parts cut off": exact(
        Depth("ball"),
        ["load.normal", "bodies.disk.layers.1.thickness", "bodies.disk.wear.depth"],
        contact=Winkler(plasticity=False),
        bodies=layered(None, ("0.05 um", archard(2 * K)), SMOOTH, SMOOTH),
        kinematics=motion(duration=5),
    ),
    "positions, layers, remembers": exact(
        Depth("disk", 5e-5),
        ["load.normal", *SHAPE, *OF_BALL, "bodies.ball.wear.over"],
        1e-6,
        grid=FINE,
        bodies=layered(("0.02 um", FAST), ("0.004 um", archard(2 * K)), FRESH, archard()),
        kinematics=resolved(duration=0.25),
    ),
    "positions, remembers": exact(
        Depth("disk", 5e-5),
        ["load.normal", *SHAPE, *OF_FRESH, *OF_SMOOTH, "kinematics.stroke"],
        1e-6,
        kinematics=resolved(stroke="0.13 mm", waveform="sinusoidal", duration=0.4),
        bodies=pair(FRESH, SMOOTH),
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_that_of_the_same_steps(kind):
    assert KINDS[kind].off() < CLOSE


@pytest.mark.parametrize("below", [FRESH, archard(8 * K)], ids=["remembers", "steady"])
def test_a_point_just_above_the_bottom_of_a_layer_passes_it(below):
    def layer(thickness):
        return run(
            grid=MIDDLE,
            contact=Winkler(plasticity=False),
            bodies=layered((thickness, archard()), of_ball=below),
            kinematics=motion(duration=6),
            stepping=LONG,
            save_times=(5.0,),
        )

    depth = gradient(layer("1 um"), {5.0: Depth("ball")}, []).value
    paths = ["bodies.ball.layers.1.thickness", "load.normal"]
    assert Kind(layer(depth * (1 + 5e-6)), Depth("ball"), paths, 1e-6).off() < CLOSE
