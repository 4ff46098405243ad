"""A file that cannot be a case is refused in one line."""

import tomllib

import pytest

from tribo.config import load
from tribo.config.load import load_case, read_toml, validate_case
from tribo.core.errors import CaseError


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"[grid]\nsize =\n", "is not TOML: Invalid value (at line 2, column 7)"),
        (
            b'[a]\nx = "5 mm\ny = 1',
            r"'\n' (at line 2, column 10); text and values with a unit are q",
        ),
        (
            b"x = 5 mm",
            "(at line 1, column 7); text and values with a unit are quoted, as in '5 mm'",
        ),
        (
            b"x = 0,5",
            "(at line 1, column 6); text and values with a unit are quoted, as in '5 mm'; deci",
        ),
        ("x = 1\ny = 'ä'".encode("latin-1"), "line 2: not UTF-8 text; save the file as UTF-8"),
        ("x = 1".encode("utf-16"), "not text in UTF-8"),
        (b"x = 1\x00", "not text in UTF-8"),
        (b"x = " + b"[" * 100_000, "nested too deeply"),
        (b"x = " + b"9" * 10_000, "is not TOML"),
    ],
)
def test_content_that_is_not_toml(tmp_path, content, message):
    path = tmp_path / "case.toml"
    path.write_bytes(content)
    with pytest.raises(CaseError) as caught:
        read_toml(path)
    assert message in str(caught.value)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_cannot_be_opened(tmp_path):
    with pytest.raises(CaseError, match="there is no such file"):
        read_toml(tmp_path / "case.toml")
    with pytest.raises(CaseError, match="is a directory"):
        read_toml(tmp_path)
    (tmp_path / "file").touch()
    with pytest.raises(CaseError, match="cannot be read: Not a directory"):
        read_toml(tmp_path / "file" / "case.toml")
    with pytest.raises(CaseError, match="cannot be read"):
        read_toml("case\0.toml")


def test_a_file_that_is_too_large(tmp_path, monkeypatch):
    monkeypatch.setattr(load, "_LARGEST", 10)
    path = tmp_path / "case.toml"
    path.write_text("x = 1 # " + "long" * 10)
    with pytest.raises(CaseError, match="larger than"):
        read_toml(path)


def test_the_mark_that_some_editors_add_is_no_fault(tmp_path):
    path = tmp_path / "case.toml"
    path.write_bytes("x = 1".encode("utf-8-sig"))
    assert read_toml(path) == {"x": 1}


CASE = """
grid = {size = "2 mm", cells = 64}
load.normal = "100 N"
contact.type = "dcfft"
[kinematics]
type = "reciprocating"
stroke = "2 mm"
frequency = "25 Hz"
duration = "1 h"
positions = "average"
[bodies.ball]
surface = {type = "sphere", radius = "5 mm"}
material = {young = "207 GPa", poisson = 0.3}
wear = {type = "archard", k = 3.11e-16}
[bodies.disk]
surface = "flat"
material = {young = "207 GPa", poisson = 0.3}
"""


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path


def test_a_case_is_read_from_a_file_with_changes(path):
    case = load_case(path, overrides=["load.normal=50 N", "bodies.ball.wear.k=1e-15"])
    assert case.load.normal == 50
    assert case.bodies["ball"].wear.k == 1e-15
    assert case.bodies["disk"].surface.type == "flat"


def test_a_case_survives_being_written_and_read(path):
    case = load_case(path)
    for options in ({}, {"exclude_defaults": True}, {"exclude_unset": True}, {"mode": "json"}):
        assert validate_case(case.model_dump(**options)) == case


def test_each_mistake_is_a_line(path):
    with pytest.raises(CaseError) as caught:
        load_case(path, overrides=["bodies.ball.material.young=-1", "contact.tolerence=1"])
    lines = str(caught.value).splitlines()
    assert caught.value.path == "contact.tolerence"
    assert lines[0].startswith("contact.tolerence: unknown key 'tolerence'; did you mean")
    assert lines[1:] == ["bodies.ball.material.young: -1 Pa: must be greater than 0"]


@pytest.mark.parametrize(
    ("grid", "message"),
    [
        ({"size": 1e-3, "cells": 0}, "grid.cells: 0: must be from 4 to 16384"),
        ({"size": 1e-3, "cells": 3}, "grid.cells: 3: must be from 4 to 16384"),
        ({"cells": 8}, "grid.size: missing; a length [m] is needed, as in '5 mm'"),
    ],
)
def test_a_grid_is_refused_in_one_line(grid, message):
    from tribo.templates import template

    with pytest.raises(CaseError) as caught:
        validate_case(tomllib.loads(template("ball_on_disk")) | {"grid": grid})
    assert str(caught.value) == message


def test_a_default_type_need_not_be_named():
    from tribo.templates import template

    data = tomllib.loads(template("ball_on_disk"))
    data["stepping"] = {"settle": 0.02}
    data["contact"] = {"tolerance": 1e-7}
    case = validate_case(data)
    assert (case.stepping.type, case.contact.type) == ("implicit", "dcfft")
