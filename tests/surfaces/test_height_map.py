"""Heights from an array or a file."""

import numpy as np
import pytest
from paper_models import archard, motion, named, small, sphere, steel

from tribo import CaseError, Grid, HeightMap
from tribo.config.load import validate_case

SIZE = (2e-3, 1e-3)
HEIGHTS = np.add.outer(np.arange(8.0), 10 * np.arange(4.0)) * 1e-8


def test_finer_cells_and_a_smaller_window_lie_on_the_same_plane():
    grid = Grid((1e-3, 0.5e-3), (13, 7))
    x, y = grid.mesh
    plane = (x / 0.25e-3 + 3.5) * 1e-8 + (y / 0.25e-3 + 1.5) * 1e-7
    found = HeightMap(size=SIZE, heights=HEIGHTS).height(grid)
    np.testing.assert_allclose(found, plane, atol=1e-20)


@pytest.mark.parametrize("name", ["map.npy", "map.csv", "headed.csv"])
def test_files_give_the_same_as_python(name, tmp_path):
    path = tmp_path / name
    if path.suffix == ".npy":
        np.save(path, HEIGHTS)
    else:
        header = "a,b,c,d" if name.startswith("headed") else ""
        np.savetxt(path, HEIGHTS, delimiter=",", header=header, comments="")
    assert HeightMap(size=SIZE, heights=path) == HeightMap(size=SIZE, heights=HEIGHTS)


def test_a_map_smaller_than_the_window_and_the_path_is_refused_in_one_line():
    plate = HeightMap(size=(0.8e-3, 0.8e-3), heights=HEIGHTS)
    bodies = [named("ball", sphere(), steel(), archard()), named("disk", plate, steel())]
    with pytest.raises(CaseError) as caught:
        small(bodies=bodies, kinematics=motion(stroke=0.35e-3, positions="cells"))
    assert caught.value.path == "bodies.disk.surface"
    assert "0.8 × 0.8 mm of heights do not reach over 1.05 × 0.7 mm" in str(caught.value)


@pytest.mark.parametrize(
    ("heights", "words"),
    [
        ("missing.npy", "there is no file missing.npy"),
        ([[0.0, 1.0], [0.0]], r"at least 2 needed|not all of one length"),
        ([[0.0, float("nan")], [0.0, 0.0]], "finite"),
    ],
)
def test_what_is_no_map_is_told_with_its_place(heights, words):
    body = {"surface": {"type": "flat"}, "material": {"young": 2e11, "poisson": 0.3}}
    rough = body | {"surface": {"type": "array", "size": [1e-3, 1e-3], "heights": heights}}
    case = {
        "grid": {"size": 1e-3, "cells": 16},
        "load": {"normal": 1.0},
        "bodies": {"a": body, "b": rough},
        "kinematics": {"type": "reciprocating", "stroke": 2e-3, "frequency": 25, "cycles": 1},
    }
    with pytest.raises(CaseError, match=words) as caught:
        validate_case(case)
    assert "bodies.b.surface.heights" in str(caught.value)
