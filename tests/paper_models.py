"""Small models of the paper's test, made from objects."""

import numpy as np
import pytest
from edited import bits

from tribo import Interrupted, Simulation
from tribo.case import Body, Case, Output
from tribo.contact.dcfft import DcFft
from tribo.contact.winkler import Winkler
from tribo.core.fields import WearRate
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.motion.closed_track import Unidirectional
from tribo.motion.reciprocating import Reciprocating
from tribo.observers.observer import Observer
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.stepping.implicit import Implicit
from tribo.surfaces.forms import Flat, Paraboloid, Sphere
from tribo.wear.archard import Archard, Power
from tribo.wear.law import WearLaw

K = 3.11e-16
FOUNDATION = 1.2973e15  # Pa/m: matches Hertz's contact radius in the paper's case


def steel(hardness=None):
    return Material(young="207 GPa", poisson=0.3, hardness=hardness)


def archard(k=K):
    return Archard(k=k)


def power(exponent):
    return Power(k=K, p_exponent=exponent, reference_pressure="1 GPa")


class Faster(WearLaw):
    """Archard's law in proportion to the speed: dh/ds = K p v/(0.1 m/s)."""

    type = "test.faster"

    def rate(self, local):
        k = np.full_like(local.pressure, K * local.speed / 0.1)
        return WearRate(k * local.pressure, k)


def sphere():
    return Sphere(radius="5 mm")


def paraboloid():
    return Paraboloid(radius="5 mm")


def flat():
    return Flat()


def half_space(**values):
    return DcFft(**values)


def foundation(**values):
    return Winkler(**{"modulus": FOUNDATION, **values})


def motion(**values):
    return Reciprocating(
        **{"stroke": "2 mm", "frequency": 25, "duration": 200, "positions": "average", **values}
    )


def named(name, surface, material, wear=None):
    return name, Body(surface=surface, material=material, wear=wear)


def pair(ball=None, disk=None, hardness=(None, None)):
    """A ball on a disk, each with its wear law, or None if it does not wear."""
    return [
        named("ball", sphere(), steel(hardness[0]), ball),
        named("disk", flat(), steel(hardness[1]), disk),
    ]


def case(*, ends_at_window=False, save_times=(), friction_coefficient=None, **changes):
    """The paper's test for 200 s on 48² cells, with changes."""
    parts = {
        "grid": Grid((0.7e-3, 0.7e-3), (48, 48)),
        "load": 100.0,
        "bodies": pair(archard(), archard()),
        "contact": half_space(),
        "kinematics": motion(),
        "stepping": Implicit(),
        **changes,
    }
    grid = parts.pop("grid").model_copy(update={"ends_at_window": ends_at_window})
    return Case(
        grid=grid,
        bodies=dict(parts.pop("bodies")),
        friction=friction_coefficient,
        output=Output(save_times=save_times),
        **parts,
    )


def small(**changes):
    return assemble(case(**changes))


def states(model):
    """Every accepted state, the first contact included."""
    first = begin(model)
    return [first] + [accepted.state for accepted in march(model, first)]


def last(model):
    return states(model)[-1]


def lost(case):
    """The volume that the ball loses in a run of a case or of its model, in m³."""
    with Simulation(case).run() as result:
        return result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"]


def pin(law=None, **changes):
    """A square pin under 10 MPa that slides 1 m: its pressure is even, and it alone wears."""
    parts = {
        "grid": Grid((2e-3, 2e-3), (8, 8)),
        "ends_at_window": True,
        "load": 40.0,
        "bodies": [named("pin", flat(), steel(), law), named("disk", flat(), steel())],
        "contact": foundation(modulus=1e15),
        "kinematics": Unidirectional(speed="0.1 m/s", track_length="8 mm", distance="1 m"),
    }
    return small(**{**parts, **changes})


class StopAfter(Observer):
    """Stops a run after some steps."""

    steps: int = 5

    def on_step(self, snapshot):
        if snapshot.state.steps == self.steps:
            raise KeyboardInterrupt


def goes_on(case, folder, *after):
    """The result of a run, once it is the same to the bit after a stop at some steps."""
    simulation = Simulation(case)
    whole = simulation.run()
    for steps in after:
        path = folder / f"{steps}.h5"
        with pytest.raises(Interrupted):
            simulation.run(path, observers=[StopAfter(steps=steps)])
        with simulation.resume(path) as resumed:
            assert bits(resumed) == bits(whole)
    return whole
