"""A calibration gives back what the data were made with, and says what they cannot tell."""

import tomllib
import warnings

import numpy as np
import pytest
from scipy.stats import binom

from tribo.closed_forms.ball_on_track import ball_on_track
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, NumericalError, TriboWarning
from tribo.simulation.run import Simulation
from tribo.study import calibrate
from tribo.study.calibration import runs as calibration_runs
from tribo.study.calibration.far_off import FarOff, check_far_off, far_off
from tribo.study.calibration.measured import read_measurements
from tribo.study.calibration.parameters import Parameter, find_parameters
from tribo.study.calibration.quantities import QUANTITIES, percent
from tribo.study.calibration.runs import Runs
from tribo.templates import template

TRUE = {"bodies.ball.wear.k": 3.11e-16, "bodies.disk.wear.k": 1.5e-16}
CHEAP = {
    "grid": {"size": "1 mm", "cells": 24},
    "contact": {"type": "winkler"},
    "stepping": {"type": "implicit", "depth_tolerance": 1e-2, "pressure_tolerance": 0.3},
    "kinematics.duration": 300,
    "output": {},
    **TRUE,
}
CASE = apply_settings(tomllib.loads(template("ball_on_disk")), CHEAP)
LOAD, DISTANCE, DENSITY = 100.0, 30.0, 7850.0
BALL, DISK = TRUE.values()
SPLIT = apply_settings(
    tomllib.loads(template("weighed_split")),
    {"grid.cells": 24, "contact": {"type": "winkler"}, "output": {}},
)


def mass(k):
    """What Archard's law takes off in the cheap case, in kg."""
    return k * LOAD * DISTANCE * DENSITY


def weighed(body, kilograms, part=0.05):
    return {
        "body": body,
        "quantity": "mass",
        "value": kilograms,
        "uncertainty": part * abs(kilograms),
    }


def measured(body, quantity, value, part):
    return {"body": body, "quantity": quantity, "value": value, "uncertainty": part * value}


def fitting(*paths, **start):
    return [{"path": path, **start} for path in paths]


@pytest.fixture(scope="module")
def true_run():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        with Simulation(validate_case(CASE)).run() as result:
            yield result


def computed(result, body, quantity, save=-1):
    return QUANTITIES[quantity].read(result, result.body(body), save)


def test_masses_give_each_coefficient_in_four_runs():
    runs = []
    found = calibrate(
        CASE,
        {
            "measured": [weighed("ball", mass(BALL)), weighed("disk", mass(DISK))],
            "fit": [
                {"path": "bodies.ball.wear.k", "start": 1.5 * BALL},
                {"path": "bodies.disk.wear.k", "start": "2e-7 mm^3/(N m)"},
            ],
        },
        on_run=lambda run, misfit: runs.append((run, misfit)),
    )
    assert found.settings == pytest.approx(TRUE, rel=1e-9, abs=0)
    assert found.runs == len(runs) == 4
    assert [run for run, _ in runs] == [1, 2, 3, 4]
    assert runs[-1][1] == pytest.approx(0, abs=1e-9)
    for each in found.parameters:
        # A volume is k F s, so that its uncertainty is that of k; its ends are found to 1e-3 of it.
        half = 1.959964 * 0.05 * each.value
        assert (each.lower, each.upper) == pytest.approx(
            (each.value - half, each.value + half), rel=5e-5, abs=0
        )
    assert abs(found.correlation[0, 1]) < 1e-6
    assert found.singular_values == pytest.approx([20, 20])


def test_without_fit_the_coefficients_of_what_was_measured_are_fitted():
    found = calibrate(CASE, {"measured": [weighed("ball", mass(2 * BALL))]})
    assert found.settings == pytest.approx({"bodies.ball.wear.k": 2 * BALL}, rel=1e-6, abs=0)


def test_the_experiment_gives_the_weighed_coefficients_and_the_crown():
    """2.0 and 0.2 mg in 360 m at 100 N; the crown is that of the closed rigid limit, within it."""
    data = {
        "measured": [
            {"body": "ball", "quantity": "mass", "value": "2.0 mg", "resolution": "0.1 mg"},
            {
                "body": "disk",
                "quantity": "mass",
                "before": "27.6445 g",
                "after": "27.6443 g",
                "resolution": "0.1 mg",
            },
        ],
        "fit": fitting(*TRUE, start="3.11e-16 1/Pa"),
    }
    found = calibrate(apply_settings(SPLIT, {"grid.cells": 64}), data)
    ball, disk = found.parameters
    assert ball.value == pytest.approx(7.08e-15, rel=1e-3, abs=0)
    assert disk.value == pytest.approx(7.08e-16, rel=1e-3, abs=0)
    # Two readings, each off by up to half a step: 0.1 of 2 mg and of 0.2 mg at most.
    assert ball.resolution_limit == pytest.approx(0.05)
    assert disk.resolution_limit == pytest.approx(0.5)
    assert (disk.lower, disk.upper) == pytest.approx(
        disk.value * np.array([1 - 1.96 * 0.5 / 6**0.5, 1 + 1.96 * 0.5 / 6**0.5]), rel=1e-3, abs=0
    )
    assert any("bodies.disk.wear.k: the balance's resolution dominates" in n for n in found.notes)
    assert any("±50 % open" in note for note in found.notes)
    (crown,) = (p for p in found.predictions if (p.body, p.quantity) == ("ball", "crown"))

    def rigid(k_disk):
        return ball_on_track(
            [360.0],
            load=100.0,
            radius=5e-3,
            track_length=2e-3,
            ball_wear_coefficient=ball.value,
            flat_wear_coefficient=k_disk,
        ).flat_depth[0]

    assert crown.value == pytest.approx(rigid(disk.value), rel=0.03)
    assert crown.lower / crown.value == pytest.approx(
        rigid(disk.lower) / rigid(disk.value), rel=0.1
    )
    assert crown.upper / crown.value == pytest.approx(
        rigid(disk.upper) / rigid(disk.value), rel=0.1
    )


def test_scar_widths_and_the_groove_give_both_coefficients(true_run):
    data = [
        measured("ball", "scar_along", computed(true_run, "ball", "scar_along"), 0.02),
        measured("ball", "scar_across", computed(true_run, "ball", "scar_across"), 0.02),
        measured("disk", "depth", computed(true_run, "disk", "depth"), 0.05),
    ]
    found = calibrate(CASE, {"measured": data, "fit": fitting(*TRUE, start=2.5e-16)})
    for each in found.parameters:
        assert each.value == pytest.approx(TRUE[each.path], rel=0.02, abs=0)
        assert each.lower < TRUE[each.path] < each.upper
    assert found.degrees_of_freedom == 1
    assert found.p_value > 0.5
    assert found.runs <= 7


def test_profiles_are_fitted_where_they_were_measured(true_run):
    body, y = true_run.body("disk"), true_run.grid.y
    at = np.linspace(-0.4e-3, 0.4e-3, 9)
    depths = np.interp(at, y, body.wear_depth[-1, 0])
    data = {
        "body": "disk",
        "quantity": "profile_across",
        "position": at.tolist(),
        "value": depths.tolist(),
        "uncertainty": "0.02 um",
    }
    start = fitting("bodies.disk.wear.k", start=2.5e-16)
    found = calibrate(CASE, {"measured": [data], "fit": start})
    assert found.settings["bodies.disk.wear.k"] == pytest.approx(DISK, rel=0.01, abs=0)
    assert len(found.data) == 9
    assert [each.position for each in found.data] == at.tolist()


def test_other_numbers_of_the_case_can_be_fitted(true_run):
    half = {"time": 100.0, **measured("ball", "volume", BALL * LOAD * 10, 0.02)}
    depth = measured("ball", "depth", computed(true_run, "ball", "depth"), 0.02)
    fit = [{"path": "load.normal", "start": "70 N", "lower": "10 N", "upper": "300 N"}]
    found = calibrate(CASE, {"measured": [half, depth], "fit": fit})
    assert found.settings == pytest.approx({"load.normal": 100.0}, rel=1e-3)
    assert found.parameters[0].unit == "N"


def test_two_parameters_that_do_the_same_are_named():
    data = [weighed("ball", mass(BALL)), measured("ball", "volume", mass(BALL) / DENSITY, 0.05)]
    fit = fitting("bodies.ball.wear.k", "load.normal")
    found = calibrate(CASE, {"measured": data, "fit": fit})
    assert [(each.lower, each.upper) for each in found.parameters] == [(0, np.inf)] * 2
    assert abs(found.correlation[0, 1]) == pytest.approx(1)
    (note,) = (n for n in found.notes if "apart" in n)
    assert note.startswith(
        "the data cannot tell bodies.ball.wear.k and load.normal apart: raising one and lowering "
        "the other changes none of the computed values"
    )
    assert "load.normal: the data do not bound it from below or above" in found.notes
    plain = found.as_json()
    assert plain["parameters"][0]["upper"] is None


def test_data_at_odds_with_the_model_are_told():
    data = [weighed("ball", mass(BALL), 0.01), weighed("ball", 1.2 * mass(BALL), 0.01)]
    found = calibrate(CASE, {"measured": data})
    assert found.p_value < 1e-6
    assert any(note.startswith("data and model disagree: χ² is") for note in found.notes)


def test_a_balance_that_is_too_coarse_is_told():
    loss = {"body": "ball", "quantity": "mass", "value": mass(BALL), "resolution": "0.1 mg"}
    found = calibrate(CASE, {"measured": [loss]})
    assert (
        "the balance is too coarse: read to 0.1 mg, the mass of 'ball' may be off by 0.1 mg, and "
        "0.00732 mg is given"
    ) in found.notes
    fine = calibrate(CASE, {"measured": [loss | {"resolution": "1 ug"}]})
    assert not any("too coarse" in note for note in fine.notes)


@pytest.fixture(scope="module")
def fine_run():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        with Simulation(validate_case(apply_settings(CASE, {"grid.cells": 96}))).run() as result:
            yield result


@pytest.mark.parametrize("cells", [24, 27])
def test_what_a_coarse_grid_cannot_tell_is_left_uncertain(fine_run, cells):
    """Estimates and predictions cover what made the data, though those are far more exact."""
    read = [("ball", "scar_along"), ("ball", "scar_across"), ("disk", "depth")]
    data = [measured(*each, computed(fine_run, *each), 0.003) for each in read]
    coarse = apply_settings(CASE, {"grid.cells": cells})
    found = calibrate(coarse, {"measured": data, "fit": fitting(*TRUE, start=2e-16)})
    for each in found.parameters:
        assert each.lower < TRUE[each.path] < each.upper
    for each in found.predictions:
        assert each.lower < computed(fine_run, each.body, each.quantity) < each.upper


def test_widths_finer_than_the_grid_are_told(true_run):
    data = [measured("ball", "scar_across", computed(true_run, "ball", "scar_across"), 0.005)]
    found = calibrate(CASE, {"measured": data})
    assert any("raise grid.cells" in note for note in found.notes)


def test_a_failing_run_says_with_what_and_what_may_be_off():
    with pytest.raises(NumericalError) as caught:
        calibrate(CASE, {"measured": [weighed("ball", 50 * mass(BALL))]})
    assert "with bodies.ball.wear.k = " in str(caught.value)
    assert "reached the edge of the window" in str(caught.value)
    assert str(caught.value).endswith(
        "; or is a measured value off? measured[0]: value was read as 3.66e-07 kg, a factor of 50 "
        "above the 7.32e-09 kg that the case gives with bodies.ball.wear.k = 3.11e-16 1/Pa"
    )


@pytest.mark.parametrize(
    ("entry", "text"),
    [
        (
            {"body": "ball", "quantity": "mass", "value": "7.32 mg", "uncertainty": "1 ug"},
            "value was read as 7.32e-06 kg, a factor of ",
        ),
        (
            {"body": "ball", "quantity": "volume", "value": 0.25, "uncertainty": 0.02},
            "value was read as 0.25 m^3, a factor of ",
        ),
        (
            {"body": "disk", "quantity": "depth", "value": 0.1, "uncertainty": 3e-3},
            "value was read as 0.1 m, a factor of ",
        ),
        (
            {
                "body": "disk",
                "quantity": "profile_across",
                "value": [0.1, 0.2],
                "position": ["0 mm", "0.05 mm"],
                "uncertainty": 0.01,
            },
            "value was read as 0.2 m, a factor of ",
        ),
    ],
)
def test_a_forgotten_unit_is_refused_before_anything_is_fitted(entry, text):
    runs = []
    with pytest.raises(CaseError) as caught:
        calibrate(CASE, {"measured": [entry]}, on_run=lambda run, misfit: runs.append(run))
    assert str(caught.value).startswith(f"measured[0]: {text}")
    assert str(caught.value).endswith(
        ": check the value and its unit, or give a start in fit that is nearer to it"
    )
    assert not runs


@pytest.mark.parametrize(
    ("quantity", "value"),
    [("depth", "1e-30 m"), ("scar_along", 3e-11), ("mass", "1e-30 kg"), ("volume", 1e-33)],
)
def test_less_than_an_atom_is_refused_before_any_run(quantity, value):
    entry = {"body": "ball", "quantity": quantity, "value": value, "uncertainty": 1e-6}
    runs = []
    with pytest.raises(CaseError, match=r"measured\[0\].value: .* is less than an atom, about 1e-"):
        calibrate(CASE, {"measured": [entry]}, on_run=lambda run, misfit: runs.append(run))
    assert not runs


@pytest.mark.parametrize(
    "entry",
    [
        {**weighed("ball", mass(BALL)), "uncertainty": "0.1 g"},
        {
            "body": "disk",
            "quantity": "profile_across",
            "value": ["0.1 um", "0.2 um"],
            "position": ["0.1 mm", "0.05 mm"],
            "uncertainty": 0.01,
        },
    ],
)
def test_an_uncertainty_without_its_unit_is_told(entry):
    with pytest.raises(CaseError, match=r"wear.k changes is measured too badly to tell: .* of the"):
        calibrate(CASE, {"measured": [entry]})


@pytest.mark.parametrize(
    ("entry", "text"),
    [
        (
            measured("disk", "depth", 0.18e-9, 0.05),
            "measured[1]: value was read as 1.8e-10 m, a factor of ",
        ),
        (
            {
                "body": "disk",
                "quantity": "mass",
                "before": 27.6445,
                "after": 27.6443,
                "resolution": 1e-4,
            },
            "measured[1]: before less after was read as 0.0002 kg, a factor of ",
        ),
    ],
)
def test_what_is_far_from_what_the_case_gives_is_told(true_run, entry, text):
    entries = read_measurements({"measured": [weighed("ball", mass(50 * BALL)), entry]}).measured
    own = [computed(true_run, each.body, each.quantity) for each in entries]
    parameters = [Parameter("bodies.disk.wear.k", "1/Pa", DISK, 0.0, np.inf)]
    # A coefficient may be off by fifty.
    (maybe, told) = far_off(entries, np.array(own), parameters)
    assert maybe.factor == pytest.approx(50)
    assert told.factor > 300
    assert told.text.startswith(text)


@pytest.mark.parametrize(("sigmas", "factors"), [(0.5, []), (4.9, []), (20.0, [20.0])])
def test_a_null_result_is_as_far_off_as_its_uncertainty_is(sigmas, factors):
    """A disk that lost 1.2 ng give or take a microgram, where the case takes off so many σ."""
    data = {**weighed("disk", 1.22e-12), "uncertainty": 9.8e-10}
    parameters = [Parameter("bodies.disk.wear.k", "1/Pa", DISK, 0.0, np.inf)]
    entries = read_measurements({"measured": [data]}).measured
    found = far_off(entries, np.array([sigmas * 9.8e-10]), parameters)
    assert [each.factor for each in found] == pytest.approx(factors)


@pytest.mark.parametrize(("factor", "is_told"), [(99.0, False), (101.0, True), (299.0, True)])
def test_what_is_far_off_but_may_be_meant_is_told(factor, is_told):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        check_far_off([FarOff(factor, "measured[0]")])
    assert [str(each.message) for each in caught] == [
        "measured[0]: is that the value, and the unit, that was meant?"
    ] * is_told


def test_an_estimate_held_by_its_bound_has_no_interval_and_data_and_model_disagree():
    fit = [{"path": "bodies.ball.wear.k", "upper": 1.2 * BALL}]
    found = calibrate(CASE, {"measured": [weighed("ball", mass(2 * BALL))], "fit": fit})
    (each,) = found.parameters
    assert each.value == pytest.approx(1.2 * BALL, rel=1e-6, abs=0)
    assert each.held
    assert (each.lower, each.upper) == (0, 1.2 * BALL)
    assert {(p.lower, p.upper) for p in found.predictions if p.body == "ball"} == {(0, np.inf)}
    # 1.2 against 2 ± 0.1, and nothing that could be fitted.
    assert found.chi_square == pytest.approx(64)
    assert found.degrees_of_freedom == 1
    assert found.p_value < 1e-14
    assert any(
        n.startswith(
            "bodies.ball.wear.k: the estimate lies on its upper bound, 3.73e-16 1/Pa, and has no "
            "interval; without the bound"
        )
        for n in found.notes
    )
    assert any(
        n.startswith(
            "data and model disagree: χ² is 64 where about 1 is expected; the mass of 'ball' is "
            "off by 8 times its uncertainty"
        )
        for n in found.notes
    )
    assert not any("nothing is left to test" in n for n in found.notes)


def test_only_what_depends_on_a_held_parameter_is_predicted_without_an_interval():
    """By Archard's law each volume is its own coefficient's; the groove's depth is of both."""
    data = [weighed("ball", mass(2 * BALL)), weighed("disk", mass(DISK))]
    fit = [{"path": "bodies.ball.wear.k", "upper": 1.2 * BALL}, *fitting("bodies.disk.wear.k")]
    found = calibrate(CASE, {"measured": data, "fit": fit})
    assert [each.held for each in found.parameters] == [True, False]
    ends = {(p.body, p.quantity): (p.lower, p.upper) for p in found.predictions}
    half = 1.959964 * 0.05
    volume = DISK * LOAD * DISTANCE
    assert ends["disk", "volume"] == pytest.approx(
        (volume * (1 - half), volume * (1 + half)), rel=1e-3, abs=0
    )
    assert ends["ball", "volume"] == ends["disk", "depth"] == (0, np.inf)


def test_a_parameter_stays_within_an_open_bound():
    """Poisson's ratio is below a half."""
    data = [weighed("ball", mass(BALL))]
    path = "bodies.ball.material.poisson"
    entries = read_measurements({"measured": data, "fit": fitting(path)})
    case = validate_case(CASE)
    (parameter,) = find_parameters(case, entries.fit, entries.measured)
    assert 0.499 < parameter.upper < 0.5
    runs = Runs(CASE, entries.measured, [parameter], [], None)
    assert runs(np.array([0.5 + 1e-12])) == pytest.approx([mass(BALL)], rel=1e-6, abs=0)


def test_what_was_measured_at_the_end_is_not_predicted():
    entry = {"time": 300.0, **weighed("ball", mass(BALL))}
    found = calibrate(CASE, {"measured": [entry]})
    assert ("ball", "mass") not in [(each.body, each.quantity) for each in found.predictions]
    (datum,) = found.as_json()["data"]
    assert (datum["time_s"], datum["position_m"]) == (300.0, None)


@pytest.mark.parametrize(
    ("part", "text"), [(2e-14, "0.0"), (0.0526, "5.3"), (0.0996, "10"), (1, "100"), (2.5, "250")]
)
def test_percent_are_written_out(part, text):
    assert percent(part) == text


def test_intervals_cover_the_truth_at_their_level(monkeypatch):
    """Of 25 draws of three noisy measurements."""
    kept = {}

    class Remembered(calibration_runs.Runs):
        """Every draw begins with the same runs."""

        def __call__(self, values):
            key = values.tobytes()
            if key not in kept:
                kept[key] = super().__call__(values), self.read_off
            responses, self.read_off = kept[key]
            return responses.copy()

    monkeypatch.setattr("tribo.study.calibration.calibrate.Runs", Remembered)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        with Simulation(validate_case(CASE)).run() as result:
            exact = np.array(
                [
                    computed(result, body, quantity)
                    for body, quantity in (
                        ("ball", "mass"),
                        ("ball", "scar_along"),
                        ("disk", "depth"),
                    )
                ]
            )
    parts = np.array([0.2, 0.05, 0.15])
    draws, level, random = 25, 0.8, np.random.default_rng(5)
    covered = np.zeros(2, dtype=int)
    for _ in range(draws):
        drawn = exact * (1 + parts * random.standard_normal(3))
        data = [
            {"body": body, "quantity": quantity, "value": value, "uncertainty": sigma}
            for (body, quantity), value, sigma in zip(
                (("ball", "mass"), ("ball", "scar_along"), ("disk", "depth")),
                drawn,
                parts * exact,
                strict=True,
            )
        ]
        found = calibrate(CASE, {"measured": data, "fit": fitting(*TRUE)}, level=level)
        for i, each in enumerate(found.parameters):
            covered[i] += each.lower <= TRUE[each.path] <= each.upper
    low, high = binom.ppf([0.002, 0.998], draws, level)
    assert np.all((covered >= low) & (covered <= high)), covered
