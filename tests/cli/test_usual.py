"""A value whose unit was forgotten is named where a run fails, and in a check."""

import pytest
from command_line import tribo

from tribo.config.load import validate_case
from tribo.core.units import parse, stated
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


def body_of(young, hardness=None):
    material = {"young": young, "poisson": 0.3, **({"hardness": hardness} if hardness else {})}
    return {"surface": "flat", "material": material}


CASE = {
    "grid": {"size": "1 mm", "cells": 32},
    "load": {"normal": 1},
    "bodies": {"ball": body_of("207 GPa"), "disk": body_of("207 GPa")},
    "contact": "dcfft",
    "kinematics": {"type": "rotating", "speed": 1, "track_radius": 1, "distance": 1},
}


@pytest.mark.parametrize(
    ("young", "hardness", "friction", "places"),
    [
        ("210 MPa", "7 GPa", 0.6, ["bodies.ball.material.hardness"]),
        ("210 GPa", "7 GPa", 60, ["friction.coefficient"]),
        # Diamond, and a rubber on glass.
        ("1140 GPa", "100 GPa", 2.0, []),
    ],
)
def test_a_hardness_beyond_young_and_a_friction_beyond_any_are_asked_about(
    young, hardness, friction, places
):
    case = {**CASE, "friction": {"coefficient": friction}}
    case["bodies"] = {"ball": body_of(young, hardness), "disk": body_of("210 GPa")}
    assert [
        asked.split(" is ")[0].split(",")[0] for asked in unusual(validate_case(case))
    ] == places


@pytest.mark.parametrize(
    ("value", "unit", "said"),
    [
        (2e12, "Pa", "2 TPa"),
        (1e-9, "m", "1 nm"),
        (1e-12, "m/s", "1 pm/s"),
        (3e4, "kg/m^3", "30000 "),
    ],
)
def test_a_range_is_told_in_units_that_a_case_takes(value, unit, said):
    text = stated(value, unit)
    assert text.startswith(said)
    assert parse(text, unit) == pytest.approx(value, rel=1e-9, abs=0)


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
    (doubt,) = unusual(validate_case({**CASE, "effects": [{**effect, **forgotten}]}))
    assert doubt.startswith(f"effects.0.{asked}, usual are ")
