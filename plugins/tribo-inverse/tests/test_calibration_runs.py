"""A calibration gives back what the data were made with, and says what they cannot tell."""

import warnings

import numpy as np
import pytest
from ball_on_track import ball_on_track
from calibrations import cheap, of_kind, on_springs
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, NumericalError, TriboWarning
from tribo.simulation.run import Simulation

from tribo_inverse.calibration.calibrate import calibrate
from tribo_inverse.calibration.measured import read_measurements
from tribo_inverse.calibration.parameters import find_parameters
from tribo_inverse.calibration.quantities import Reading, read
from tribo_inverse.calibration.setups import SetupRun, make_run
from tribo_inverse.tables import estimates_table, predictions_table

TRUE = {"bodies.ball.wear.k": 3.11e-16, "bodies.disk.wear.k": 1.5e-16}
CASE = apply_settings(cheap(300), TRUE)
LOAD, DISTANCE, DENSITY = 100.0, 30.0, 7850.0
(BALL_K, BALL), (DISK_K, DISK) = TRUE.items()
SPLIT = on_springs("weighed_split", {"grid.cells": 48})


def mass(k):
    """What Archard's law takes off in the cheap case, in kg."""
    return k * LOAD * DISTANCE * DENSITY


def measured(body, quantity, value, part=0.05):
    return {"body": body, "quantity": quantity, "value": value, "uncertainty": part * value}


BALL_LOSS, DISK_LOSS = measured("ball", "mass", mass(BALL)), measured("disk", "mass", mass(DISK))


def fitting(*paths, **start):
    return [{"path": path, **start} for path in paths]


def run_with(**changes):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        return Simulation(validate_case(apply_settings(CASE, changes))).run()


@pytest.fixture(scope="module")
def true_run():
    with run_with() as result:
        yield result


def computed(result, body, quantity):
    return read(result, Reading(body, quantity))[0]


@pytest.mark.slow
def test_several_tests_give_one_coefficient_and_share_runs():
    """Twice the same load, and half of it for less time."""
    half = {"set": {"load": {"normal": LOAD / 2}, "kinematics": {"duration": "200 s"}}}
    third = mass(BALL) / 3
    lost = measured("ball", "mass", third)
    tests = [
        {"measured": [measured("ball", "mass", 1.1 * mass(BALL))]},
        {"measured": [measured("ball", "mass", 0.9 * mass(BALL))]},
        {**half, "name": "half", "measured": [lost]},
    ]
    case = apply_settings(CASE, {"output.save_times": ["100 s", "300 s"]})
    found = calibrate(
        case, {"test": tests, "repeatability": 0.2, "fit": fitting(BALL_K, start=1.5 * BALL)}
    )
    # A start, a difference and the estimate, for each of two loads.
    assert found.runs == 6
    assert found.settings == pytest.approx({BALL_K: BALL}, rel=0.02, abs=0)
    (each,) = found.parameters.itertuples()
    assert each.upper / each.value == pytest.approx(1 + 1.96 * 0.2 / 3**0.5, rel=0.02)
    assert list(found.data["test"]) == ["test 1", "test 2", "half"]
    assert {*found.predictions["test"]} == {"test 1", "half"}
    assert found.fitted == apply_settings(case, {BALL_K: float(f"{each.value:.7g}")})


@pytest.mark.slow
def test_the_crown_that_weighed_losses_foretell_is_that_of_the_closed_rigid_limit():
    """2.0 and 0.2 mg in 360 m at 100 N, which `tribo calibrate` fits in its own test."""
    disk = {"before": "27.6445 g", "after": "27.6443 g"}
    data = {
        "measured": [
            {"body": "ball", "quantity": "mass", "value": "2.0 mg", "resolution": "0.1 mg"},
            {"body": "disk", "quantity": "mass", **disk, "resolution": "0.1 mg"},
        ],
        "fit": fitting(*TRUE, start="3.11e-16 1/Pa"),
    }
    found = calibrate(SPLIT, data)
    ball, disk = found.parameters.itertuples()
    (crown,) = found.predictions.query("body == 'ball' and quantity == 'crown'").itertuples()

    def rigid(k_disk):
        return ball_on_track(
            [360.0],
            load=100.0,
            radius=5e-3,
            track_length=2e-3,
            ball_wear_coefficient=ball.value,
            flat_wear_coefficient=k_disk,
        ).flat_depth[0]

    middle = rigid(disk.value)
    assert crown.value == pytest.approx(middle, rel=0.03, abs=0)
    assert crown.lower / crown.value == pytest.approx(rigid(disk.lower) / middle, rel=0.1)
    assert crown.upper / crown.value == pytest.approx(rigid(disk.upper) / middle, rel=0.1)


def test_the_start_leaves_no_trace_in_the_uncertainties(monkeypatch):
    """The grid's part of them is that of the estimate, though it may be far from the start."""

    def made(tables, parameters, values, wanted, *rest):
        off = np.array([0.2 * (each.quantity == "crown") for each in wanted])
        crown = 5e-6 * (values[0] / BALL) ** 0.25
        found = [crown if each.quantity == "crown" else mass(values[0]) for each in wanted]
        return SetupRun(np.array(found), off * found, ())

    monkeypatch.setattr("tribo_inverse.calibration.experiment.make_run", made)
    data, told = [BALL_LOSS, measured("ball", "crown", 6e-6)], []
    near, far = (
        calibrate(
            CASE,
            {"measured": data, "fit": fitting(BALL_K, start=start)},
            on_run=lambda run, misfit: told.append(run),
        )
        for start in (BALL, 100 * BALL)
    )
    assert told == [*range(1, near.runs + 1), *range(1, far.runs + 1)]
    np.testing.assert_allclose(far.data["sigma"], near.data["sigma"], rtol=0.05)
    assert far.chi_square == pytest.approx(near.chi_square, rel=0.1)
    assert far.parameters["value"][0] == pytest.approx(near.parameters["value"][0], rel=1e-3, abs=0)


def test_the_k_of_what_was_measured_is_fitted_without_fit():
    """And a loss that was measured, at the end, is not predicted."""
    loss = {"body": "ball", "quantity": "mass", "value": mass(BALL), "resolution": 1e-9}
    found = calibrate(validate_case(CASE), {"measured": [{"time": 300.0, **loss}]})
    assert found.settings == pytest.approx({BALL_K: BALL}, rel=1e-6, abs=0)
    assert ("ball", "mass") not in {(p.body, p.quantity) for p in found.predictions.itertuples()}
    assert list(found.data["time_s"]) == [300.0]
    # As the command prints it.
    assert f" {BALL_K}" in str(found)
    assert found._repr_html_().count("<table>") == 3


@pytest.mark.slow
def test_what_a_coarse_grid_cannot_tell_is_left_uncertain():
    """Estimates and predictions cover what made the data, though those are far more exact."""
    scars = [("ball", "scar_along"), ("ball", "scar_across"), ("disk", "depth")]
    with run_with(**{"grid.cells": 48}) as fine:
        data = [measured(*each, computed(fine, *each), 1e-5) for each in scars]
        found = calibrate(CASE, {"measured": data, "fit": fitting(*TRUE, start=2e-16)})
        for each in found.predictions.itertuples():
            assert each.lower < computed(fine, each.body, each.quantity) < each.upper
    for each in found.parameters.itertuples():
        assert each.lower < TRUE[each.path] < each.upper


def test_what_nothing_fitted_changes_is_predicted_without_an_interval():
    """The disk's loss is that of its coefficient, which is the case's."""
    found = calibrate(CASE, {"measured": [BALL_LOSS]})
    loss = found.predictions.query("body == 'disk' and quantity == 'mass'").iloc[0]
    assert loss["lower"] == loss["value"] == loss["upper"]
    assert "not fitted" in str(predictions_table(found))


def test_numbers_that_the_data_cannot_tell_apart_stay_near_their_start(true_run):
    """The scar's width is off, which no combination of them explains."""
    width = 0.97 * computed(true_run, "ball", "scar_across")
    width = measured("ball", "scar_across", width, 0.01)
    paths = [BALL_K, DISK_K, "load.normal"]
    data = {"measured": [BALL_LOSS, DISK_LOSS, width], "fit": fitting(*paths)}
    # Errors of longer steps would seem to separate them.
    found = calibrate(apply_settings(CASE, {"stepping.pressure_tolerance": 0.1}), data)
    assert found.runs <= 8
    assert found.settings["load.normal"] == pytest.approx(LOAD, rel=0.1)
    (collinear,) = of_kind(found, "collinear")
    assert collinear.place == ", ".join(paths)
    assert np.all(found.parameters["upper"] > 100 * found.parameters["value"])


def test_a_failing_run_says_with_what():
    data = [measured("ball", "mass", 10 * mass(BALL))]
    small = apply_settings(CASE, {"grid.size": "0.6 mm"})
    with pytest.raises(NumericalError, match="reached the edge of the window") as caught:
        calibrate(small, {"measured": data})
    assert f"with {BALL_K} = " in str(caught.value)


def test_a_forgotten_unit_is_refused_before_anything_is_fitted():
    entry = {"quantity": "mass", "before": 27.6445, "after": 27.6443, "resolution": 1e-4}
    runs = []
    data = [measured("ball", "mass", mass(50 * BALL)), {"body": "disk", **entry}]
    with pytest.raises(CaseError) as caught:
        calibrate(CASE, {"measured": data}, on_run=lambda run, misfit: runs.append(run))
    # A coefficient may be off by fifty.
    assert str(caught.value).startswith("measured.2 was read as ")
    assert len(str(caught.value).splitlines()) == 1
    assert not runs


@pytest.fixture(scope="module")
def held():
    """The ball's coefficient held by its bound, 1.2 against 2 ± 0.1; the disk's free."""
    data = [measured("ball", "mass", mass(2 * BALL)), DISK_LOSS]
    fit = [{"path": BALL_K, "upper": 1.2 * BALL}, *fitting(DISK_K)]
    return calibrate(CASE, {"measured": data, "fit": fit})


@pytest.mark.slow
def test_an_estimate_held_by_its_bound_has_no_interval_and_data_and_model_disagree(held):
    ball, disk = held.parameters.itertuples()
    assert ball.value == pytest.approx(1.2 * BALL, rel=1e-6, abs=0)
    assert (ball.held, disk.held) == (True, False)
    assert "held by its upper bound" in str(estimates_table(held))
    assert (ball.lower, ball.upper) == (0, 1.2 * BALL)
    assert held.chi_square == pytest.approx(64)
    assert held.data["residual"].iloc[0] == pytest.approx(-8)
    assert held.degrees_of_freedom == 1
    assert held.p_value < 1e-14
    places = {each.kind: each.place for each in held.findings}
    assert (places["held"], places["misfit"]) == (BALL_K, "measured.1")
    assert "untested" not in places


@pytest.mark.slow
def test_only_what_depends_on_a_held_parameter_is_predicted_without_an_interval(held):
    """By Archard's law each volume is its own coefficient's; the groove's depth is of both."""
    ends = {(p.body, p.quantity): (p.lower, p.upper) for p in held.predictions.itertuples()}
    half, volume = 1.959964 * 0.05, DISK * LOAD * DISTANCE
    assert ends["disk", "volume"] == pytest.approx(
        (volume * (1 - half), volume * (1 + half)), rel=1e-3, abs=0
    )
    assert ends["ball", "volume"] == ends["disk", "depth"] == (0, np.inf)


def test_a_parameter_stays_within_an_open_bound():
    """Poisson's ratio is below a half."""
    fit = fitting("bodies.ball.material.poisson")
    asked = read_measurements({"measured": [BALL_LOSS], "fit": fit})
    parameters = find_parameters(validate_case(CASE), asked.fit, ["ball"])
    assert 0.499 < parameters[0].upper < 0.5
    run = make_run(CASE, parameters, np.array([0.5 + 1e-12]), [Reading("ball", "mass")])
    assert run.responses == pytest.approx([mass(BALL)], rel=1e-6, abs=0)
