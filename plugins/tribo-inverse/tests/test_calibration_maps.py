"""A local coefficient is found where the depth tells it, and left to the prior elsewhere."""

import json
from dataclasses import replace

import numpy as np
import pytest
from calibrations import cheap, of_kind
from click.testing import CliRunner
from scipy.ndimage import gaussian_filter1d, shift
from scipy.optimize import minimize
from scipy.special import kv
from tribo.cli.main import tribo
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, NumericalError, TriboError
from tribo.core.toml import to_toml
from tribo.lab.heights import Heights
from tribo.simulation.march import begin, march
from tribo.simulation.run import Simulation

from tribo_inverse.adjoint.view import View
from tribo_inverse.calibration import mapped
from tribo_inverse.calibration.cells import on_cells
from tribo_inverse.calibration.mapped import calibrate_map
from tribo_inverse.calibration.maps import FittedMap, _Posterior, fit_map
from tribo_inverse.calibration.measured import MapEntry, read_measurements
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.scar_shift import find_shift
from tribo_inverse.pictures import coefficient_map
from tribo_inverse.recording.local import localised

CASE = apply_settings(
    cheap(20),
    {"grid.cells": 16, "stepping.depth_tolerance": 0.1, "bodies.disk.wear.k": 9e-15},
)
NOISE, PIXEL = 10e-9, 1e-3 / 640


def worn(factor):
    """The depth of the groove, with a factor on the disk's coefficient across it."""
    model = Simulation(validate_case(CASE)).model
    *_, last = march(made := localised(model, {"disk": factor}), begin(made))
    return View(made, last.state).wear("disk")


@pytest.fixture(scope="module")
def truth():
    y = Simulation(validate_case(CASE)).model.grid.y
    return np.exp(-0.5 * np.exp(-(((y - 60e-6) / 150e-6) ** 2)))[None]


@pytest.fixture(scope="module")
def depth(truth):
    clean = worn(truth)
    return clean + NOISE * np.random.default_rng(4).standard_normal(clean.shape)


@pytest.fixture(scope="module")
def done(depth, tmp_path_factory):
    """What the command prints and writes of pixels, two by twenty a cell."""
    folder = tmp_path_factory.mktemp("map")
    (folder / "case.toml").write_text(to_toml(CASE))
    np.save(folder / "depth.npy", np.repeat(np.repeat(depth, 20, axis=0), 2, axis=1))
    table = {"body": "disk", "depth": str(folder / "depth.npy"), "pitch": 1e-3 / 32}
    table |= {"uncertainty": "10 nm", "spread": 0.4, "length": "0.1 mm"}
    (folder / "mapped.toml").write_text(to_toml({"map": [table]}))
    command = ["calibrate", folder / "case.toml", "--measured", folder / "mapped.toml", "--json"]
    ended = CliRunner().invoke(tribo, [*map(str, command), "-o", str(folder / "found.npz")])
    assert ended.exit_code == 0, ended.output
    return json.loads(ended.stdout[: ended.stdout.rindex("}") + 1]), folder


def test_the_prior_is_the_field_that_it_says():
    """Whittle's covariance, s² r K₁(r) with r in lengths, in the plane and along a line."""
    n, h = 64, 5e-6
    for shape in ((n, n), (1, n)):
        prior = Prior(0.4, 4 * h)
        variance = prior.amplitudes(shape, (h, h)) ** 2
        # Away from the ends a wave's covariance is its cosine, and the mean counts half.
        counted = np.where(np.arange(n) == 0, 0.5, 1.0)
        across = counted if shape[0] > 1 else np.ones(1)
        far = np.arange(16)
        waves = np.cos(np.pi * far[:, None] * np.arange(n) / n)
        spectrum = counted * np.sum(across[:, None] * variance, axis=0)
        along = np.sum(spectrum * waves, axis=1)
        part = far[1:] / 4
        assert along[1:] / along[0] == pytest.approx(part * kv(1, part), abs=0.025)


@pytest.mark.parametrize("length", [0.1e-3, 0.4e-3])
def test_the_prior_is_as_wide_at_the_ends_as_it_says(depth, length):
    """A sum of waves with reflecting ends alone would be 1.4 times as wide there."""
    waves = _Posterior(
        Simulation(validate_case(CASE)).model,
        "disk",
        depth,
        NOISE,
        Prior(0.5, length),
        print,
        (0.0, 0.0),
    )
    each = np.array([waves.logs(z) for z in np.eye(16)])
    assert np.sqrt(np.sum(each**2, axis=0)) == pytest.approx(0.5)
    assert each == pytest.approx(np.array([waves.adjoint(slope) for slope in np.eye(16)]).T)


@pytest.mark.slow
def test_a_groove_off_the_middle_of_its_map_has_no_other_coefficient(tmp_path):
    clean = worn(np.ones((1, 16)))
    pixels = np.repeat(np.repeat(clean, 40, axis=1), 40, axis=0)
    pixels = shift(gaussian_filter1d(pixels, 20, axis=1), (0, 19.2e-6 / PIXEL), order=1)
    pixels += NOISE * 40**0.5 * np.random.default_rng(1).standard_normal(pixels.shape)
    np.save(tmp_path / "depth.npy", pixels)
    entry = {"body": "disk", "depth": str(tmp_path / "depth.npy"), "pitch": PIXEL}
    entry = MapEntry(**entry, uncertainty=NOISE, length=0.1e-3)
    found = calibrate_map(CASE, entry)
    lower, upper = found.interval(0.95)
    assert np.all((lower < 1) & (upper > 1))
    assert found.factor == pytest.approx(1, abs=0.15)
    assert found.p_value > 0.01


@pytest.mark.slow
def test_a_dip_of_a_coefficient_is_found_where_the_depth_tells_it(done, truth, depth):
    told, folder = done
    names = ("factor", "lower", "upper", "deviation", "told")
    factor, lower, upper, deviation, known = (np.array(told[n]) for n in names)
    deep = depth > 0.3 * depth.max()
    assert factor[deep] == pytest.approx(truth[deep], abs=0.1)
    assert np.mean(((lower < truth) & (truth < upper))[deep]) > 0.8
    assert told["p_value"] > 0.01
    # Where nothing was worn it is as uncertain as before.
    assert np.all(known[deep])
    assert not np.any(known[:, [0, -1]])
    assert deviation[0, 0] > 0.9 * 0.4
    silent = {each["kind"]: each["value"] for each in told["findings"]}["unknown"]
    assert silent == np.sum(~known)
    assert len(told["notes"]) == len(told["findings"])
    with np.load(folder / "found.npz") as arrays:
        assert arrays["factor"] == pytest.approx(factor)
    assert (folder / "found.png").stat().st_size > 5000


@pytest.mark.slow
@pytest.mark.parametrize(("placed", "cell", "sign"), [((0.0, 0.0), 6, -1), ((0.0, 0.25e-3), 11, 1)])
def test_a_standard_deviation_is_that_of_the_profile_likelihood(depth, placed, cell, sign):
    """Held that far off at a cell, the most probable map is less so by a factor of exp(-1/2).

    In the groove, and at its edge where the map may be off its middle.
    """
    given = "disk", depth, NOISE, Prior(0.4, 0.1e-3)
    found = fit_map(CASE, *given, placed=placed)
    waves = _Posterior(Simulation(validate_case(CASE)).model, *given, lambda misfit: None, placed)
    each = np.array([waves.logs(z) for z in np.eye(16)])
    near = np.linalg.solve(each.T, found.logs[0])
    waves.weigh(near)
    sigma = found.uncertainty.ravel()
    waves.weights = replace(waves.weights, sigma=sigma)

    def surprise(z):
        value, slope = waves.gradient(waves.logs(z))
        return value + 0.5 * z @ z, waves.adjoint(slope) + z

    best = minimize(surprise, near, jac=True, method="BFGS", options={"gtol": 1e-3})
    held = found.logs[0, cell] + sign * found.deviation[0, cell]
    along = waves.adjoint(np.eye(16)[cell])
    off = {"type": "eq", "fun": lambda z: along @ z - held, "jac": lambda z: along}
    beside = minimize(
        surprise, best.x, jac=True, method="SLSQP", constraints=[off], options={"ftol": 1e-4}
    )
    assert beside.fun - best.fun == pytest.approx(0.5, abs=0.03 if any(placed) else 0.01)


@pytest.mark.slow
def test_depths_that_no_smooth_map_explains_are_noticed(depth):
    stripes = depth + 15 * NOISE * (-1.0) ** np.arange(depth.size)
    found = fit_map(CASE, "disk", stripes, NOISE, Prior(0.1, 300e-6))
    assert found.p_value < 1e-6
    assert [each.value for each in of_kind(found, "misfit")] == [found.chi_square]


@pytest.mark.parametrize("count", [17, 81])
def test_cells_have_their_part_of_the_pixels_that_they_cut(count):
    """Of a scar on 16 cells, 0.6 of the window wide: all of its volume, each depth to 1 %."""

    def means(n):
        x = (np.arange(20 * n) + 0.5) / (20 * n) - 0.5
        scar = np.maximum(1 - (x[:, None] ** 2 + x**2) / 0.3**2, 0)
        return scar.reshape(n, 20, n, 20).mean(axis=(1, 3))

    found, _ = on_cells(Heights(means(count), (1 / count, 1 / count)), (16, 16), (1 / 16, 1 / 16))
    assert np.mean(found) == pytest.approx(np.mean(means(16)), rel=1e-4, abs=0)
    assert np.sqrt(np.mean((found - means(16)) ** 2)) < 0.005


def test_missing_pixels_leave_the_mean_of_a_cell_as_it_is():
    """On a slope of 1 per cell, with one pixel in five and a band missing."""
    count, n = 4, 64
    i, j = np.indices((n, n)) / count
    pixels = 0.3 * i + j
    whole = pixels.reshape(16, count, 16, count).mean(axis=(1, 3))
    pixels[np.random.default_rng(0).random((n, n)) < 0.2] = np.nan
    pixels[:, n // 2 + count // 2 : n // 2 + 2 * count] = np.nan
    found, noise = on_cells(Heights(pixels, (1 / count,) * 2), (16, 16), (1.0, 1.0))
    known = np.isfinite(found)
    inner = known & np.pad(np.ones((14, 14), bool), 1)
    assert np.sum(known) > 200
    assert found[inner] == pytest.approx(whole[inner], abs=0.05)
    part = np.isfinite(pixels).reshape(16, count, 16, count).mean(axis=(1, 3))
    assert noise[known] == pytest.approx(part[known] ** -0.5)


def test_a_cell_of_which_less_than_half_was_measured_is_left_out():
    pixels = np.ones((32, 32))
    pixels[4:6, 4], pixels[8:10, 8], pixels[9, 9] = np.nan, np.nan, np.nan
    found, _ = on_cells(Heights(pixels, (1e-6, 1e-6)), (16, 16), (2e-6, 2e-6))
    assert found[2, 2] == pytest.approx(1)
    assert np.argwhere(np.isnan(found)).tolist() == [[4, 4]]
    wider, _ = on_cells(Heights(pixels, (1e-6, 1e-6)), (18, 18), (2e-6, 2e-6))
    np.testing.assert_allclose(wider[1:-1, 1:-1], found)
    assert np.all(np.isnan(wider[0]))


@pytest.mark.parametrize(
    ("changes", "place", "words"),
    [
        ({"depth": "no.npy"}, ".depth", "no.npy"),
        ({"pitch": None}, ".depth", "pixels"),
        ({"pitch": "0.1 mm"}, ".depth", "62.5 × 62.5 µm"),
        ({"depth": "beside.npy"}, ".depth", "50 × 50 µm"),
        ({"depth": "missing.npy"}, ".depth", "missing"),
        ({"uncertainty": None}, ".uncertainty", "a length .m. is needed"),
        ({"length": "1 um"}, ".length", "1 µm is less than a cell, 62.5 µm"),
        ({"body": "ring"}, ".body", "ring"),
    ],
)
def test_a_wrong_map_is_refused_by_its_place(changes, place, words, tmp_path):
    worn = np.full((16, 16), 1e-6)
    beside = np.full((80, 80), np.nan)
    beside[0, 0] = 1e-6
    for name, depth in {"good": worn, "beside": beside, "missing": np.nan * worn}.items():
        np.save(tmp_path / f"{name}.npy", depth)
    entry = {"body": "ball", "depth": "good.npy", "pitch": "50 um", "uncertainty": "10 nm"}
    entry |= {"length": "0.2 mm", **changes}
    file = tmp_path / "lab.toml"
    file.write_text(to_toml({"map": [{k: v for k, v in entry.items() if v is not None}]}))
    with pytest.raises(CaseError, match=words) as caught:
        calibrate_map(CASE, read_measurements(file).map[0])
    assert str(caught.value).startswith(f"map.1{place}: ")


@pytest.mark.parametrize(
    ("scale", "k", "words"),
    [
        (-1.0, 9e-15, r"map\.1\.depth: it has .* which is positive where it is worn"),
        (4, 9e-15, r"map\.1\.depth: it has 4 times the"),
        (0.2, 9e-15, r"map\.1\.depth: it has 0\.2 times the"),
        (1.0, 9e-15, r"check the map's pitch, level and uncertainty, .*; no step"),
        (1.0, 0.0, r"map\.1\.body: 'disk' does not wear in this case"),
    ],
)
def test_a_map_that_is_not_of_the_case_is_refused(tmp_path, monkeypatch, scale, k, words):
    def failing(*given, **named):
        raise NumericalError("no step")

    monkeypatch.setattr(mapped, "fit_map", failing)
    pixels = np.repeat(worn(np.ones((1, 16))), 16, axis=0)
    np.save(tmp_path / "map.npy", scale * pixels)
    entry = {"body": "disk", "depth": str(tmp_path / "map.npy"), "pitch": 1e-3 / 16}
    entry = MapEntry(**entry, uncertainty=NOISE, length=1e-4)
    with pytest.raises(TriboError, match=words):
        calibrate_map(apply_settings(CASE, {"bodies.disk.wear.k": k}), entry)


def test_the_picture_of_a_line_shows_its_whole_interval():
    line, counts = np.linspace(-0.5, 0.5, 16)[None], (1, 1, 1.0, 1.0)
    found = FittedMap("disk", line, 0.3 + 0 * line, 0.4, (1e-5, 1e-5), line, line, line, *counts)
    low, high = coefficient_map(found, 0.95).axes[0].get_ylim()
    ends = found.interval(0.95)
    assert low < np.min(ends[0])
    assert high > np.max(ends[1])


def test_uniform_wear_tells_no_place():
    depth = np.full((32, 32), 1e-6)
    pixels = depth + NOISE * np.random.default_rng(0).standard_normal(depth.shape)
    assert find_shift(Heights(pixels, (1e-6, 1e-6)), depth, (1e-6, 1e-6)) == (0, 0)


ENTRY = {"body": "disk", "depth": "a", "uncertainty": 1e-9, "length": 1e-4}


@pytest.mark.parametrize(
    "tables", [{"map": [ENTRY], "fit": [{"path": "load.normal"}]}, {"map": [ENTRY, ENTRY]}]
)
def test_a_map_stands_in_a_file_of_its_own(tables):
    with pytest.raises(CaseError, match="local coefficients are fitted to one map"):
        read_measurements(tables)
