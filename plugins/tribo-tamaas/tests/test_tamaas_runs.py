"""Whole runs on tamaas: what composition says, and wear as on `dcfft`."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tribo import CaseError, ContactSystem, Grid, Simulation

import tribo_tamaas.solver
from tribo_tamaas import Tamaas

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")

needs_tamaas = pytest.mark.skipif(
    tribo_tamaas.solver.find_spec("tamaas") is None,
    reason="tamaas is not installed: it has wheels for Linux on x86-64 only",
)


def case(contact="tamaas.half_space", load=100, width="0.7 mm", duration="40 s", **changes):
    material = {"young": "207 GPa", "poisson": 0.3, "hardness": "4 GPa"}
    wear = {"type": "archard", "k": 3.11e-16}
    ball = {"surface": {"type": "sphere", "radius": "5 mm"}, "material": material, "wear": wear}
    disk = {"surface": {"type": "flat"}, "material": material, "wear": wear}
    return {
        "grid": {"size": [width, width], "cells": [48, 48]},
        "load": {"normal": load},
        "bodies": {"ball": ball, "disk": disk},
        "contact": {"type": contact},
        "kinematics": {
            "type": "reciprocating",
            "stroke": "2 mm",
            "frequency": "25 Hz",
            "duration": duration,
            "positions": "average",
            "swept": "disk",
        },
        "stepping": {"type": "explicit", "time_step": "2 s"},
        **changes,
    }


@needs_tamaas
@pytest.mark.slow
def test_explicit_wear_of_yielding_bodies_is_that_of_dcfft():
    # Without yield it is a row of `tribo verify`.
    theirs, ours = (
        Simulation(case(name, 1000, "1.4 mm", "20 s")).run().saves()[-1]
        for name in ("tamaas.half_space", "dcfft")
    )
    assert theirs["distance_m"] == pytest.approx(2.0)
    # Each solve is good to some 1e-6 of the pressure, and errors do not add up.
    assert theirs["max_pressure_Pa"] == pytest.approx(ours["max_pressure_Pa"], rel=1e-5)
    for body in ("ball", "disk"):
        assert theirs["bodies"][body] == pytest.approx(ours["bodies"][body], rel=1e-5, abs=1e-14)
        assert theirs["bodies"][body]["wear_volume_m3"] > 0
        assert theirs["bodies"][body]["max_plastic_depth_m"] > 0


def test_without_tamaas_the_error_says_what_to_do(monkeypatch):
    monkeypatch.setattr(tribo_tamaas.solver, "find_spec", lambda _: None)
    system = ContactSystem(Grid((1e-3, 1e-3), (8, 8)), 1e11, 100.0)
    with pytest.raises(CaseError, match=r"pip install tamaas .* x86-64 only.* 'dcfft'"):
        Tamaas().check(system)


def test_offering_the_solver_does_not_import_tamaas():
    code = "import sys, tribo_tamaas.plugin; sys.exit('tamaas' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@needs_tamaas
def test_readme_and_example_run(capsys):
    code = README.split("```python\n")[1].split("```")[0]
    exec(compile(code, "README.md", "exec"), {"__name__": "readme"})
    first, second = capsys.readouterr().out.splitlines()
    assert first.split()[1] == second.split()[1] == "2153.335"
    namespace = {"__name__": "compare"}
    exec(compile((ROOT / "examples/compare.py").read_text(), "compare.py", "exec"), namespace)
    solution, seconds = namespace["solve"]("tamaas.half_space", 100.0, 0.7e-3, 32)
    assert np.max(solution.pressure) > 2e9
    assert seconds > 0
