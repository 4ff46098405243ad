"""What a gradient is asked for, what it refuses, and fits that use it."""

import tomllib
import tracemalloc

import numpy as np
import pytest
from gradients import FINE, HARD, layered, resolved, run
from paper_models import K, archard, motion, pair
from tribo import Finding, Observer
from tribo.case import Layer, Stop
from tribo.config.load import validate_case
from tribo.contact.winkler import Winkler
from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.grid import Grid
from tribo.effects.effect import Effect
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.positions import composed
from tribo.surfaces.height_map import HeightMap
from tribo.templates import template

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.numbers import find
from tribo_inverse.adjoint.objective import (
    Deepest,
    Depth,
    EndTime,
    Volume,
)
from tribo_inverse.adjoint.sensitivity import of_case
from tribo_inverse.adjoint.unknowns import value_and_gradient

NAN, INF = np.nan, np.inf


class Turns(Effect):
    type = "turns"
    state_fields = (Field("turns", "m", "Distance slid.", uniform=True),)

    def state_rates(self, contact):
        return {"turns": np.full((1, 1), contact.speed)}


class Ends(Observer):
    """Ends the run after 10 mm."""

    def findings(self, snapshot):
        return [Finding("stop", "far enough")] * (snapshot.state.distance > 0.01)


STAGES = [{"until": 5, "normal": 20}, {"until": 9, "normal": 10}, {"until": 20, "normal": 20}]
EVENLY = {"load": {"normal": STAGES}, "save_times": (9.0,)}
HARD_PAIR = pair(archard(), archard(), ("2 GPa", "2 GPa"))
COATING = Layer(thickness="1 um", wear=archard(), hardness="1 GPa")
COATED = [("ball", HARD_PAIR[0][1].model_copy(update={"layers": (COATING,)})), HARD_PAIR[1]]
REFUSED = {
    "contact.tolerance: is no number of bodies, load": ({}, ["contact.tolerance"]),
    "grid.size.1: is no number of bodies, load": ({}, ["grid.size.1"]),
    "ball.wear.K: is no number of bodies, load": ({}, ["bodies.ball.wear.K"]),
    "a list of names is needed, 'load.normal' was given": ({}, "load.normal"),
    "moves the positions of the cycle by whole cells": (
        {"grid": FINE, "kinematics": resolved()},
        ["kinematics.stroke"],
    ),
    "stands for different numbers": (
        {"bodies": pair(archard(), archard(2 * K))},
        ["bodies.*.wear.k"],
    ),
    r"either body may be the softer; name both, as bodies\.\*": ({"bodies": HARD_PAIR}, [HARD]),
    "layer of another hardness": ({"bodies": COATED}, []),
    "load.normal.2.until: has .*: it separates events that coincide": (
        EVENLY,
        ["load.normal.2.until"],
    ),
    r"observers\.1: .*far enough": ({"observers": [Ends()]}, []),
}


@pytest.mark.parametrize("words", REFUSED)
def test_what_has_no_derivative_is_refused(words):
    changes, paths = REFUSED[words]
    with pytest.raises(CaseError, match=words):
        gradient(run(**changes), Volume("ball"), paths)


def test_what_can_be_asked_in_place_of_what_is_refused():
    both = "bodies.*.material.hardness"
    assert gradient(run(bodies=HARD_PAIR), Depth("disk"), [both])[both] == 0
    first = "load.normal.1.until"
    slope = gradient(run(**EVENLY), Volume("ball"), [first])
    assert slope[first] > 0
    with pytest.raises(CaseError, match=f"^load.normal.1.untill: .*'{first}'"):
        slope["load.normal.1.untill"]


def test_measured_heights_have_to_be_asked_for():
    heights = np.full((9, 9), 1e-9).tolist()
    ball, disk = pair(archard(), archard())
    surface = HeightMap(size=("2 mm", "2 mm"), heights=heights, on=ball[1].surface)
    case = run(bodies=[(ball[0], ball[1].model_copy(update={"surface": surface})), disk])
    first = "bodies.ball.surface.heights.1.1"
    assert [path for path, *_ in find(case, None) if "heights" in path] == []
    assert [path for path, *_ in find(case, [first])] == [first]


@pytest.mark.parametrize(
    ("path", "unknowns", "message"),
    [
        ("load.normal", [NAN], "load.normal: may not be nan"),
        ("load.normal", [800.0], "load.normal: may not be inf"),
        ("bodies.ball.wear.k", [-800.0], "wear.k: is 0"),
        ("bodies.ball.material.poisson", [1.0], "poisson: may not be 0.8"),
        ("load.normal", [0.0, 0.0, 0.0], "3 unknowns were given; start has 1"),
    ],
)
def test_unknowns_that_the_case_may_not_have_are_refused(path, unknowns, message):
    fit = value_and_gradient(run(), Volume("ball"), [path])
    with pytest.raises(CaseError, match=message):
        fit(np.array(unknowns))


def test_factors_that_are_no_factors_are_refused():
    for names, words in {
        "ball": r"give \['ball'\]",
        ("ring",): "there is no body 'ring' that wears: ball, disk",
    }.items():
        with pytest.raises(CaseError, match=words):
            value_and_gradient(run(), Volume("ball"), wear_rate=names)
    fit = value_and_gradient(run(), Volume("ball"), wear_rate=["ball"])
    for log in (NAN, INF):
        with pytest.raises(CaseError, match="wear rate of ball is negative, NaN or infinite"):
            fit(fit.start + log)


def test_without_paths_all_numbers_count_and_the_rest_says_why():
    found = gradient(run(grid=FINE, kinematics=resolved()), Depth("disk"))
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


def influences(case, half_width_x=1e-4):
    return {each.place: each for each in of_case(composed(case), half_width_x) if each.place}


def test_a_coarse_run_tells_what_rules_the_depth():
    fine = gradient(run(), Deepest("ball")).relative
    found = influences(run())
    changes = [abs(each.value) for each in found.values()]
    assert changes == sorted(changes, reverse=True)
    assert "depth of ball" in found["load.normal"].words
    assert found["load.normal"].value == pytest.approx(fine["load.normal"], abs=0.1)
    assert found["load.normal"].uncertainty < 0.1


def test_what_a_coarse_run_tells_of_a_flat_pins_radius_has_the_answer_within_its_uncertainty():
    """By runs on 192² cells with 1 % more and less of the radius: −2.42 %."""
    case = validate_case(tomllib.loads(template("flat_pin")))
    found = influences(case, 1e-3)["bodies.pin.surface.radius"]
    assert abs(found.value + 2.42) <= found.uncertainty


def test_a_motion_that_ends_in_a_reversal_follows_its_length_in_the_mean():
    """The derivative is 0 there, but not the change by whole cycles."""
    motion = {"stroke": "2 mm", "frequency": 10.0, "positions": "average", "cycles": 600}
    even, wavy = (
        influences(run(kinematics=Reciprocating(**motion, waveform=waveform)))
        for waveform in ("constant_speed", "sinusoidal")
    )
    for path in even:
        assert wavy[path].value == pytest.approx(even[path].value, abs=0.03)


def crank(**end):
    given = {"stroke": "2 mm", "frequency": 10.0, "positions": "average", "swept": "disk"}
    return run(kinematics=Reciprocating(**given, waveform="sinusoidal", **end))


@pytest.mark.parametrize(
    ("end", "names"),
    [
        ({"cycles": 6}, ["cycles"]),
        ({"cycles": 6.5}, ["cycles"]),
        ({"duration": 0.6}, ["duration", "frequency"]),
    ],
)
def test_a_run_that_ends_where_the_motion_turns_has_no_derivative_in_its_length(end, names):
    found = gradient(crank(**end), Volume("disk"))
    paths = {f"kinematics.{name}" for name in names}
    assert {path for path in found.refused if path.startswith("kinematics")} == paths
    assert not paths & {*found.parameters}
    for path in paths:
        with pytest.raises(CaseError, match=path):
            gradient(crank(**end), Volume("disk"), [path])


@pytest.mark.parametrize(
    ("end", "percent"), [({"distance": 0.024}, 1.0), ({"cycles": 6.25}, 0.5 * np.pi)]
)
def test_elsewhere_the_length_of_a_run_has_the_derivative_of_its_distance(end, percent):
    (name,) = end
    found = gradient(crank(**end), Volume("disk"), [f"kinematics.{name}"])
    assert found.relative[f"kinematics.{name}"] == pytest.approx(percent, rel=1e-6)


def test_where_nothing_is_told_there_is_a_reason():
    (finding,) = of_case(composed(run(bodies=pair(archard(0), None))), 1e-4)
    assert "bodies: no body wears" in finding.words


@pytest.mark.parametrize(
    ("stop", "what", "frequency"),
    [
        (Stop(depth="0.05 um", body="disk"), "time until stop.depth", -1.0),
        # Which it does not reach.
        (Stop(depth="1 mm", body="disk"), "depth of disk", 1.0),
    ],
)
def test_where_a_depth_ends_the_run_a_coarse_one_tells_what_rules_the_time(stop, what, frequency):
    found = influences(run(stop=stop, bodies=pair(None, archard())))["kinematics.frequency"]
    assert what in found.words
    assert found.value == pytest.approx(frequency, abs=0.03)


def test_a_depth_at_the_bottom_of_a_layer_has_the_derivatives_of_one_side():
    paths = ["stop.depth", "bodies.ball.layers.1.thickness"]
    stop = Stop(depth="0.2 um", body="ball")

    def lasts(depth):
        bodies = layered((depth, archard(K / 2)), of_ball=archard(9 * K))
        return gradient(run(bodies=bodies, stop=stop), EndTime(), paths).relative

    found, thicker, thinner = map(lasts, ("0.2 um", "0.2001 um", "0.1999 um"))
    for path in paths:
        assert found[path] == pytest.approx(thinner[path], abs=0.01)
    # Whichever side it is, the depth and the layer together have one derivative.
    assert sum(found.values()) == pytest.approx(sum(thicker.values()), abs=0.01)


def test_a_depth_that_is_worn_off_before_the_run_is_refused(tmp_path):
    parts = {"grid": Grid(("0.5 mm", "0.5 mm"), (24, 24)), "kinematics": motion(duration=10)}
    run(**parts).run(tmp_path / "first")
    stops = run(**parts, begin=tmp_path / "first", stop=Stop(depth="0.2 um"))
    with pytest.raises(CaseError, match="the run ends at 0 s"):
        gradient(stops, EndTime(), [])


def test_the_depth_that_ends_a_run_is_among_the_numbers_that_count():
    found = gradient(run(stop=Stop(depth="0.2 um")), EndTime())
    assert found.relative["stop.depth"] > 1
    assert str(found).startswith("stop.depth")
    assert gradient(run(stop=Stop(depth="1 mm")), Volume("ball"))["stop.depth"] == 0


def peak(steps):
    times = tuple(20 * (step + 1) / steps for step in range(steps))
    long = run(grid=Grid(("0.5 mm", "0.5 mm"), (48, 48)), contact=Winkler(), save_times=times)
    tracemalloc.start()
    gradient(long, Volume("ball"), ["load.normal"])
    _, highest = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return highest


@pytest.mark.slow
def test_memory_does_not_grow_with_the_steps_of_a_run():
    few, many = (min(peak(steps) for _ in range(2)) for steps in (10, 50))
    # 40 saved times take 90 kB in all variants of the case; with their pressures it is 170 kB.
    assert many - few < 130e3


def test_factors_on_the_wear_rate_are_unknowns_too():
    case, factor = run(), 1.7
    fit = value_and_gradient(case, Volume("ball"), (), ["ball"])
    value, slope = fit(fit.start + np.log(factor))
    assert value == pytest.approx(
        factor * gradient(case, Volume("ball"), []).value, rel=1e-9, abs=0
    )
    assert np.sum(slope) == pytest.approx(value, rel=1e-9, abs=0)
