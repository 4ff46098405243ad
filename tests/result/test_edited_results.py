"""A result that was changed and sealed again is read with care: one line says what is wrong."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from edited import edited
from made_results import made

from tribo import CaseError
from tribo.cli.main import tribo
from tribo.result.seal import write_sealed
from tribo.result.store import read_text, write_text

COMMANDS = {
    "show": ("show", "x.h5"),
    "show as JSON": ("show", "x.h5", "--json"),
    "export": ("export", "x.h5"),
    "plot": ("plot", "x.h5"),
    "compare": ("compare", "x.h5", "sound.h5", "--no-plots"),
}
DEEP = '{"bodies":' * 5000 + "1" + "}" * 5000
BODIES = {"ball": {}, "disk": {}}


@pytest.fixture(scope="module")
def image():
    file = made()._file.file
    file.flush()
    return file.id.get_file_image()


@pytest.fixture
def folder(image, tmp_path, monkeypatch):
    for name in ("x.h5", "sound.h5"):
        write_sealed(tmp_path / name, image, identity=bytes(16), sync=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def text(name, content):
    def edit(file):
        del file[name], file[f"{name}_bytes"]
        write_text(file, name, content if isinstance(content, str) else json.dumps(content))

    return edit


def attribute(name, value):
    return lambda file: file.attrs.__setitem__(name, value)


def dataset(name, values):
    def edit(file):
        del file[name]
        file[name] = values

    return edit


def refusal(folder, edit, *command):
    with edited(folder / "x.h5") as file:
        edit(file)
    ended = CliRunner().invoke(tribo, command)
    assert isinstance(ended.exception, CaseError), repr(ended.exception)
    assert "\n" not in str(ended.exception)
    return str(ended.exception)


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
@pytest.mark.parametrize("case", [{}, {"bodies": {"ball": {}}}, [1]], ids=["none", "one", "list"])
def test_a_case_without_its_two_bodies(folder, command, case):
    assert "x.h5 is damaged: 'case' cannot be read" in refusal(folder, text("case", case), *command)


EDITS = {
    "a case that is no JSON": text("case", "{nope"),
    "a case that nests deeply": text("case", DEEP),
    "bodies that are not in the file": text("case", {"bodies": {"a": {}, "b": {}}}),
    "a contact that is text": text("case", {"bodies": BODIES, "contact": "x"}),
    "no provenance": text("provenance", {}),
    "notices that are no texts": attribute("notices", "[1]"),
    "an unknown status": attribute("status", "odd"),
    "a load that is text": attribute("load_N", "x"),
    "a negative load": attribute("load_N", -1.0),
    "a window of one number": attribute("window_m", [1.0]),
    "a modulus that is not a number": attribute("modulus_Pa", np.nan),
    "a cap of 0": attribute("cap_Pa", 0.0),
    "a curvature of one number": attribute("curvature_1_m", 1.0),
    "a format of two numbers": attribute("tribo_format", [1, 1]),
    "more times than saves": dataset("time", np.arange(9.0)),
    "times in a table": dataset("time", np.ones((5, 2))),
    "a short history": dataset("history/contact_solves", np.ones(2)),
    "a history that is not finite": dataset("history/contact_solves", np.full(9, np.nan)),
    "a short column": dataset("saves/bodies/ball/wear_volume", np.ones(1)),
    "a body that is no group": dataset("bodies/ball", np.ones(3)),
    "a state that is no group": lambda file: file.create_dataset("bodies/ball/state", data=1.0),
}
FIELDS = {
    "no cells": dataset("x", np.zeros(0)),
    "a pressure of another shape": dataset("pressure", np.ones((5, 3, 3))),
    "a pressure that is text": dataset("pressure", np.full((5, 50, 40), b"a")),
    "a pressure that is not finite": dataset("pressure", np.full((5, 50, 40), np.nan)),
    "a wear depth of another shape": dataset("bodies/disk/wear_depth", np.ones((5, 3))),
    "a wear depth beyond all measure": dataset(
        "bodies/ball/wear_depth", np.full((5, 50, 40), 1e300)
    ),
}


@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS)
def test_what_does_not_fit_is_told(folder, edit):
    assert "x.h5" in refusal(folder, edit, "show", "x.h5")


@pytest.mark.parametrize("edit", FIELDS.values(), ids=FIELDS)
def test_a_field_that_does_not_fit_is_told(folder, edit):
    assert "x.h5 is damaged: " in refusal(folder, edit, "export", "x.h5")


def test_a_case_that_was_only_added_to_is_shown(folder):
    with edited(folder / "x.h5") as file:
        case = json.loads(read_text(file, "case"))
        text("case", {**case, "bodies": BODIES, "later": 1})(file)
    assert CliRunner().invoke(tribo, ["show", "x.h5"]).exception is None
