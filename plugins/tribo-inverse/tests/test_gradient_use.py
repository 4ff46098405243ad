"""What a gradient is asked for, what it refuses, and fits that use it."""

import tomllib
import tracemalloc

import numpy as np
import pytest
from gradients import BASE, CLOSE, FINE, HARD, Kind, layered, resolved, run
from paper_models import K, archard, motion, pair, states
from scipy.optimize import minimize
from tribo import Finding, Observer
from tribo.case import Layer, Stop
from tribo.config.load import validate_case
from tribo.contact.padded_half_space import HalfSpace
from tribo.contact.winkler import Winkler
from tribo.core.box import whole
from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.grid import Grid
from tribo.effects.effect import Effect
from tribo.motion.planar import Planar
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation import march
from tribo.simulation.positions import composed
from tribo.surfaces.height_map import HeightMap
from tribo.templates import template
from tribo.wear.archard import Archard

from tribo_inverse.adjoint.gradient import gradient, value_and_gradient
from tribo_inverse.adjoint.linear import StepSystem
from tribo_inverse.adjoint.numbers import find
from tribo_inverse.adjoint.objective import (
    Deepest,
    Depth,
    EndTime,
    Misfit,
    Volume,
)
from tribo_inverse.adjoint.sensitivity import sensitivity
from tribo_inverse.increment.carriers import Carrier
from tribo_inverse.recording import tape

NAN, INF = np.nan, np.inf


class Turns(Effect):
    type = "turns"
    state_fields = (Field("turns", "m", "Distance slid.", uniform=True),)

    def state_rates(self, contact):
        return {"turns": np.full((1, 1), contact.speed)}


@pytest.mark.parametrize("path", ["contact.tolerance", "grid.size.1"])
def test_how_a_run_is_computed_has_no_derivative(path):
    with pytest.raises(CaseError, match=f"{path}: is a number of the numerics"):
        gradient(run(), Volume("ball"), [path])


class Ends(Observer):
    """Ends the run after 10 mm."""

    def findings(self, snapshot):
        return [Finding("stop", "far enough")] * (snapshot.state.distance > 0.01)


def test_a_run_that_a_model_ends_has_no_gradient():
    with pytest.raises(CaseError, match=r"observers\.1: .*far enough"):
        gradient(run(observers=[Ends()]), Volume("ball"), ["load.normal"])


def test_a_hardness_of_both_bodies_is_named_once():
    case = run(bodies=pair(archard(), archard(), ("2 GPa", "2 GPa")))
    with pytest.raises(CaseError, match=r"either may be the softer; name both, as bodies\.\*"):
        gradient(case, Volume("disk"), [HARD])
    both = "bodies.*.material.hardness"
    assert gradient(case, Depth("disk"), [both])[both] == 0


def test_measured_heights_have_to_be_asked_for():
    heights = np.full((9, 9), 1e-9).tolist()
    ball, disk = pair(archard(), archard())
    surface = HeightMap(size=("2 mm", "2 mm"), heights=heights, on=ball[1].surface)
    bodies = [(ball[0], ball[1].model_copy(update={"surface": surface})), disk]
    case = run(bodies=bodies)
    first = "bodies.ball.surface.heights.1.1"
    assert [path for path, *_ in find(case, None) if "heights" in path] == []
    assert [path for path, *_ in find(case, [first])] == [first]


def coated():
    ball, disk = pair(archard(), archard(), ("2 GPa", "2 GPa"))
    layer = Layer(thickness="1 um", wear=archard(), hardness="1 GPa")
    return [(ball[0], ball[1].model_copy(update={"layers": (layer,)})), disk]


def test_layers_that_yield_at_another_hardness_are_refused():
    with pytest.raises(CaseError, match="layer of another hardness"):
        gradient(run(bodies=coated()), Volume("ball"), [])


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("bodies.ball.wear.K", "bodies.ball.wear.K: is no number with decimals"),
        ("bodies.ball.wear.kk", r"bodies.ball.wear.kk: the case has no .*'bodies\.ball\.wear\.k'"),
        ("kinematics.stroke", "moves the positions of the cycle by whole cells"),
        ("bodies.*.wear.k", "stands for different numbers"),
    ],
)
def test_a_number_without_derivative_is_refused(path, message):
    case = run(grid=FINE, kinematics=resolved(), bodies=pair(archard(), archard(2 * K)))
    with pytest.raises(CaseError, match=message):
        gradient(case, Volume("ball"), [path])


def test_a_stage_that_ends_at_a_save_has_no_derivative_in_its_time():
    load = {"normal": [{"until": "5 s", "normal": 20}, {"until": "9 s", "normal": 10}]}
    load["normal"].append({"until": "20 s", "normal": 20})
    case, path = run(load=load, save_times=(9.0,)), "load.normal.2.until"
    with pytest.raises(
        CaseError, match=f"{path}: has .*: a change of it separates events that coincide at 9 s"
    ):
        gradient(case, Volume("ball"), [path])
    assert gradient(case, Volume("ball"), ["load.normal.1.until"])["load.normal.1.until"] > 0


def test_a_refusal_names_its_place_once():
    class Exact(Archard):
        type = "exact"

        def check(self, material):
            if self.k != K:
                raise CaseError("only one is known", "bodies.ball.wear.k")

    case = run(bodies=pair(Exact(k=K), archard()))
    with pytest.raises(CaseError) as refused:
        gradient(case, Volume("ball"), ["bodies.*.wear.k"])
    assert str(refused.value) == "bodies.*.wear.k: has no derivative here: only one is known"


def test_a_path_across_is_refused():
    path = Planar(path="circle", extent=(1e-4, 1e-4), speed=0.02, revolutions=9, positions="cells")
    with pytest.raises(CaseError, match="disk moves across as well as along x"):
        gradient(run(kinematics=path), Volume("ball"), [])


def test_one_name_in_place_of_a_list_is_refused():
    with pytest.raises(CaseError, match=r"a list of names is needed, 'load.normal' was given"):
        gradient(run(), Volume("ball"), "load.normal")
    with pytest.raises(CaseError, match=r"give \['ball'\]"):
        value_and_gradient(run(), Volume("ball"), wear_rate="ball")
    with pytest.raises(CaseError, match="there is no body 'ring' that wears: ball, disk"):
        value_and_gradient(run(), Volume("ball"), wear_rate=["ring"])


@pytest.mark.parametrize(
    ("path", "unknowns", "message"),
    [
        ("load.normal", [NAN], "load.normal: may not be nan"),
        ("load.normal", [800.0], "asked for .800 away .* give it bounds"),
        ("bodies.ball.wear.k", [-800.0], "wear.k: was asked for -800 away .* went too far"),
        ("bodies.ball.material.poisson", [1.0], "poisson: may not be 0.8"),
        ("load.normal", [0.0, 0.0, 0.0], "3 unknowns were given; start has 1"),
    ],
)
def test_unknowns_that_the_case_may_not_have_are_refused(path, unknowns, message):
    fit = value_and_gradient(run(), Volume("ball"), [path])
    with pytest.raises(CaseError, match=message):
        fit(np.array(unknowns))


def test_factors_that_are_no_factors_are_refused():
    fit = value_and_gradient(run(), Volume("ball"), wear_rate=["ball"])
    for log in (NAN, INF):
        with pytest.raises(CaseError, match="wear rate of ball is negative, NaN or infinite"):
            fit(fit.start + log)


def test_of_what_does_not_wear_nothing_is_told_in_per_cent():
    found = gradient(run(bodies=pair(archard(), None)), Volume("disk"), ["load.normal"])
    assert found["load.normal"] == 0
    assert str(found).startswith("The objective is 0")


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


def test_a_coarse_run_tells_what_rules_the_depth():
    fine = gradient(run(), Deepest("ball")).relative
    found = sensitivity(composed(run()), 1e-4)
    assert found.body == "ball"
    assert list(found.percent) == sorted(found.percent, key=lambda path: -abs(found.percent[path]))
    assert found.percent["load.normal"] == pytest.approx(fine["load.normal"], abs=0.1)
    assert found.uncertainty["load.normal"] < 0.1
    assert found.cells[1] == tuple(2 * cells for cells in found.cells[0])


def test_what_a_coarse_run_tells_of_a_flat_pins_radius_has_the_answer_within_its_uncertainty():
    """By runs on 192² cells with 1 % more and less of the radius: −2.42 %."""
    found = sensitivity(composed(validate_case(tomllib.loads(template("flat_pin")))), 1e-3)
    radius = "bodies.pin.surface.radius"
    assert abs(found.percent[radius] + 2.42) <= found.uncertainty[radius]


def test_a_motion_that_ends_in_a_reversal_follows_its_length_in_the_mean():
    """The derivative is 0 there, but not the change by whole cycles."""
    motion = {"stroke": "2 mm", "frequency": 10.0, "positions": "average", "cycles": 600}
    even, wavy = (
        sensitivity(composed(run(kinematics=Reciprocating(**motion, waveform=waveform))), 1e-4)
        for waveform in ("constant_speed", "sinusoidal")
    )
    for path in even.percent:
        assert wavy.percent[path] == pytest.approx(even.percent[path], abs=0.03)


def test_where_nothing_is_told_there_is_a_reason():
    with pytest.raises(CaseError, match="bodies: no body wears"):
        sensitivity(composed(run(bodies=pair(archard(0), None))), 1e-4)


@pytest.mark.parametrize(
    ("stop", "of", "frequency"),
    [
        (Stop(depth="0.05 um", body="disk"), "end_time", -1.0),
        # Which it does not reach.
        (Stop(depth="1 mm", body="disk"), "depth", 1.0),
    ],
)
def test_where_a_depth_ends_the_run_a_coarse_one_tells_what_rules_the_time(stop, of, frequency):
    found = sensitivity(composed(run(stop=stop, bodies=pair(None, archard()))), 1e-4)
    assert (found.body, found.of) == ("disk", of)
    assert found.percent["kinematics.frequency"] == pytest.approx(frequency, abs=0.03)


def test_a_depth_at_the_bottom_of_a_layer_counts_as_just_above_it():
    paths = ["stop.depth", "bodies.ball.layers.1.wear.k"]
    thickness, below = "bodies.ball.layers.1.thickness", "bodies.ball.wear.k"
    stop = Stop(depth="0.2 um", body="ball")

    def lasts(depth):
        bodies = layered((depth, archard(K / 2)), of_ball=archard(9 * K))
        return gradient(run(bodies=bodies, stop=stop), EndTime(), [*paths, thickness, below])

    found, thicker, thinner = lasts("0.2 um"), lasts("1 um"), lasts("0.19 um")
    assert found.value == pytest.approx(thicker.value, rel=1e-6)
    for path in paths:
        assert found[path] == pytest.approx(thicker[path], rel=1e-6)
    # 0 to the tolerance of a contact solve.
    assert [found.relative[path] for path in (thickness, below)] == pytest.approx([0, 0], abs=1e-8)
    assert thinner[thickness] > 0


def test_a_depth_that_is_worn_off_before_the_run_is_refused(tmp_path):
    parts = {"grid": Grid(("0.5 mm", "0.5 mm"), (24, 24)), "kinematics": motion(duration=10)}
    run(**parts).run(tmp_path / "first")
    stops = run(**parts, begin=tmp_path / "first", stop=Stop(depth="0.2 um"))
    with pytest.raises(CaseError, match=r"stop\.depth: is reached before the run begins"):
        gradient(stops, EndTime(), [])


def test_the_depth_that_ends_a_run_is_among_the_numbers_that_count():
    found = gradient(run(stop=Stop(depth="0.2 um")), EndTime())
    assert found.relative["stop.depth"] > 1
    assert str(found).startswith("stop.depth")
    assert gradient(run(stop=Stop(depth="1 mm")), Volume("ball"))["stop.depth"] == 0


def test_a_depth_that_jumps_past_its_limit_is_refused(monkeypatch):
    monkeypatch.setattr(march, "MOST_CUTS", 0)
    with pytest.raises(CaseError, match=r"stop\.depth: the depth jumps from below 0.2 µm to"):
        gradient(run(stop=Stop(depth="0.2 um")), Volume("ball"), [])


def test_a_tape_goes_to_disk_and_reads_the_same(monkeypatch):
    monkeypatch.setattr(tape, "IN_MEMORY", 1)
    assert Kind(run(contact=Winkler()), Depth("ball"), BASE, 1e-5).off() < CLOSE


def peak(steps):
    times = tuple(20 * (step + 1) / steps for step in range(steps))
    long = run(grid=Grid(("0.5 mm", "0.5 mm"), (48, 48)), contact=Winkler(), save_times=times)
    tracemalloc.start()
    gradient(long, Volume("ball"), ["load.normal"])
    _, highest = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return highest


@pytest.mark.slow
def test_memory_does_not_grow_with_the_steps_of_a_run(monkeypatch):
    monkeypatch.setattr(tape, "IN_MEMORY", 1)
    few, many = (min(peak(steps) for _ in range(2)) for steps in (10, 50))
    # A pressure takes over 3 kB, the time of a save in each variant of the case under 1 kB.
    assert many - few < 40e3


def test_scipy_finds_what_made_a_scar():
    made = run(save_times=(20.0,), bodies=pair(archard(1.3 * K), archard(0.8 * K)))
    last = states(composed(made))[-1]
    looks = Misfit("disk", last.bodies["disk"].wear, 1e-8)
    paths = ["bodies.ball.wear.k", "bodies.disk.wear.k"]
    fit = value_and_gradient(run(stepping=made.stepping), looks, paths)
    value, slope = fit(fit.start)
    ahead = fit(fit.start + 1e-5)[0]
    assert (ahead - value) / 1e-5 == pytest.approx(sum(slope), rel=1e-2)
    found = minimize(fit, fit.start, jac=True, method="BFGS", options={"gtol": 1e-4})
    np.testing.assert_allclose(np.exp(found.x), [1.3, 0.8], rtol=1e-2)


def test_factors_on_the_wear_rate_are_unknowns_too():
    case, factor = run(), 1.7
    fit = value_and_gradient(case, Volume("ball"), (), ["ball"])
    value, slope = fit(fit.start + np.log(factor))
    assert value == pytest.approx(
        factor * gradient(case, Volume("ball"), []).value, rel=1e-9, abs=0
    )
    assert np.sum(slope) == pytest.approx(value, rel=1e-9, abs=0)


def test_a_stroke_that_mirrors_itself_is_solved_on_one_side(monkeypatch):
    cells, random = (8, 8), np.random.default_rng(0)
    box = whole(cells)
    operator = HalfSpace(cells, (1e-5, 1e-5), 1e11)
    starts = [0, 3, 6]
    inside = np.zeros((3, *cells), dtype=bool)
    inside[:, 2:6, 2:6] = True
    # Laws are asked beyond the contact too, where it need not mirror itself.
    slope = np.where(inside, 1e-16, random.random(inside.shape))
    given = random.random(inside.shape)
    given += np.where(inside, given[::-1, ::-1], 0.0)
    bodies = [(Carrier(8, [0, 0, 0], None), slope), (Carrier(14, starts, None), slope)]
    system = StepSystem(operator, box, np.array([0.25, 0.5, 0.25]), bodies, inside)
    zero = np.zeros_like(given)
    asked = []
    apply = HalfSpace.apply
    monkeypatch.setattr(HalfSpace, "apply", lambda self, p: asked.append(len(p)) or apply(self, p))
    one_side = system.solve(given, zero, zero)
    assert set(asked) == {2}
    monkeypatch.setattr(StepSystem, "_mirrors", lambda *given: False)
    np.testing.assert_allclose(one_side, system.solve(given, zero, zero), rtol=1e-6, atol=0)
