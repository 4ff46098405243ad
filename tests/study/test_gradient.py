"""The gradient of a run is that of the same steps taken with other inputs."""

from functools import cache
from inspect import signature

import numpy as np
import pytest
from gradients import difference, taken
from paper_models import K, archard, case, flat, half_space, motion, named, sphere, states, steel
from scipy.optimize import minimize

from tribo.case import Body, Layer, Stop
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.core.errors import CaseError, NumericalError
from tribo.core.fields import Field
from tribo.core.grid import Grid
from tribo.effects.effect import Effect
from tribo.motion.rotating import Rotating
from tribo.motion.unidirectional import Unidirectional
from tribo.simulation.positions import composed
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.study.gradient import backwards, course, linear, local, parameters, tape
from tribo.study.gradient.gradient import ValueAndGradient, gradient
from tribo.study.gradient.objective import Deepest, Depth, Misfit, Pressure, Volume
from tribo.study.gradient.sensitivity import sensitivity
from tribo.surfaces.cylinder import Cylinder
from tribo.surfaces.waves import Waves
from tribo.wear.archard import Archard
from tribo.wear.modified import times
from tribo.wear.power import Power
from tribo.wear.running_in import RunningIn, Smoothing

CLOSE = 1e-6
"""As near as differences of runs come, whose contacts are solved to 1e-12."""
WINDOW = Grid(("0.5 mm", "0.5 mm"), (16, 16))
ODD = Grid(("0.46875 mm", "0.5 mm"), (15, 16))
"""With one deepest cell in each row, where two would have a derivative to each side."""
TIGHT = half_space(tolerance=1e-12)
BASE = ["load.normal", "bodies.ball.wear.k", "bodies.disk.wear.k", "kinematics.frequency"]
SHAPE = ["bodies.ball.surface.radius", "bodies.ball.material.young", "bodies.disk.material.poisson"]


def few(**values):
    """Steps so long that a run has a handful of them."""
    return Implicit(
        **{"depth_tolerance": 0.1, "pressure_tolerance": 0.5, "settle": 1, "max_passes": 500}
        | values
    )


def power(exponent):
    return Power(k=K, p_exponent=exponent, reference_pressure="1 GPa")


def pair(ball, disk, hardness=(None, None)):
    return [
        named("ball", sphere(), steel(hardness[0]), ball),
        named("disk", flat(), steel(hardness[1]), disk),
    ]


def run(**changes):
    parts = {"grid": WINDOW, "load": 20.0, "contact": TIGHT, "stepping": few()}
    return case(**{**parts, "kinematics": motion(duration=20), **changes})


def resolved(**changes):
    return motion(stroke="0.125 mm", positions=5, frequency=100, duration=20, **changes)


def flats():
    waves = Waves(wavelength="32 um", amplitude="0.2 um")
    slides = Unidirectional(speed=0.1, distance=5.0, track_length=1.0, positions=5)
    return run(
        grid=Grid(("64 um", "64 um"), (16, 16)),
        load=1.0,
        contact=Periodic(tolerance=1e-12),
        kinematics=slides,
        bodies=[
            named("ball", waves, steel(), archard()),
            named("disk", flat(), steel(), archard()),
        ],
    )


RAMP = [
    {"at": 0, "normal": 10.0},
    {"at": 10, "normal": 20.0},
    {"until": 15, "normal": 40.0},
    {"until": 21, "normal": 20.0},
]
LINE = [named("ball", Cylinder(radius="5 mm"), steel(), archard()), named("disk", flat(), steel())]
LAYERED = [
    (name, Body(surface=body, material=steel(), wear=archard(), layers=[layer]))
    for name, body, layer in (
        ("ball", sphere(), Layer(thickness="0.3 um", wear=archard(K / 2))),
        ("disk", flat(), Layer(thickness="0.05 um", wear=archard(2 * K))),
    )
]
YIELDING = pair(archard(), archard(), ("1.2 GPa", "1.1 GPa"))
SOFT = pair(archard(), archard(), ("1.1 GPa", "1 GPa"))
STAGES = ["load.normal.0.normal", "load.normal.1.normal", "load.normal.2.normal"]
HARD = "bodies.disk.material.hardness"


class Turns(Effect):
    type = "turns"
    state_fields = (Field("turns", "m", "Distance slid.", uniform=True),)

    def state_rates(self, contact):
        return {"turns": np.full((1, 1), contact.speed)}


class Follows(Archard):
    type = "follows"
    requires = ("turns",)


class Brisk(Archard):
    type = "brisk"

    def rate(self, local):
        return times(np.sqrt(1e9 * local.speed / local.material.hardness), super().rate(local))


FRESH = RunningIn(law=archard(), factor=4.0, over="1 GPa m")
SMOOTH = Smoothing(law=archard(), factor=3.0, roughness="0.4 um", settled="0.1 um", depth="0.2 um")
OF_FRESH = ["bodies.ball.wear.over", "bodies.ball.wear.factor", "bodies.ball.wear.law.k"]
OF_SMOOTH = ["bodies.disk.wear.roughness", "bodies.disk.wear.depth", "bodies.disk.wear.law.k"]
LONG = few(nonlinear_tolerance=1e-13, cycle_tolerance=1e-12)

KINDS = {
    "remembers": (
        run(bodies=pair(FRESH, SMOOTH), stepping=LONG),
        Depth("disk"),
        ["load.normal", *SHAPE, *OF_FRESH, *OF_SMOOTH, "kinematics.frequency"],
        1e-5,
    ),
    "layers": (
        run(bodies=LAYERED, stepping=LONG),
        Depth("disk"),
        [
            *("load.normal", *SHAPE, "bodies.ball.wear.k", "bodies.ball.layers.0.wear.k"),
            *("bodies.ball.layers.0.thickness", "bodies.disk.layers.0.thickness"),
        ],
        1e-6,
    ),
    "average": (run(), Deepest("disk"), [*BASE, *SHAPE, "kinematics.stroke"], 1e-4),
    "pressure": (run(), Pressure(2e-5, 0), [*BASE, *SHAPE], 1e-4),
    "springs": (
        run(
            contact=Winkler(plasticity=False),
            bodies=pair(archard(), Brisk(k=K), ("2 GPa", "1 GPa")),
        ),
        Depth("ball"),
        [*BASE, *SHAPE, HARD],
        1e-5,
    ),
    "nonlinear": (
        run(bodies=pair(power(1.5), power(2.0)), stepping=few(nonlinear_tolerance=1e-13)),
        Depth("disk"),
        [*BASE, *SHAPE, "bodies.ball.wear.p_exponent"],
        1e-6,
    ),
    "yields": (run(grid=ODD, bodies=YIELDING), Depth("disk"), [*BASE, *SHAPE, HARD], 1e-6),
    "load over time": (
        run(load=RAMP, bodies=pair(FRESH, archard()), stepping=LONG),
        {20.0: Depth("disk")},
        [*STAGES, *OF_FRESH, "load.normal.1.at", "load.normal.2.until"],
        1e-5,
    ),
    "positions": (
        run(kinematics=resolved(), stepping=few(cycle_tolerance=1e-12)),
        Depth("disk", 5e-5),
        [*BASE, *SHAPE],
        1e-5,
    ),
    "positions, yields": (
        run(grid=ODD, kinematics=resolved(), bodies=SOFT, stepping=few(cycle_tolerance=1e-12)),
        Depth("disk", 5e-5),
        [*BASE, HARD],
        1e-6,
    ),
    "positions, remembers": (
        run(
            kinematics=motion(
                stroke="0.125 mm", positions=5, frequency=100, duration=1, waveform="sinusoidal"
            ),
            bodies=pair(FRESH, SMOOTH),
            stepping=LONG,
        ),
        Depth("disk", 5e-5),
        ["load.normal", *SHAPE, *OF_FRESH, *OF_SMOOTH],
        1e-5,
    ),
    "repeating": (flats(), Depth("ball"), ["load.normal", "bodies.ball.surface.amplitude"], 1e-5),
    "rows of their own speed": (
        run(
            kinematics=Rotating(track_radius="1.5 mm", speed=0.1, duration=20.0),
            bodies=pair(power(1.5), archard()),
            stepping=few(nonlinear_tolerance=1e-13),
        ),
        Depth("disk"),
        ["load.normal", "kinematics.speed", "kinematics.track_radius"],
        1e-5,
    ),
    "line": (
        run(bodies=LINE, ends_at_window=True, load=10.0),
        Volume("ball"),
        ["bodies.ball.wear.k"],
        1e-5,
    ),
}


@cache
def varied(kind):
    """Random changes of all inputs of a kind of run, and the difference along them."""
    case, objective, paths, part = KINDS[kind]
    model, random = composed(case), np.random.default_rng(0)
    numbers = {path: random.uniform(0.5, 1.5) for path in paths}
    own = {name: (each.rows, model.grid.cells[1]) for name, each in model.exposures.items()}
    sizes = {"wear_rate": 1.0, "height": 1e-8}
    if model.system.cap is None:
        # What a run begins with would yield anew.
        sizes["worn_before"] = 1e-8
    maps = {
        which: {
            name: size * random.uniform(0.5, 1.5, shape)
            for name, shape in own.items()
            if name in model.laws or which != "wear_rate"
        }
        for which, size in sizes.items()
    }
    return numbers, maps, difference(model, taken(model), objective, numbers, maps, part)


def off(kind):
    """By how much the gradient misses the difference, relative to it."""
    case, objective, paths, _ = KINDS[kind]
    numbers, maps, direct = varied(kind)
    found = gradient(case, objective, paths)
    follows = sum(change * found.relative[path] * found.value for path, change in numbers.items())
    for which, of_bodies in maps.items():
        for name, change in of_bodies.items():
            follows += float(np.sum(getattr(found, which)[name] * change))
    return abs(follows - direct) / abs(direct)


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_that_of_the_same_steps(kind):
    assert off(kind) < CLOSE


def without(name):
    """A method that is given 0 in place of one of its arguments."""

    def made(method):
        given = signature(method)

        def mutant(*values):
            bound = given.bind(*values)
            bound.arguments[name] = 0 * bound.arguments[name]
            return method(*bound.args)

        return mutant

    return made


def nothing(method):
    return lambda *values: None


def zero(method):
    return lambda *values: 0.0 * method(*values)


MUTANTS = [
    ("average", parameters.Chain, "by_load", zero),
    ("average", parameters.Chain, "by_wear", zero),
    ("average", parameters.Chain, "by_rest", without("gap")),
    ("average", parameters.Chain, "by_rest", without("stiffness")),
    ("average", linear.Carrier, "gathered", zero),
    ("average", linear.Carrier, "seen", zero),
    ("average", linear.StepSystem, "solve", without("given")),
    ("pressure", backwards._Back, "look", nothing),
    ("springs", local.WatchedLaw, "rate", lambda _: lambda of, told: of._law.rate(told)),
    ("yields", parameters.Chain, "by_rest", without("cap")),
    ("yields", linear.StepSystem, "solve", without("fixed")),
    ("yields", backwards._Back, "spread_out", nothing),
    ("yields", backwards._Back, "_gave", zero),
    ("positions", linear.Carrier, "gathered", zero),
    ("remembers", course._Asked, "by_pressure", lambda of: lambda *g: [0 * d for d in of(*g)]),
    ("remembers", course._Asked, "back", lambda of: lambda *g: (of(*g)[0], [0 * s for s in g[-1]])),
    ("load over time", backwards._Back, "_of_load", zero),
    ("layers", course, "_layers", lambda of: lambda *given: (of(*given)[0], 1.0)),
]


@pytest.mark.parametrize(
    ("kind", "owner", "method", "change"), MUTANTS, ids=lambda each: getattr(each, "__name__", each)
)
def test_each_term_counts(monkeypatch, kind, owner, method, change):
    monkeypatch.setattr(owner, method, change(getattr(owner, method)))
    try:
        missed = off(kind)
    except NumericalError:
        return
    assert missed > 10 * CLOSE


def test_the_objective_may_follow_an_input_itself():
    # The volume of a track is its cross-section times the stroke.
    found = gradient(run(), Volume("disk"), ["kinematics.stroke", "load.normal"])
    assert found.relative["kinematics.stroke"] == pytest.approx(1, rel=1e-8)
    assert found.relative["load.normal"] == pytest.approx(1, rel=1e-8)


def test_a_number_at_its_bound_has_the_derivative_of_one_side():
    # Of a flat pin V = k s F (p/p0)^(m - 1), where m is at least 1.
    bodies = [named("ball", flat(), steel(), power(1.0)), named("disk", flat(), steel())]
    flats = run(bodies=bodies, contact=Winkler(modulus=1e15), ends_at_window=True)
    exponent = "bodies.ball.wear.p_exponent"
    found = gradient(flats, Volume("ball"), [exponent]).relative[exponent]
    pressure = 20.0 / (0.5e-3) ** 2
    assert found == pytest.approx(np.log(pressure / 1e9), rel=1e-8)


@pytest.mark.parametrize(
    ("slides", "path", "expected"),
    [
        # V = k ∫ F ds, of which the run has 20 N for 10 s, then 50 N.
        (motion(duration=20), "kinematics.duration", 20 * 50 / (10 * 20 + 10 * 50)),
        (
            Unidirectional(speed=0.1, track_length=1.0, distance=2.0),
            "kinematics.speed",
            10 * (20 - 50) / (10 * 20 + 10 * 50),
        ),
    ],
)
def test_stages_of_the_load_may_end_with_the_run(slides, path, expected):
    case = run(
        load=[{"until": 10, "normal": 20.0}, {"until": 20, "normal": 50.0}],
        kinematics=slides,
        contact=Winkler(),
    )
    found = gradient(case, Volume("ball"), [path]).relative[path]
    assert found == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize(
    "path", ["contact.tolerance", "grid.size.0", "stepping.depth_tolerance", "stepping.settle"]
)
def test_how_a_run_is_computed_has_no_derivative(path):
    with pytest.raises(CaseError, match=f"{path}: says how the run is computed"):
        gradient(run(), Volume("ball"), [path])


def test_a_hardness_of_both_bodies_is_named_once():
    case = run(bodies=pair(archard(), archard(), ("2 GPa", "2 GPa")))
    with pytest.raises(CaseError, match=r"either may be the softer; name both, as bodies\.\*"):
        gradient(case, Volume("disk"), [HARD])
    both = "bodies.*.material.hardness"
    assert gradient(case, Depth("disk"), [both])[both] == 0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"stepping": Explicit(time_step=1.0)}, "stepping.type: gradients go through implicit"),
        ({"stop": Stop(depth="1 um")}, "stop.depth: a run that a depth ends has another length"),
        (
            {"effects": [Turns()], "bodies": pair(Follows(k=K), archard())},
            "follows turns of effects",
        ),
    ],
)
def test_what_is_not_covered_is_refused(changes, message):
    with pytest.raises(CaseError, match=message):
        gradient(run(**changes), Volume("ball"), [])


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("bodies.ball.wear.K", "bodies.ball.wear.K: is no number with decimals in this case"),
        ("kinematics.stroke", "moves the positions of the cycle by whole cells"),
        ("bodies.*.wear.k", "stands for different numbers"),
    ],
)
def test_a_number_without_derivative_is_refused(path, message):
    case = run(kinematics=resolved(), bodies=pair(archard(), archard(2 * K)))
    with pytest.raises(CaseError, match=message):
        gradient(case, Volume("ball"), [path])


def test_without_paths_all_numbers_count_and_the_rest_says_why():
    found = gradient(run(kinematics=resolved()), Depth("disk"))
    assert found["bodies.disk.wear.k"] > 0
    assert str(found).startswith("bodies.disk.wear.k ")
    assert "whole cells" in found.refused["kinematics.stroke"]
    with pytest.raises(CaseError, match="whole cells"):
        found["kinematics.stroke"]


def test_effects_that_no_law_follows_have_no_part_in_it():
    found, alone = (
        gradient(run(effects=effects), Volume("ball"), ["load.normal"])
        for effects in ([Turns()], [])
    )
    assert found.parameters == alone.parameters


def test_a_coarse_run_tells_what_rules_the_depth():
    fine = gradient(run(), Deepest("ball")).relative
    found = sensitivity(composed(run()))
    assert found.body == "ball"
    assert list(found.percent) == sorted(found.percent, key=lambda path: -abs(found.percent[path]))
    assert found.percent["load.normal"] == pytest.approx(fine["load.normal"], abs=0.1)
    assert (
        sensitivity(composed(run(bodies=pair(Follows(k=K), archard()), effects=[Turns()]))) is None
    )


def test_a_save_that_is_not_there_is_refused():
    with pytest.raises(CaseError, match="nothing is saved at 3 s"):
        gradient(run(), {3.0: Volume("ball")}, [])


def test_a_tape_goes_to_disk_and_reads_the_same(monkeypatch):
    monkeypatch.setattr(tape, "IN_MEMORY", 1)
    assert off("springs") < CLOSE


def test_scipy_finds_what_made_a_scar():
    made = run(save_times=(20.0,), bodies=pair(archard(1.3 * K), archard(0.8 * K)))
    last = states(composed(made))[-1]
    looks = Misfit("disk", last.bodies["disk"].wear, 1e-8)
    paths = ["bodies.ball.wear.k", "bodies.disk.wear.k"]
    fit = ValueAndGradient(run(stepping=made.stepping), looks, paths)
    value, slope = fit(fit.start)
    ahead = fit(fit.start + 1e-5)[0]
    assert (ahead - value) / 1e-5 == pytest.approx(sum(slope), rel=1e-2)
    found = minimize(fit, fit.start, jac=True, method="BFGS", options={"gtol": 1e-4})
    np.testing.assert_allclose(np.exp(found.x), [1.3, 0.8], rtol=1e-2)


def test_factors_on_the_wear_rate_are_unknowns_too():
    case, factor = run(), 1.7
    fit = ValueAndGradient(case, Volume("ball"), (), ["ball"])
    value, slope = fit(fit.start + np.log(factor))
    assert value == pytest.approx(
        factor * gradient(case, Volume("ball"), []).value, rel=1e-9, abs=0
    )
    assert np.sum(slope) == pytest.approx(value, rel=1e-9, abs=0)
