"""Maps and profiles that lie off the middle, or that are not of the case."""

import numpy as np
import pytest
from calibrations import cheap
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import NumericalError, TriboError
from tribo.lab.heights import Heights
from tribo.simulation.run import Simulation

from tribo_inverse.calibration import mapped
from tribo_inverse.calibration.mapped import calibrate_maps
from tribo_inverse.calibration.measured import MapEntry
from tribo_inverse.calibration.scar_shift import find_shift

K, TRUE = "bodies.ball.wear.k", 3e-16
CASE = apply_settings(cheap(60), {"grid.cells": 32, K: TRUE, "bodies.disk.wear.k": TRUE})
PIXELS, PITCH, NOISE = 128, 1e-3 / 128, 20e-9


@pytest.fixture(scope="module")
def worn():
    """The ball's depth on four pixels a cell's edge, in m."""
    fine = apply_settings(CASE, {"grid.cells": PIXELS, "stepping.depth_tolerance": 1e-2})
    with Simulation(validate_case(fine)).run() as result:
        return result.body("ball").wear_depth[-1].copy()


def test_uniform_wear_tells_no_place():
    depth = np.full((32, 32), 1e-6)
    pixels = depth + NOISE * np.random.default_rng(0).standard_normal(depth.shape)
    assert find_shift(Heights(pixels, (1e-6, 1e-6)), depth, (1e-6, 1e-6)) == (0, 0)


def failing(*given, **named):
    raise NumericalError("no step")


@pytest.mark.parametrize(
    ("scale", "k", "words"),
    [
        (-1.0, TRUE, r"map\.1\.depth: the depths are negative"),
        (4, TRUE, r"map\.1\.depth: it has 3\.99 times the"),
        (0.2, TRUE, r"map\.1\.depth: it has 0\.2 times the"),
        (1.0, TRUE, r"check the maps' pitch, level and uncertainty, .*; no step"),
        (1.0, 0.0, r"map\.1\.body: 'ball' does not wear in this case"),
    ],
)
def test_a_map_that_is_not_of_the_case_is_refused(worn, tmp_path, monkeypatch, scale, k, words):
    monkeypatch.setattr(mapped, "fit_maps", failing)
    np.save(tmp_path / "map.npy", scale * worn)
    entry = {"body": "ball", "depth": str(tmp_path / "map.npy"), "pitch": PITCH}
    entry = MapEntry(**entry, uncertainty=NOISE, length=1e-4)
    with pytest.raises(TriboError, match=words):
        calibrate_maps(apply_settings(CASE, {K: k}), {"map.1": entry})
