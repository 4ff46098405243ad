"""Wear in particles in runs of the whole program."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from tribo import CaseError, Simulation

ROOT = Path(__file__).parents[1]
EXAMPLE = runpy.run_path(str(ROOT / "examples/settled_roughness.py"))
case, DIAMETER, THICKNESS = EXAMPLE["case"], EXAMPLE["DIAMETER"], EXAMPLE["THICKNESS"]
INTEGRATED = 1e-4
"""What is remembered is integrated within a step to 3e-5."""


def quick(*given, **sizes):
    """Return a case at the default tolerance, for what does not depend on it."""
    data = case(*given, **sizes)
    del data["stepping"]["depth_tolerance"]
    return data


@pytest.mark.slow
def test_a_patch_settles_at_a_roughness_of_its_own():
    settled, sizes = [], {"cells": 8, "particles": 2, "layers": 2}
    for beginning in (40e-9, 2e-9):
        with Simulation(quick(beginning, **sizes)).run() as result:
            patch = result.body("patch")
            surfaces = [patch.surface(save) for save in range(2, len(result.times))]
            sa = [np.mean(np.abs(z - z.mean())) for z in surfaces]
            depth = patch.wear_depth[-1]
        settled.append(np.mean(sa))
        # Archard's wear on the mean: 4 particles in 2 layers, ±0.5/√8.
        assert depth.mean() == pytest.approx(2 * THICKNESS, rel=0.3, abs=0)
        assert np.std(depth) < THICKNESS
    assert settled[0] == pytest.approx(settled[1], rel=0.25, abs=0)
    assert min(settled) > 5e-9
    # The same patch under Archard's law alone is polished away.
    archard = EXAMPLE["roughnesses"](quick(40e-9, EXAMPLE["ARCHARD"], **sizes))
    assert archard[-1] < 0.05 * min(settled)


@pytest.mark.slow
def test_two_bodies_that_slide_over_each_other_each_know_their_own_depth(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "examples")
    rough_on_rough = runpy.run_path(str(ROOT / "examples/rough_on_rough.py"))["rough_on_rough"]
    data = rough_on_rough(20e-9, True, cells=8, particles=2, positions=3, layers=1)
    data["kinematics"]["duration"] *= 0.3
    data["output"] = {}
    with Simulation(data).run() as result:
        for body in map(result.body, result.body_names):
            np.testing.assert_allclose(body.state["worn"], body.wear_depth[:], rtol=INTEGRATED)
            # Four particles in a third of a layer: ±0.5/√1.3.
            assert body.wear_depth[-1].mean() == pytest.approx(0.3 * THICKNESS, rel=0.5, abs=0)


@pytest.mark.parametrize(
    ("body", "changes", "words"),
    [
        ("patch", {"diameter": 4e-6}, r"patch\.wear: particles of 4 µm are 2 cells of 2 µm, and 4"),
        ("patch", {"period": 3.5 * DIAMETER}, "period must be a whole number of diameters"),
        ("plate", {}, r"bodies\.plate\.wear: 'roughening\.detachment' wears pl"),
    ],
)
def test_particles_that_have_no_places_or_cells_are_refused(body, changes, words):
    data = case(20e-9)
    data["bodies"][body]["wear"] = data["bodies"]["patch"]["wear"] | changes
    with pytest.raises(CaseError, match=words):
        Simulation(data)
