"""A file that cannot be a case is refused in one line."""

import tomllib

import pytest

from tribo.config.load import load_case, read_toml, validate_case
from tribo.core.errors import CaseError
from tribo.templates import template


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"[grid]\nsize =\n", "is not TOML: Invalid value (at line 2, column 7)"),
        (b"x = 5 mm", "(at line 1, column 7); quote texts and values with a unit"),
        ("x = 1\ny = 'ä'".encode("latin-1"), "line 2: not UTF-8 text; save the file as UTF-8"),
        ("x = 1".encode("utf-16"), "not UTF-8 text"),
        (b"x = " + b"[" * 100_000, "is not TOML"),
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


def test_a_case_is_read_from_its_tables_too(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(template("ball_on_disk"))
    assert load_case(tomllib.loads(path.read_text())) == load_case(path)
    with pytest.raises(CaseError, match="3 is not the name"):
        load_case(3)


def test_a_file_that_cannot_be_opened(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(CaseError, match="cannot be read: Not a directory"):
        read_toml(tmp_path / "file" / "case.toml")
    with pytest.raises(CaseError, match="cannot be read"):
        read_toml("case\0.toml")


def test_the_mark_that_some_editors_add_is_no_fault(tmp_path):
    path = tmp_path / "case.toml"
    path.write_bytes("x = 1".encode("utf-8-sig"))
    assert read_toml(path) == {"x": 1}


@pytest.mark.parametrize(
    ("grid", "message"),
    [
        ({"size": 1e-3, "cells": 0}, "grid.cells: 0: must be greater than or equal to 1"),
        (
            {"size": {}, "cells": 8},
            "grid.size: a table is not a quantity; a length [m] is needed, as in '5 mm'",
        ),
        (
            {"size": 1e-3, "cells": [4, 32769]},
            "grid.cells.2: 32769: must be less than or equal to 32768",
        ),
        ({"cells": 8}, "grid.size: missing; a length [m] is needed, as in '5 mm'"),
    ],
)
def test_a_grid_is_refused_in_one_line(grid, message):
    with pytest.raises(CaseError) as caught:
        validate_case(tomllib.loads(template("ball_on_disk")) | {"grid": grid})
    assert str(caught.value) == message


def test_a_default_type_need_not_be_named():
    data = tomllib.loads(template("ball_on_disk"))
    data["stepping"] = {"settle": 0.02}
    data["contact"] = {"tolerance": 1e-7}
    case = validate_case(data)
    assert (case.stepping.type, case.contact.type) == ("implicit", "dcfft")


def test_a_key_of_the_case_that_stands_in_a_table_is_sent_above_it():
    case = tomllib.loads(template("ball_on_disk"))
    with pytest.raises(CaseError, match=r"output\.begin: .*above the first table"):
        validate_case({**case, "output": {"begin": "former.h5"}})
