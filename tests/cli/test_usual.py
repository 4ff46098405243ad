"""A value whose unit was forgotten is named where a run fails, and in a check."""

import pytest
from command_line import tribo

from tribo.config.load import validate_case
from tribo.simulation.doubt import unusual

FORGOTTEN = {
    "bodies.ball.surface.radius=5": "bodies.ball.surface.radius is 5 m",
    "bodies.ball.material.young=210": "bodies.ball.material.young is 210 Pa",
    "grid.size=2": "grid.size is 2 m",
    "load.normal=1e8": "load.normal is 1e+08 N",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("usual")
    assert tribo("new", "ball_on_disk", "my.toml", cwd=folder).returncode == 0
    return folder


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("setting", list(FORGOTTEN))
def test_a_failure_names_the_quantity_out_of_its_usual_range(folder, command, setting):
    options = ["--set", setting, "--set", "grid.cells=32", *(["--force"] * (command == "run"))]
    failed = tribo(command, "my.toml", *options, cwd=folder)
    assert failed.returncode == 2
    assert failed.stderr.count("a unit forgotten") == 1
    assert failed.stderr.startswith(f"error: {FORGOTTEN[setting]}, usual are ")


def test_a_check_that_finds_nothing_else_still_asks(folder):
    coarse = ["--set", "grid.cells=64", "--set", "bodies.ball.material.density=7.85"]
    asked = tribo("check", "my.toml", *coarse, cwd=folder)
    assert asked.returncode == 0
    verdict, first, *_ = asked.stdout.splitlines()
    assert verdict.endswith("is valid, but:")
    assert first.startswith("  - bodies.ball.material.density is 7.85 kg/m^3, usual are")


@pytest.mark.parametrize("k", ["0", "'1e-6 mm^3/(N m)'"])
def test_what_is_usual_is_not_asked_about(folder, k):
    settings = ["--set", f"bodies.ball.wear.k={k}", "--set", "grid.cells=64"]
    assert "usual are" not in tribo("check", "my.toml", *settings, cwd=folder).stdout


FLASH = {"type": "thermal.flash", "ambient": "23 degC"}
FILM = {
    "type": "film.mixed",
    "viscosity": "100 mPa s",
    "pressure_viscosity": "20 1/GPa",
    "radius": "5 mm",
    "roughness": "0.2 um",
}
PATH = {"length": "5 mm", "area": "28 mm^2"}


@pytest.mark.parametrize(
    ("effect", "forgotten", "asked"),
    [
        (FILM, {"viscosity": 100}, "viscosity is 100 Pa s"),
        (FILM, {"pressure_viscosity": 20}, "pressure_viscosity is 20 1/Pa"),
        (FILM, {"radius": 5}, "radius is 5 m"),
        (FILM, {"roughness": 0.2}, "roughness is 0.2 m"),
        (FLASH, {"ambient": 23}, "ambient is 23 K"),
        (FLASH, {"heat_paths": {"ball": {**PATH, "length": 5}}}, "heat_paths.ball.length is 5 m"),
        (FLASH, {"heat_paths": {"ball": {**PATH, "area": 28}}}, "heat_paths.ball.area is 28 m^2"),
        ({"type": "thirdbody.debris", "ejection_length": "0.5 m"}, {"cover": 1}, "cover is 1 m"),
    ],
)
def test_packages_ask_too(effect, forgotten, asked):
    body = {"surface": "flat", "material": {"young": "207 GPa", "poisson": 0.3}}
    case = {
        "grid": {"size": "1 mm", "cells": 32},
        "load": {"normal": 1},
        "bodies": {"ball": body, "disk": body},
        "contact": "dcfft",
        "kinematics": {"type": "rotating", "speed": 1, "track_radius": 1, "distance": 1},
    }
    (doubt,) = unusual(validate_case({**case, "effects": [{**effect, **forgotten}]}))
    assert doubt.startswith(f"effects[0].{asked}, usual are ")
