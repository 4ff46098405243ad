"""A value whose unit was forgotten is named where a run fails, and in a check."""

import pytest
from command_line import tribo

from tribo.config.load import validate_case
from tribo.simulation.validity import unusual

FORGOTTEN = {
    "bodies.ball.surface.radius=5": "bodies.ball.surface.radius is 5 m",
    "bodies.ball.material.young=210": "bodies.ball.material.young is 210 Pa",
    "grid.size=2": "grid.size is 2 m",
    "load.normal=1e8": "load.normal is 100 MN",
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
    *warnings, error = failed.stderr.partition("error: ")[::2]
    assert error.count("usual are") == 1
    assert error.startswith(f"{FORGOTTEN[setting]}, usual are ")
    assert [FORGOTTEN[setting] in warning for warning in warnings] == [command == "run"]


def body_of(young):
    return {"surface": "flat", "material": {"young": young, "poisson": 0.3}}


CASE = {
    "grid": {"size": "1 mm", "cells": 32},
    "load": {"normal": 1},
    "bodies": {"ball": body_of("207 GPa"), "disk": body_of("207 GPa")},
    "contact": "dcfft",
    "kinematics": {"type": "rotating", "speed": 1, "track_radius": 1, "distance": 1},
}


@pytest.mark.parametrize(
    ("changes", "friction", "places"),
    [
        ({"young": "210 GPa", "hardness": 7}, 0.6, ["bodies.ball.material.hardness"]),
        ({"young": 210, "hardness": "7 GPa"}, 0.6, ["bodies.ball.material.young"]),
        ({"hardness": "7 GPa"}, 60, ["friction.coefficient"]),
        # Diamond, indium, and a rubber on glass.
        ({"young": "1140 GPa", "hardness": "100 GPa"}, 0.1, []),
        ({"young": "11 GPa", "hardness": "8.8 MPa"}, 0.6, []),
        ({"young": "2 MPa", "poisson": 0.499}, 2.0, []),
    ],
)
def test_a_material_and_a_friction_unlike_any_are_asked_about(changes, friction, places):
    case = {**CASE, "friction": {"coefficient": friction}}
    ball = body_of("210 GPa")
    ball["material"] |= changes
    case["bodies"] = {"ball": ball, "disk": body_of("210 GPa")}
    assert [asked.place for asked in unusual(validate_case(case))] == places


def test_packages_ask_too():
    debris = {"type": "thirdbody.debris", "ejection_length": "0.5 m", "cover": 1}
    (doubt,) = unusual(validate_case({**CASE, "effects": [debris]}))
    assert doubt.words.startswith("effects.1.cover is 1 m, usual are ")
