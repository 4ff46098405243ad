"""The gradient of a run whose laws follow what lies between the bodies."""

from dataclasses import replace

import numpy as np
import pytest
from gradients import (
    BASE,
    CLOSE,
    FRESH,
    LONG,
    SHAPE,
    Kind,
    few,
    forgotten,
    layered,
    resolved,
    run,
    unbroken,
    unfelt,
    without,
    zero,
)
from paper_models import K, archard, motion, pair
from tribo.core.errors import CaseError
from tribo.core.fields import LOAD_SHARE, Field
from tribo.effects.effect import Effect
from tribo.integration import integrator
from tribo.stepping.explicit import Explicit
from tribo.wear.archard import Archard
from tribo.wear.modified import times

from tribo_inverse.adjoint import backwards, parameters
from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import Depth, Pressure, Volume
from tribo_inverse.increment import carriers, remembering, response, slopes
from tribo_inverse.recording import tape


class Grains(Effect):
    """What wear leaves, which lifts the bodies apart and takes its part of the load."""

    type = "grains"
    reach = "point"
    begins: float = 2e-8
    cover: float = 1e-6
    stays: float = 2.0
    on: str | None = None
    state_fields = (Field("grains", "m", "Height of grains.", at_least=0, fills=True),)
    provides = (LOAD_SHARE,)

    def carrier(self):
        return self.on

    def initial_state(self):
        return {"grains": self.begins}

    def fields(self, contact):
        share = -np.expm1(-contact.state["grains"] / self.cover)
        return {"load_share": dict.fromkeys(contact.materials, share)}

    def state_rates(self, contact):
        caught = sum(contact.wear_rates.values())
        leaves = contact.state["grains"] / self.stays * (contact.pressure > 0)
        return {"grains": contact.speed * (caught - leaves)}


class Dust(Grains):
    """Such grains that are too few to lift the bodies, so that each point follows its own cells."""

    type = "dust"
    state_fields = (Field("grains", "m", "Height of grains.", at_least=0),)


class Heat(Effect):
    """A temperature after the load and the area of the contact, and of a bulk that warms."""

    type = "heat"
    reach = "contact"
    flash: float = 1e-2
    capacity: float = 2.0
    provides = (Field("temperature", "K", "Above that around."),)
    state_fields = (Field("bulk", "K", "Of the bodies, above that around.", uniform=True),)

    def power(self, contact):
        return 0.1 * contact.speed * np.sum(contact.pressure) * contact.grid.cell_area

    def fields(self, contact):
        p = contact.pressure
        area = np.sum(p) ** 2 / np.sum(p**2) * contact.grid.cell_area
        found = contact.state["bulk"] + self.flash * self.power(contact) / np.sqrt(area)
        return {"temperature": dict.fromkeys(contact.materials, found)}

    def state_rates(self, contact):
        rate = (self.power(contact) - 0.005 * contact.state["bulk"]) / self.capacity
        return {"bulk": np.reshape(rate, (1, 1))}


class Sinks(Heat):
    """Of which both bodies lead the more away the better they conduct."""

    def power(self, contact):
        leads = sum(material.conductivity for material in contact.materials.values())
        return 90.0 / leads * super().power(contact)


class Softens(Archard):
    type = "softens"
    requires = ("temperature",)

    def rate(self, local):
        return times(np.exp(0.02 * local.fields["temperature"]), super().rate(local))


class Mirrors(Effect):
    """A temperature that follows the pressure at the other side."""

    type = "mirrors"
    provides = Heat.provides

    def fields(self, contact):
        beyond = 1e-8 * contact.pressure[:, ::-1]
        return {"temperature": dict.fromkeys(contact.materials, beyond)}


class Blurs(Effect):
    """A temperature that follows the pressure beside each point."""

    type = "blurs"
    reach = (0, 3)
    provides = Heat.provides

    def fields(self, contact):
        beside = 1e-8 * np.roll(contact.pressure, 3, axis=1)
        return {"temperature": dict.fromkeys(contact.materials, beside)}


class Far(Blurs):
    """Such a temperature, of an effect that says that it may come from further away."""

    type = "far"
    reach = (2, 3)


class Grows(Effect):
    """A layer that grows under pressure in time, at rest too, and flows off."""

    type = "grows"
    reach = "point"
    begins: float = 2e-8
    rate: float = 5e-17
    stays: float = 5.0
    state_fields = (Field("grown", "m", "Height of the layer.", at_least=0, fills=True),)

    def initial_state(self):
        return {"grown": self.begins}

    def state_rates(self, contact):
        return {"grown": self.rate * contact.pressure - contact.state["grown"] / self.stays}


class Creeps(Grows):
    """Such a layer that also spreads, the faster the thicker it is, and wear lands beside it."""

    type = "creeps"
    reach = (1, 1)
    spreads: float = 0.05
    over: float = 1e-7
    on: str | None = None

    def carrier(self):
        return self.on

    def state_rates(self, contact):
        height = contact.state["grown"]
        flow = height * (1 + height / self.over)
        rate = -4 * flow
        for axis in (0, 1):
            rate += np.roll(flow, 1, axis) + np.roll(flow, -1, axis)
        lands = contact.speed * np.roll(sum(contact.wear_rates.values()), 1, axis=1)
        grown = super().state_rates(contact)["grown"]
        return {"grown": grown + self.spreads * rate + 0.1 * lands}


def pauses(**changes):
    """A motion that rests from 1 s to 3 s."""
    stages = [{"until": until, "frequency": by} for until, by in ((1, 25), (3, 0), (4, 25))]
    return motion(**{"duration": 4, "frequency": stages} | changes)


SLOW = few(nonlinear_tolerance=1e-11, cycle_tolerance=1e-11)
"""What fills the gap has no slope, and a step takes many passes."""
OF_GRAINS = [f"effects.0.{name}" for name in ("begins", "cover", "stays")]
KINDS = {
    "grains": Kind(
        run(effects=[Grains()], kinematics=motion(duration=1.5), stepping=SLOW),
        Depth("disk"),
        [*BASE, *SHAPE, *OF_GRAINS],
        1e-5,
    ),
    "dust": Kind(
        run(
            bodies=pair(FRESH, archard()),
            effects=[Dust()],
            kinematics=motion(duration=1.5),
            stepping=SLOW,
        ),
        Depth("disk"),
        ["load.normal", "bodies.ball.wear.over", "bodies.disk.wear.k", *SHAPE, *OF_GRAINS],
        1e-5,
    ),
    "grains, positions": Kind(
        run(
            kinematics=resolved(duration=0.1, waveform="sinusoidal"),
            bodies=pair(FRESH, archard()),
            effects=[Grains(on="disk")],
            stepping=SLOW,
        ),
        Depth("disk", 5e-5),
        ["load.normal", *SHAPE, *OF_GRAINS],
        1e-5,
    ),
    "heat": Kind(
        run(
            load=[{"at": 0, "normal": 10.0}, {"at": 4, "normal": 20.0}],
            bodies=pair(Softens(k=K), archard()),
            effects=[Heat()],
            kinematics=motion(duration=4),
            stepping=LONG,
        ),
        Depth("ball"),
        [
            *("load.normal.0.normal", "load.normal.1.normal", "kinematics.frequency"),
            *("effects.0.flash", "effects.0.capacity", "bodies.ball.wear.k", *SHAPE),
        ],
        1e-5,
    ),
}
METAL = {"young": "207 GPa", "poisson": 0.3, "conductivity": 45.0}
KINDS["explicit, beside heat that no law follows"] = Kind(
    run(
        kinematics=motion(duration=4),
        load=[{"at": 0, "normal": 10.0}, {"at": 4, "normal": 20.0}],
        effects=[Heat()],
        stepping=Explicit(time_step=1, allow_unstable=True),
    ),
    Depth("ball"),
    ["load.normal.0.normal", "load.normal.1.normal", "bodies.ball.wear.k"],
    1e-5,
)
KINDS["heat through a body that does not wear"] = Kind(
    run(
        bodies={
            "ball": {"surface": {"type": "sphere", "radius": "5 mm"}, "material": METAL}
            | {"wear": Softens(k=K)},
            "disk": {"surface": {"type": "flat"}, "material": METAL},
        },
        effects=[Sinks()],
        kinematics=motion(duration=4),
        stepping=LONG,
    ),
    Depth("ball"),
    ["bodies.disk.material.conductivity"],
    1e-5,
)
KINDS["rest"] = Kind(
    run(
        load=[{"at": 0, "normal": 10.0}, {"at": 4, "normal": 20.0}],
        bodies=pair(FRESH, archard()),
        effects=[Grows()],
        kinematics=pauses(),
        stepping=SLOW,
        save_times=(2.0,),
    ),
    {2.0: Pressure(2e-5, 0), 4.0: Depth("disk")},
    [
        *("load.normal.0.normal", "load.normal.1.normal", *SHAPE, "bodies.ball.wear.over"),
        *(f"effects.0.{name}" for name in ("begins", "rate", "stays")),
        *(f"kinematics.frequency.{name}" for name in ("0.frequency", "0.until", "1.until")),
    ],
    1e-4,
    # Others nearly cancel each other.
    seed=1,
)
KINDS["rest, of one temperature"] = Kind(
    run(
        bodies=pair(Softens(k=K), archard()),
        effects=[Heat()],
        kinematics=pauses(),
        stepping=LONG,
        save_times=(2.0,),
    ),
    {2.0: Pressure(2e-5, 0), 4.0: Depth("ball")},
    ["load.normal", "effects.0.capacity", *SHAPE, "kinematics.frequency.1.until"],
    1e-4,
)
KINDS["spreads"] = Kind(
    run(
        bodies=pair(FRESH, archard()),
        effects=[Creeps()],
        kinematics=motion(duration=1),
        stepping=SLOW,
    ),
    Depth("disk"),
    [*BASE[:1], *SHAPE, *(f"effects.0.{name}" for name in ("rate", "stays", "spreads", "over"))],
    1e-5,
)
KINDS["pressure beside"] = Kind(
    run(bodies=pair(Softens(k=K), archard()), effects=[Blurs()], stepping=LONG),
    Depth("ball"),
    ["load.normal", "bodies.ball.wear.k", *SHAPE],
    1e-5,
)
KINDS["layers"] = Kind(
    run(
        bodies=layered(None, ("0.43 nm", archard(2 * K))),
        effects=[Grains()],
        kinematics=motion(duration=0.1),
        stepping=SLOW,
    ),
    Depth("disk"),
    ["load.normal", *SHAPE, "bodies.disk.layers.0.thickness", *OF_GRAINS],
    1e-6,
)
KINDS["layers, pressure beside"] = Kind(
    run(
        bodies=layered(("0.05 um", archard(K / 2)), ("0.002 um", archard(2 * K)), Softens(k=K)),
        effects=[Blurs()],
        kinematics=motion(duration=4),
        stepping=LONG,
    ),
    Depth("ball"),
    ["load.normal", *SHAPE, "bodies.disk.layers.0.thickness", "bodies.ball.wear.k"],
    1e-6,
)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_it_is_that_of_the_same_steps(kind):
    assert KINDS[kind].off() < CLOSE


def unheard(method):
    """What an effect makes of the wear of bodies, left out."""

    def mutant(self, states, passed, found, reach):
        depths = range(len(self.model.laws.wear))
        return [
            [response.Response(rate * (at == i)) for i, rate in enumerate(found)] for at in depths
        ]

    return mutant


def unrested(method):
    return lambda self, record: None if rests(record.slid) else method(self, record)


def unseen(method):
    """What an objective makes of the contact during a rest, left out."""

    def mutant(self, record):
        if rests(record.slid):
            self.pressure = None
        method(self, record)

    return mutant


def as_it_is(method):
    return lambda self, slid, *given: () if rests(slid) else method(self, slid, *given)


def rests(slid):
    return slid is not None and slid.interval.rests


def alone(method):
    return lambda seeds, responses: method(seeds, [replace(r, beside={}) for r in responses])


def of_each_alone(method):
    return lambda self, states, place, found, reach: method(self, states, place, found, (0, 0))


def narrowed(method):
    """What touches, less a cell on each side."""

    def mutant(self, record):
        method(self, record)
        if isinstance(record, tape.Pressed):
            self.touched = tuple(slice(s.start + 1, s.stop - 1) for s in record.region)

    return mutant


MUTANTS = [
    ("dust", tape.Tape, "append", narrowed),
    ("spreads", slopes, "back", alone),
    ("spreads", slopes.Sloping, "_by_factor", of_each_alone),
    ("rest", backwards.Backwards, "press", unrested),
    ("rest, of one temperature", backwards.Backwards, "press", unseen),
    ("rest", parameters.Chain, "by_wear", as_it_is),
    ("grains", slopes.Sloping, "_by_pressure", unfelt("own")),
    ("grains", remembering.Remembering, "_back", forgotten),
    ("grains", slopes.Sloping, "_by_factor", unheard),
    ("grains", backwards.Backwards, "_filled", lambda _: lambda self, states, *given: states),
    ("grains", backwards.Backwards, "_of_wear", zero),
    ("grains", parameters.Chain, "by_rest", without("gap")),
    ("heat", slopes.Sloping, "_by_pressure", unfelt("load")),
    ("heat", slopes.Sloping, "_by_pressure", unfelt("square")),
    ("heat", carriers.Uniform, "gathered", zero),
    ("heat", remembering.Together, "is_pointwise", lambda _: property(lambda self: True)),
    ("layers", integrator, "stepped_back", unbroken),
    ("layers, pressure beside", integrator, "stepped_back", unbroken),
]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "owner", "method", "change"), MUTANTS)
def test_each_term_counts(monkeypatch, kind, owner, method, change):
    monkeypatch.setattr(owner, method, change(getattr(owner, method)))
    try:
        missed = KINDS[kind].off()
    except CaseError:
        # The changes of all parts together are not what the mutant says of each.
        return
    assert missed > 10 * CLOSE


@pytest.mark.parametrize(
    "effects", [[Mirrors()], [Far()], [Heat(), Creeps()]], ids=["undeclared", "far", "both"]
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
