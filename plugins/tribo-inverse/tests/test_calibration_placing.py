"""A map off its middle is met all the same; one not levelled or of another pitch is told."""

from types import SimpleNamespace

import numpy as np
import pytest
from calibrations import cheap, kept_runs, on_springs
from scipy.ndimage import shift as moved
from scipy.stats import binom
from tribo.cli.console import Console
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, NumericalError, OutOfWindow, TriboError
from tribo.lab.heights import Heights
from tribo.simulation.run import Simulation

from tribo_inverse.calibration import mapped
from tribo_inverse.calibration.calibrate import calibrate
from tribo_inverse.calibration.doubts import doubts
from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.fit import Unsettled
from tribo_inverse.calibration.map_notes import off_turn
from tribo_inverse.calibration.mapped import calibrate_maps
from tribo_inverse.calibration.maps import FittedMaps
from tribo_inverse.calibration.measured import MapEntry
from tribo_inverse.calibration.scar_shift import ScarShift, find_shift
from tribo_inverse.tables import data_table

PIN_K, DISK_K = "bodies.pin.wear.k", "bodies.disk.wear.k"
K, TRUE = "bodies.ball.wear.k", 3e-16
CASE = apply_settings(cheap(60), {"grid.cells": 32, K: TRUE, "bodies.disk.wear.k": TRUE})
PIXELS, PITCH, NOISE = 128, 1e-3 / 128, 20e-9


@pytest.fixture(scope="module", autouse=True)
def runs_made_once():
    with kept_runs():
        yield


@pytest.fixture(scope="module")
def worn():
    """The ball's depth on four pixels a cell's edge, in m."""
    fine = apply_settings(CASE, {"grid.cells": PIXELS, "stepping.depth_tolerance": 1e-2})
    with Simulation(validate_case(fine)).run() as result:
        return result.body("ball").wear_depth[-1].copy()


@pytest.fixture
def fitted(worn, tmp_path):
    """What is found from the ball's map with noise: shifted, lifted, of another pitch."""

    def found(
        shift=(0.0, 0.0),
        level=0.0,
        pitch=1.0,
        noise=NOISE,
        seed=0,
        missing=False,
        swapped=False,
        case=CASE,
    ):
        depth = moved(worn.T if swapped else worn, np.array(shift) / PITCH, order=1) + level
        depth += 4 * noise * np.random.default_rng(seed).standard_normal(depth.shape)
        depth[np.broadcast_to(missing, depth.shape)] = np.nan
        np.save(tmp_path / "map.npy", depth)
        entry = {"body": "ball", "quantity": "depth_map", "depth": str(tmp_path / "map.npy")}
        entry |= {"pitch": pitch * PITCH, "uncertainty": noise}
        return calibrate(case, {"measured": [entry], "fit": [{"path": K}]})

    return found


def covers(found):
    (each,) = found.parameters.itertuples()
    return each.lower < TRUE < each.upper


def test_a_map_off_its_middle_is_met_and_told(fitted, capsys):
    found = fitted((52e-6, -31e-6))
    assert covers(found)
    assert found.p_value > 0.01
    (note,) = found.notes
    assert note.startswith("the scar in the depth_map of 'ball' lies +5")
    assert note.endswith("across the sliding direction from the middle of the map")
    assert found.degrees_of_freedom == len(found.data) - 3
    assert found.data["shift_x_m"].unique() == pytest.approx([52e-6], abs=1e-6)
    assert found.data["shift_y_m"].unique() == pytest.approx([-31e-6], abs=1e-6)
    Console(width=120).table(data_table(found))
    assert "mean, off centre by +5" in capsys.readouterr().out


def test_a_map_in_its_middle_is_left_there(fitted):
    found = fitted()
    assert covers(found)
    assert found.notes == ()
    assert not found.data[["shift_x_m", "shift_y_m"]].any(axis=None)


@pytest.mark.slow
def test_intervals_cover_the_coefficient_wherever_the_map_has_its_scar(fitted):
    """The noise puts the coefficient off by as much as the grid does."""
    random, draws = np.random.default_rng(1), 6
    covered = sum(
        covers(fitted(random.uniform(-60e-6, 60e-6, 2), noise=200e-9, seed=i)) for i in range(draws)
    )
    assert covered >= binom.ppf(0.002, draws, 0.95)


def test_missing_pixels_change_neither_the_coefficient_nor_the_misfit(fitted):
    whole, band = fitted(noise=3e-9), np.zeros((PIXELS, PIXELS), dtype=bool)
    band[:, 50:57] = True
    spots = np.random.default_rng(1).random(band.shape) < 0.2
    for missing in (band, spots):
        found = fitted(noise=3e-9, missing=missing)
        assert covers(found)
        assert found.chi_square < 1.5 * whole.chi_square


def test_swapped_axes_are_named(fitted):
    assert fitted().notes == ()
    notes = fitted(swapped=True).notes
    assert notes[0].startswith("the depth_map of 'ball' fits far better with its axes swapped (x g")
    assert not any("too would lower" in note for note in notes)


def test_the_coefficient_that_is_not_fitted_and_wrong_is_named(fitted):
    wrong = fitted(case=apply_settings(CASE, {DISK_K: 3 * TRUE}))
    (note,) = (note for note in wrong.notes if f"Fitting {DISK_K} too would lower" in note)
    left = float(note.split("χ² to about ")[1].split(",")[0])
    assert left == pytest.approx(fitted().chi_square, rel=0.2)
    assert not any("try grid.cells" in each for each in wrong.notes)


@pytest.mark.parametrize(("level", "way"), [(1e-6, "above"), (-1e-7, "below")])
def test_a_map_that_is_not_levelled_is_named(fitted, level, way):
    (note,) = (note for note in fitted(level=level).notes if "level it first" in note)
    told = note.removeprefix("outside the scar the depth_map of 'ball' lies ")
    assert float(told.split()[0]) == pytest.approx(1e6 * abs(level), rel=0.03)
    assert f"µm {way} 0: level it first, as tribo scar does" in told


@pytest.mark.parametrize("pitch", [1.02, 1.05, 0.95, 0.5, 0.66, 1.5, 2, 3])
def test_a_wrong_pitch_is_named(fitted, pitch):
    (note,) = (note for note in fitted(pitch=pitch).notes if "check pitch" in note)
    off = 0.015 if abs(pitch - 1) < 0.1 else 0.25
    assert float(note.split(" times")[0].split()[-1]) == pytest.approx(pitch, abs=off)


def test_the_pitch_comes_first_where_it_fails_a_fit(worn, tmp_path):
    np.save(tmp_path / "map.npy", 6 * worn)
    entry = {"body": "ball", "quantity": "depth_map", "depth": str(tmp_path / "map.npy")}
    entry |= {"pitch": 3 * PITCH, "uncertainty": NOISE}
    with pytest.raises(NumericalError, match=r"^check pitch; run .* reached the edge of the win"):
        calibrate(CASE, {"measured": [entry], "fit": [{"path": K}]})


@pytest.mark.parametrize(
    ("turned", "way"),
    [(np.transpose, "with its axes swapped"), (np.flipud, "mirrored along"), (None, "")],
)
def test_a_map_whose_axes_are_swapped_or_mirrored_is_named(worn, turned, way):
    """A scar longer on one side, as of a tilted pin."""
    depth = worn.reshape(32, 4, 32, 4).mean(axis=(1, 3))
    depth[:16] *= 0.8
    noisy = depth + NOISE * np.random.default_rng(0).standard_normal(depth.shape)
    # Where half of it is missing, the other half tells nothing of how it is turned.
    half = np.where(np.indices(noisy.shape)[0] < 16, np.nan, noisy)
    assert not [*off_turn("it", half, depth)]
    told = "".join(off_turn("it", noisy if turned is None else turned(noisy), depth))
    assert told.startswith(f"it fits far better {way}" if way else "")
    assert bool(told) == bool(way)


@pytest.mark.parametrize("factor", [1, 5])
@pytest.mark.parametrize("cells", [16, 32])
def test_uncertainties_that_are_too_large_are_told(worn, tmp_path, cells, factor):
    """But not what the grid adds to them."""
    noise = 4 * NOISE * np.random.default_rng(0).standard_normal(worn.shape)
    np.save(tmp_path / "map.npy", worn + noise)
    entry = {"body": "ball", "quantity": "depth_map", "depth": str(tmp_path / "map.npy")}
    entry |= {"pitch": PITCH, "uncertainty": factor * NOISE * cells / 32}
    coarse = apply_settings(CASE, {"grid.cells": cells})
    found = calibrate(coarse, {"measured": [entry], "fit": [{"path": K}]})
    assert found.p_value > 0.999
    told = any("the uncertainties are too large" in note for note in found.notes)
    assert told == (factor > 1)


def profile_fitted(worn, cells, shift=0.0, seed=None):
    """What is found from a line across the ball's scar."""
    at = np.arange(-0.36e-3, 0.37e-3, 30e-6)
    middle = 0.5 * (worn[PIXELS // 2 - 1] + worn[PIXELS // 2])
    depths = np.interp(at - shift, PITCH * (np.arange(PIXELS) - 0.5 * (PIXELS - 1)), middle)
    if seed is not None:
        depths += NOISE * np.random.default_rng(seed).standard_normal(len(at))
    entry = {"body": "ball", "quantity": "profile_across", "uncertainty": NOISE}
    entry |= {"position": at.tolist(), "value": depths.tolist()}
    coarse = apply_settings(CASE, {"grid.cells": cells})
    return calibrate(coarse, {"measured": [entry], "fit": [{"path": K}]})


@pytest.mark.parametrize("shift", [40e-6, -40e-6, 10e-6])
def test_a_shifted_profile_is_named(worn, shift):
    (note,) = (n for n in profile_fitted(worn, 32, shift, 0).notes if "from its position 0" in n)
    told = note.removeprefix("the scar in the profile_across of 'ball' lies ")
    size = float(told.split()[0].replace("−", "-"))
    assert size == pytest.approx(1e6 * shift, rel=0.15, abs=2)
    assert "µm across the sliding direction" in told


@pytest.mark.slow
def test_a_profile_in_its_place_is_not_named(worn):
    found = [profile_fitted(worn, 32, seed=seed) for seed in range(4)]
    assert not any("position 0" in note for each in found for note in each.notes)


def test_what_no_pitch_explains_is_not_laid_to_it(worn, fitted, tmp_path):
    notes = [*fitted(level=1e-6).notes]
    spiked = worn.copy()
    spiked[64:68, 56:60] += 3 * np.max(worn)
    np.save(tmp_path / "map.npy", spiked)
    entry = {"body": "ball", "quantity": "depth_map", "depth": str(tmp_path / "map.npy")}
    entry |= {"pitch": PITCH, "uncertainty": NOISE}
    notes += calibrate(CASE, {"measured": [entry], "fit": [{"path": K}]}).notes
    # Nor is it told which of the ball's scars are as deep where its coefficient is not fitted.
    np.save(tmp_path / "map.npy", worn)
    little = apply_settings(CASE, {K: 0.1 * TRUE})
    notes += calibrate(little, {"measured": [entry], "fit": [{"path": DISK_K}]}).notes
    assert sum("data and model disagree" in note for note in notes) == 3
    assert [note for note in notes if "check pitch" in note] == []


@pytest.mark.parametrize("cells", [16, 20, 32])
def test_a_profile_is_met_on_a_coarse_grid(worn, cells):
    """To the noise, though its points and the cells lie apart."""
    found = profile_fitted(worn, cells)
    assert covers(found)
    assert found.p_value > 0.01
    assert found.settings[K] == pytest.approx(TRUE, rel=0.005, abs=0)


@pytest.mark.parametrize("cells", [16, 24])
def test_an_exact_map_is_met_on_coarse_grids(cells, tmp_path):
    """Of another test, on a half-space, made on 160 cells across the window."""
    case = on_springs("pin_on_disk", {"grid": {"size": "1.4 mm", "cells": cells}})
    case = apply_settings(case, {"contact.type": "dcfft", "load.normal": 15, PIN_K: 1e-15})
    case = apply_settings(case, {"kinematics.distance": 700, "bodies.disk.wear.k": 1e-14})
    with Simulation(validate_case(apply_settings(case, {"grid.cells": 160}))).run() as result:
        depths = {name: result.body(name).wear_depth[-1].copy() for name in ("pin", "disk")}
    entries = []
    for body, depth in depths.items():
        np.save(tmp_path / f"{body}.npy", depth)
        entry = {"body": body, "quantity": "depth_map", "depth": str(tmp_path / f"{body}.npy")}
        entries.append(entry | {"pitch": 1.4e-3 / 160, "uncertainty": 2e-9})
    found = calibrate(case, {"measured": entries})
    for each, true in zip(found.parameters.itertuples(), (1e-15, 1e-14), strict=True):
        assert each.lower < true < each.upper
        assert each.value == pytest.approx(true, rel=0.003, abs=0)
    assert found.p_value > 0.01


def test_a_start_far_off_is_no_matter(worn, tmp_path):
    np.save(tmp_path / "map.npy", worn)
    entry = {"body": "ball", "quantity": "depth_map", "depth": str(tmp_path / "map.npy")}
    entry |= {"pitch": PITCH, "uncertainty": NOISE}
    far = {"measured": [entry], "fit": [{"path": K, "start": 0.1 * TRUE}]}
    assert covers(calibrate(CASE, far))


def test_where_the_scar_outgrows_the_window_the_pitch_is_doubted(worn, tmp_path):
    np.save(tmp_path / "map.npy", worn)
    entry = {"body": "ball", "quantity": "depth_map", "depth": str(tmp_path / "map.npy")}
    experiment = Experiment.of(CASE, {"measured": [entry | {"pitch": PITCH, "uncertainty": NOISE}]})
    for kind in (OutOfWindow, Unsettled):
        assert list(doubts(experiment, kind("why"))) == ["check pitch"]
    assert list(doubts(experiment, NumericalError("another reason"))) == []


def test_uniform_wear_tells_no_place():
    depth = np.full((32, 32), 1e-6)
    pixels = depth + NOISE * np.random.default_rng(0).standard_normal(depth.shape)
    assert find_shift(Heights(pixels, (1e-6, 1e-6)), depth, (1e-6, 1e-6), NOISE) == ScarShift()


def test_the_map_of_a_local_coefficient_is_told_as_well(worn, tmp_path, monkeypatch):
    def unfitted(model, depths, priors, placed, on_run):
        off = 2e-6 if placed["ball"] == [0.25e-3, 0.25e-3] else 0.0
        return FittedMaps({"ball": SimpleNamespace(off=(off, 0.0), told=True)}, 0, 0, 1.0, 1.0)

    monkeypatch.setattr(mapped, "fit_maps", unfitted)
    entry = {"body": "ball", "depth": str(tmp_path / "map.npy"), "pitch": PITCH}
    entry = MapEntry(**entry, uncertainty=NOISE, length=1e-4)
    for shift in (52, 4):
        np.save(tmp_path / "map.npy", moved(worn, (1e-6 * shift / PITCH, 0), order=1) + 3e-7)
        place, level = calibrate_maps(CASE, {"map.0": entry}).notes
        # And 2 µm more by the fit.
        assert f"lies +{shift + 2}.0 µm along the sliding" in place
        assert "the map of 'ball' lies 0.3 µm above 0" in level
    np.save(tmp_path / "map.npy", worn)
    centred = entry.model_copy(update={"centred": True})
    assert not calibrate_maps(CASE, {"map.0": centred}).notes
    words = {4: "has 3.99 times the", 0.2: "has 0.2 times the", 0: "has none of the volume"}
    for factor, told in words.items():
        np.save(tmp_path / "map.npy", factor * worn)
        with pytest.raises(CaseError, match=rf"^map\.0\.depth: it {told}"):
            calibrate_maps(CASE, {"map.0": centred})
    # Its cause, if it shows; and not of the rim alone, which follows the width of the scar.
    np.save(tmp_path / "map.npy", worn + np.max(worn))
    with pytest.raises(CaseError, match=r"does not allow for: outside the scar the map"):
        calibrate_maps(CASE, {"map.0": centred})
    rim = np.where(worn > 0.15 * np.max(worn), np.nan, 4 * worn)
    np.save(tmp_path / "map.npy", rim)
    assert not calibrate_maps(CASE, {"map.0": centred}).notes
    np.save(tmp_path / "map.npy", 0.2 * worn)
    wide = centred.model_copy(update={"spread": 1.0})
    assert not calibrate_maps(CASE, {"map.0": wide}).notes

    def failed(*given, **more):
        raise NumericalError("a step failed")

    # Only words on the map tell why.
    np.save(tmp_path / "map.npy", worn + 3e-7)
    monkeypatch.setattr(mapped, "fit_maps", failed)
    with pytest.raises(NumericalError, match=r"the map of 'ball' lies 0\.3 µm above 0.*; a step f"):
        calibrate_maps(CASE, {"map.0": centred})


@pytest.mark.parametrize(
    ("scale", "k", "uncertainty", "words"),
    [
        (-1.0, TRUE, NOISE, r"map\.0\.depth: the depths are negative"),
        (
            1.0,
            1e-3 * TRUE,
            NOISE,
            r"map\.0\.depth: the largest depth was read as .* gives .*depths in m",
        ),
        (1.0, TRUE, NOISE, r"check the maps' pitch, level and uncertainty, .*; no step"),
        (1.0, 0.0, NOISE, r"map\.0\.body: 'ball' does not wear in this case"),
        (1.0, TRUE, 20e-3, r"map\.0\.uncertainty: 0\.02 m is over 300 times the largest depth"),
    ],
)
def test_a_map_that_is_not_of_the_case_is_told(
    worn, tmp_path, monkeypatch, scale, k, uncertainty, words
):
    def failing(*given, **named):
        raise NumericalError("no step")

    monkeypatch.setattr(mapped, "fit_maps", failing)
    np.save(tmp_path / "map.npy", scale * worn)
    entry = {"body": "ball", "depth": str(tmp_path / "map.npy"), "pitch": PITCH}
    entry = MapEntry(**entry, uncertainty=uncertainty, length=1e-4)
    with pytest.raises(TriboError, match=words):
        calibrate_maps(apply_settings(CASE, {K: k}), {"map.0": entry})
