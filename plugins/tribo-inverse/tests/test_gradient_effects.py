"""The gradient of a run whose laws follow what lies between the bodies."""

import numpy as np
import pytest
from gradient_effects import (
    Buried,
    Dust,
    Grains,
    Grows,
    Heat,
    Levers,
    Mirrors,
    Sinks,
    Slips,
    Softens,
)
from gradients import BASE, CLOSE, FRESH, LONG, SHAPE, few, kind, resolved, run
from paper_models import K, archard, motion, pair
from tribo.core.errors import CaseError

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import Depth, Pressure, Volume
from tribo_inverse.increment import response


def pauses(**changes):
    """A motion that rests from 1 s to 3 s."""
    stages = [{"until": until, "frequency": by} for until, by in ((1, 25), (3, 0), (4, 25))]
    return motion(**{"duration": 4, "frequency": stages} | changes)


SLOW = few(nonlinear_tolerance=1e-11, cycle_tolerance=1e-11)
"""What fills the gap has no slope, and a step takes many passes."""


def briefly(objective, paths, part=1e-5, **changes):
    given = {"stepping": SLOW, "kinematics": motion(duration=1.5)} | changes
    return kind(objective, paths, part, **given)


OF_GRAINS = [f"effects.1.{name}" for name in ("begins", "cover", "stays")]
METAL = {"young": "207 GPa", "poisson": 0.3, "properties": {"leads": "45 W/(m K)"}}
KINDS = {
    "grains": briefly(Depth("disk"), [*BASE, *SHAPE, *OF_GRAINS], effects=[Grains()]),
    "dust": briefly(
        Depth("disk"),
        ["load.normal", "bodies.ball.wear.over", "bodies.disk.wear.k", *SHAPE, *OF_GRAINS],
        bodies=pair(FRESH, archard()),
        effects=[Dust()],
    ),
    "grains, positions": briefly(
        Depth("disk", 5e-5),
        ["load.normal", *SHAPE, *OF_GRAINS],
        kinematics=resolved(duration=0.1, waveform="sinusoidal"),
        bodies=pair(FRESH, archard()),
        effects=[Grains(on="disk")],
    ),
    "grains on each body": briefly(
        Depth("disk"),
        [*BASE, *SHAPE, *OF_GRAINS, *(name.replace("0", "1") for name in OF_GRAINS)],
        bodies=pair(Buried(k=K), Buried(k=K)),
        effects=[Dust(on="ball"), Dust(on="disk", begins=1e-7, stays=1.0)],
    ),
    "heat": kind(
        Depth("ball"),
        [
            *("load.normal.1.normal", "load.normal.2.normal", "kinematics.frequency"),
            *("effects.1.flash", "effects.1.capacity", "bodies.ball.wear.k", *SHAPE),
        ],
        load=[{"at": 0, "normal": 10.0}, {"at": 4, "normal": 20.0}],
        bodies=pair(Softens(k=K), archard()),
        effects=[Heat()],
        kinematics=motion(duration=4),
        stepping=LONG,
    ),
    "slip": briefly(Depth("disk"), [*BASE, *SHAPE, "effects.1.most"], effects=[Slips()]),
    "heat through a body that does not wear": kind(
        Depth("ball"),
        ["bodies.disk.material.properties.leads"],
        bodies={
            "ball": {"surface": {"type": "sphere", "radius": "5 mm"}, "material": METAL}
            | {"wear": Softens(k=K)},
            "disk": {"surface": {"type": "flat"}, "material": METAL},
        },
        effects=[Sinks()],
        kinematics=motion(duration=4),
        stepping=LONG,
    ),
    "rest": briefly(
        {2.0: Pressure(2e-5, 0), 4.0: Depth("disk")},
        [
            *("load.normal.1.normal", "load.normal.2.normal", *SHAPE, "bodies.ball.wear.over"),
            *(f"effects.1.{name}" for name in ("begins", "rate", "stays")),
            *(f"kinematics.frequency.{name}" for name in ("1.frequency", "1.until", "2.until")),
        ],
        1e-4,
        seed=1,
        load=[{"at": 0, "normal": 10.0}, {"at": 4, "normal": 20.0}],
        bodies=pair(FRESH, archard()),
        effects=[Grows()],
        kinematics=pauses(),
        save_times=(2.0,),
    ),
    "rest, of one temperature": kind(
        {2.0: Pressure(2e-5, 0), 4.0: Depth("ball")},
        ["load.normal", "effects.1.capacity", *SHAPE, "kinematics.frequency.2.until"],
        1e-4,
        bodies=pair(Softens(k=K), archard()),
        effects=[Heat()],
        kinematics=pauses(),
        stepping=LONG,
        save_times=(2.0,),
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_it_is_that_of_the_same_steps(kind):
    assert KINDS[kind].off() < CLOSE


@pytest.mark.parametrize(
    "effects",
    [[Mirrors()], [Levers()]],
    ids=["undeclared", "load"],
)
def test_what_is_not_covered_is_refused(effects):
    bodies = pair(Softens(k=K), archard())
    case = run(bodies=bodies, stepping=LONG, effects=effects, kinematics=motion(duration=1))
    with pytest.raises(CaseError) as refused:
        gradient(case, Volume("ball"), [])
    assert refused.value.path == "effects"


def test_the_load_and_the_area_are_told_apart_where_pressures_are_nearly_even():
    random = np.random.default_rng(1)
    pressure = 1e8 * (1 + 2e-3 * random.uniform(-1, 1, (1, 8, 8)))

    def rates(p):
        return [np.sum(p) * np.sqrt(np.sum(p**2)) * np.ones_like(p)]

    by = 1e-5 * pressure * random.uniform(-1, 1, pressure.shape)
    ((higher,), (lower,)) = rates(pressure + by), rates(pressure - by)
    (found,) = response.shared(rates, pressure)
    np.testing.assert_allclose(found.change(pressure, 2 * by), higher - lower, rtol=1e-5)
