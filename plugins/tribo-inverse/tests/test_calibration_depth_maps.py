"""Numbers of a case are fitted to depth maps, beside and in the way of other measured values."""

import copy
import warnings
from pathlib import Path

import numpy as np
import pytest
from calibrations import cheap, of_kind
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, TriboWarning
from tribo.core.toml import to_toml
from tribo.simulation.run import Simulation

from tribo_inverse.calibration.calibrate import calibrate
from tribo_inverse.calibration.cells import block_means, cell_means
from tribo_inverse.calibration.choice import choose_case
from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.measured import read_measurements
from tribo_inverse.calibration.plan import plan_tests

K, N = "bodies.ball.wear.k", "bodies.ball.wear.p_exponent"
DISK_K = "bodies.disk.wear.k"
ARCHARD = apply_settings(cheap(60), {"grid.cells": 16, K: 3e-16, DISK_K: 3e-16})
FINER = apply_settings(ARCHARD, {"grid.cells": 32})
POWER = apply_settings(
    FINER,
    {"bodies.ball.wear": {"type": "power", "k": 3e-16, "reference_pressure": "1 GPa"}, N: 1.3},
)
TRUE = {K: 3e-16, N: 1.3}
NOISE = 10e-9


def run(case, **changes):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        return Simulation(validate_case(apply_settings(case, changes))).run()


@pytest.fixture(scope="module")
def noisy(tmp_path_factory):
    """Return an entry of a body's map, with noise, in a file; missing in a corner."""
    folder, random = tmp_path_factory.mktemp("maps"), np.random.default_rng(3)

    def entry(case, body="ball", field=None, **changes):
        with run(case, **changes) as result:
            depth = result.body(body).wear_depth[-1]
            if field is not None:
                depth = result.field(field, len(result.times) - 1, body)
            pitch = result.grid.spacing[0]
        depth = cell_means(depth) + NOISE * random.standard_normal(depth.shape)
        depth[:3, :5] = np.nan
        file = folder / f"{len(list(folder.iterdir()))}.npy"
        np.save(file, depth)
        map_of = {"body": body, "quantity": "depth_map", "depth": str(file), "pitch": pitch}
        return map_of | {"uncertainty": NOISE}

    return entry


@pytest.fixture(scope="module")
def two_loads(noisy):
    """Maps of the ball, worn by the power law, of the case as it is and of half the load."""
    light = {"load.normal": 50.0}
    tests = [
        {"name": "heavy", "measured": [noisy(POWER)]},
        {"name": "light", "set": light, "measured": [noisy(POWER, **light)]},
    ]
    return {"test": tests, "fit": [{"path": K, "start": 3.5e-16}, {"path": N, "start": 1.2}]}


@pytest.fixture(scope="module")
def found(two_loads):
    return calibrate(POWER, two_loads)


@pytest.mark.slow
def test_a_coefficient_and_an_exponent_are_found_from_maps_at_two_loads(found):
    for each in found.parameters.itertuples():
        assert each.lower < TRUE[each.path] < each.upper
        assert each.value == pytest.approx(TRUE[each.path], rel=0.02, abs=0)
    # Blocks of four cells, two of which were not measured.
    assert len(found.data) == 2 * (16 * 16 - 2)
    assert found.p_value > 0.01
    assert list(found.brief["test"]) == ["heavy", "light"]


@pytest.mark.slow
def test_another_law_is_noticed_and_not_chosen(two_loads, found):
    """Archard's coefficient would be 20 % less at half the load, where pressures are less."""
    choice = choose_case({"power": POWER, "archard": FINER}, two_loads)
    assert list(choice.cases["case"]) == ["power", "archard"]
    wrong = choice.calibrations["archard"]
    assert wrong.p_value < 1e-3
    assert of_kind(wrong, "misfit")[0].value == wrong.chi_square
    assert not of_kind(found, "misfit")


@pytest.mark.slow
def test_a_weighed_mass_goes_with_a_map(noisy):
    """The map tells of the disk, the balance of the ball; together of the load between them."""
    lost = 3e-16 * 100 * 6 * 7850
    mass = {"body": "ball", "quantity": "mass", "value": lost, "uncertainty": 0.05 * lost}
    fitted = [{"path": K, "start": 4e-16}, {"path": DISK_K, "start": 2e-16}]
    found = calibrate(ARCHARD, {"measured": [mass, noisy(ARCHARD, "disk")], "fit": fitted})
    ball, disk = found.parameters.itertuples()
    assert ball.value == pytest.approx(3e-16, rel=0.05, abs=0)
    assert disk.value == pytest.approx(3e-16, rel=0.05, abs=0)
    assert (ball.upper - ball.lower) / ball.value == pytest.approx(2 * 1.96 * 0.05, rel=0.3)
    # Every point of the track is the same, so that each line across it is a number.
    assert len(found.data) == 1 + 16
    assert list(found.brief["quantity"]) == ["mass", "depth_map"]


@pytest.mark.slow
def test_maps_of_tests_that_scatter_are_off_together(noisy):
    entries = [noisy(ARCHARD, **{K: factor * 3e-16}) for factor in (0.85, 1.2, 0.95)]
    tests = [{"measured": [entry]} for entry in entries]
    found = calibrate(ARCHARD, {"test": tests, "fit": [{"path": K, "start": 4e-16}]})
    assert found.repeatability == pytest.approx(np.std([0.85, 1.2, 0.95], ddof=1), rel=0.1)
    (each,) = found.parameters.itertuples()
    assert each.value == pytest.approx(3e-16, rel=0.02, abs=0)
    assert each.upper / each.value > 1.3


@pytest.mark.slow
def test_where_tests_hardly_tell_their_scatter_it_is_asked_for(noisy):
    """A map of one ball, known to parts of a percent, and two weighings to 10 %."""
    lost = 3e-16 * 100 * 6 * 7850
    mass = {"body": "ball", "quantity": "mass", "value": [lost, 1.05 * lost]}
    mass["uncertainty"] = 0.1 * lost
    found = calibrate(ARCHARD, {"measured": [noisy(ARCHARD), mass], "fit": [{"path": K}]})
    assert [each.place for each in of_kind(found, "unbounded")] == [K]
    (each,) = found.parameters.itertuples()
    assert (each.lower, each.upper) == (0, np.inf)


@pytest.mark.slow
def test_a_map_of_the_whole_track_is_met_where_the_stroke_is_resolved(noisy):
    """The disk's own surface, three windows long, to its ends; a map of the ball in mid-test."""
    changes = {"kinematics.positions": 33, "kinematics.duration": 20}
    resolved = apply_settings(ARCHARD, changes)
    track = noisy(resolved, "disk", field="track_depth")
    early = noisy(resolved, **{"kinematics.duration": 10}) | {"time": 10.0}
    experiment = Experiment.of(resolved, {"measured": [track, early]})
    computed = experiment.run(experiment.start).responses
    off = (computed[: len(experiment.data)] - experiment.data["measured"]) / experiment.problem(
        experiment.start
    ).sigma
    for body, count in (("disk", 48 * 16 // 4), ("ball", 16 * 16 - 15)):
        own = off[experiment.data["body"] == body]
        assert len(own) == count - (body == "disk") * 2
        assert np.std(own) == pytest.approx(1, abs=0.15)
    assert experiment.data["x_m"].max() == pytest.approx(1.5e-3, abs=0.1e-3)


def test_blocks_leave_out_what_was_not_measured():
    depth = np.arange(50.0 * 50).reshape(50, 50)
    depth[:3, :2] = np.nan
    depth[0, 4] = np.nan
    noise = np.ones(depth.shape)
    blocks = block_means(depth, noise, (2e-6, 1e-6))
    # Three by three, the last ones two wide.
    assert len(blocks) == 17 * 17
    assert blocks["cells"][0] == (2, 52, 102)
    assert blocks["measured"][0] == pytest.approx(np.mean([2, 52, 102]))
    assert len(blocks["cells"][1]) == 8
    assert blocks["noise"][1] == pytest.approx(8**-0.5)
    assert blocks[["x_m", "y_m"]].iloc[-1].to_list() == pytest.approx([48e-6, 24e-6])
    assert sum(map(len, blocks["cells"])) == np.isfinite(depth).sum()
    assert len(block_means(depth[:1], noise[:1], (2e-6, 1e-6))) == 47


@pytest.mark.slow
def test_a_map_can_be_planned_with_before_it_is_measured(two_loads):
    """As with one that was, whose missing depths tell little more."""
    entry = {"body": "ball", "quantity": "depth_map", "uncertainty": NOISE}
    ahead = copy.deepcopy(two_loads)
    for test in ahead["test"]:
        test["measured"] = [entry]
    plans = [plan_tests(POWER, {**each, "repeatability": 0.1}, 0.1) for each in (two_loads, ahead)]
    had, planned = (plan.tests["count"].to_list() for plan in plans)
    assert had == planned
    assert sum(planned) >= 2


@pytest.mark.parametrize(
    ("changes", "place", "words"),
    [
        ({"depth": "no.npy"}, ".1.depth", "no.npy"),
        ({"depth": None}, ".1", "give depth"),
        ({"pitch": None}, ".1.depth", "pixels"),
        ({"pitch": "0.1 mm"}, ".1.depth", "62.5 × 62.5 µm"),
        ({"pitch": "1 um"}, ".1.depth", "the window"),
        ({"depth": "beside.npy"}, ".1.depth", "50 × 50 µm"),
        ({"depth": "upwards.npy"}, ".1.depth", "sign"),
        ({"depth": "missing.npy"}, ".1.depth", "missing"),
        ({"uncertainty": None}, ".1", "uncertainty"),
        ({"body": "disk"}, ".1.quantity", "does not wear in this case"),
    ],
)
def test_a_wrong_map_is_told(changes, place, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    worn = np.full((16, 16), 1e-6)
    beside = np.full((80, 80), np.nan)
    beside[0, 0] = 1e-6
    files = {"good": worn, "beside": beside, "upwards": -worn, "missing": np.nan * worn}
    for name, depth in files.items():
        np.save(f"{name}.npy", depth)
    entry = {"body": "ball", "quantity": "depth_map", "depth": "good.npy", "pitch": "50 um"}
    entry = {**entry, "uncertainty": "10 nm", **changes}
    entry = {key: value for key, value in entry.items() if value is not None}
    case = copy.deepcopy(ARCHARD)
    del case["bodies"]["disk"]["wear"]
    with pytest.raises(CaseError) as caught:
        calibrate(case, {"measured": [entry], "fit": [{"path": K}]})
    assert str(caught.value).startswith(f"measured{place}: ")
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize("kind", ["measured", "map"])
def test_a_map_is_looked_for_beside_the_file_that_names_it(kind, tmp_path):
    entry = {"body": "ball", "depth": "worn.npy", "uncertainty": "10 nm"}
    entry |= {"quantity": "depth_map"} if kind == "measured" else {"length": "0.1 mm"}
    file = tmp_path / "lab.toml"
    file.write_text(to_toml({kind: [entry]}))
    (read,) = getattr(read_measurements(file), kind)
    assert Path(read.depth) == tmp_path / "worn.npy"
    (given,) = getattr(read_measurements({kind: [entry]}), kind)
    assert given.depth == "worn.npy"
