"""A result that was changed, its checksum too, is read with care: one line says what is wrong."""

import json
import shutil

import h5py
import numpy as np
import pytest
from click.testing import CliRunner
from edited import edited
from made_results import written

from tribo import CaseError
from tribo.cli.main import tribo as command_line

# Five saves, nine steps, 50 × 40 cells, two bodies.
FIELD = (5, 50, 40)
ON_BODIES = (5, 2, 50, 40)


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return written(tmp_path_factory.mktemp("sound") / "x.h5")


@pytest.fixture
def folder(sound, tmp_path, monkeypatch):
    shutil.copy(sound, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refusal(folder, edit):
    with edited(folder / "x.h5") as file:
        edit(file)
    ended = CliRunner().invoke(command_line, ["show", "x.h5", "--json"])
    assert isinstance(ended.exception, CaseError), repr(ended.exception)
    assert "\n" not in str(ended.exception)
    assert "Infinity" not in ended.stdout
    return str(ended.exception)


def attribute(name, value):
    return lambda file: file.attrs.__setitem__(name, value)


def text(name, data):
    return attribute(name, json.dumps(data))


def dataset(name, values):
    def edit(file):
        attributes = dict(file[name].attrs) if name in file else {}
        file.pop(name, None)
        file[name] = values
        for key in attributes.keys() & {"kind", "field", "units", "long_name", "bodies"}:
            file[name].attrs[key] = attributes[key]

    return edit


def field(values, **changes):
    """A field that an effect provides."""

    def edit(file):
        file["film"] = values
        attributes = {"kind": "effect", "field": "film", "units": "1", "long_name": "Film"}
        file["film"].attrs.update({**attributes, "bodies": ["ball", "disk"], **changes})

    return edit


def renamed(name):
    def edit(file):
        case = json.loads(file.attrs["case"])
        case["bodies"] = {name: case["bodies"]["ball"], "disk": case["bodies"]["disk"]}
        text("case", case)(file)
        dataset("body", [name.encode(), b"disk"])(file)

    return edit


def put(name, value, place=-1):
    return lambda file: file[name].__setitem__(place, value)


def elsewhere(make):
    """Put something of the shape of the pressure in its place."""

    def edit(file):
        file.pop("pressure")
        make(file)

    return edit


def virtual(file):
    layout = h5py.VirtualLayout(FIELD, "f8")
    layout[...] = h5py.VirtualSource("other.h5", "p", FIELD)
    file.create_virtual_dataset("pressure", layout)


EDITS = {
    "a name that leaves the folder": renamed("../../up"),
    "no name": renamed(""),
    "a field that leaves the folder": lambda file: field(np.ones(ON_BODIES), field="../up")(file),
    "a link to another file": elsewhere(
        lambda file: file.__setitem__("pressure", h5py.ExternalLink("other.h5", "p"))
    ),
    "a link within the file": elsewhere(
        lambda file: file.__setitem__("pressure", h5py.SoftLink("/height"))
    ),
    "a virtual dataset": elsewhere(virtual),
    "values in a file of another program": elsewhere(
        lambda file: file.create_dataset("pressure", FIELD, "f8", external=[("x.h5", 0, 80000)])
    ),
    "another compression": elsewhere(
        lambda file: file.create_dataset("pressure", FIELD, "f8", compression="lzf")
    ),
    "a terabyte that was never written": lambda file: file.create_dataset(
        "more", (10**6, 10**5), "f8", chunks=(1, 1000)
    ),
    "times that go back": put("time", 1.0),
    "a load of nan": attribute("load_N", np.nan),
    "a window of one length": attribute("window_m", [1e-3]),
    "a curvature of inf": attribute("curvature_1_m", [np.inf, 1.0]),
    "a time spent that is text": attribute("wall_time_s", "long"),
    "findings that are numbers": text("findings", [1]),
    "a finding without words": text("findings", [{"kind": "lap"}]),
    "layers that are numbers": text("case", {"bodies": {"ball": {"layers": [1]}, "disk": {}}}),
    "a motion that is text": text("case", {"bodies": {"ball": {}, "disk": {}}, "kinematics": "x"}),
    "a density of inf": put("density", np.inf),
    "a pressure of nan": put("pressure", np.nan, 0),
    "a pressure below 0": put("pressure", -1.0, 0),
    "no save": lambda file: [
        values.resize(0, axis=0)
        for values in file.values()
        if values.maxshape[0] == 2**31 - 1 and len(values) == 5
    ],
    "a case that is no JSON": attribute("case", "{nope"),
    "a case that nests deeply": attribute("case", '{"bodies":' * 5000 + "1" + "}" * 5000),
    "bodies that are not in the file": text("case", {"bodies": {"a": {}, "b": {}}}),
    "a case with one body": text("case", {"bodies": {"ball": {}}}),
    "bodies in a list": text("case", {"bodies": [1, 2]}),
    "a case without bodies": text("case", {}),
    "provenance that is a list": text("provenance", []),
    "a layer of no body": text("findings", [{"kind": "layer", "words": "", "place": "ball"}]),
    "a layer that wore through at no time": text(
        "findings", [{"kind": "layer", "words": "", "place": "bodies.ball.layers.0"}]
    ),
    "no status": lambda file: file.attrs.pop("status"),
    "no cells": dataset("x", np.zeros(0)),
    "other bodies": dataset("body", [b"ball", b"block"]),
    "bodies that are a group": lambda file: (file.pop("body"), file.create_group("body")),
    "more times than saves": dataset("time", np.arange(9.0)),
    "no history": lambda file: file.pop("history_time"),
    "a pressure of another shape": dataset("pressure", np.ones((5, 3, 3))),
    "a pressure that is text": dataset("pressure", np.full(FIELD, b"a")),
    "a track without its positions": dataset("track_depth", np.ones(ON_BODIES)),
    "an effect without a meaning": lambda file: file["pressure"].attrs.update({"kind": "effect"}),
}


EDITS |= {
    f"{name} of {value}": put(name, value)
    for name, value in (("max_pressure", np.nan), ("history_wear_volume", np.inf))
} | {f"{name} below 0": put(name, -1.0) for name in ("friction_energy", "history_friction_force")}


@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS)
def test_what_does_not_fit_is_told(folder, edit):
    assert "x.h5 is damaged: " in refusal(folder, edit)


def test_work_of_friction_without_its_force_is_shown(folder):
    with edited(folder / "x.h5") as file:
        file["friction_energy"][-1] = 1.0
    shown = CliRunner().invoke(command_line, ["show", "x.h5"])
    assert shown.exception is None, repr(shown.exception)
    assert "Friction:" not in shown.stdout


def test_a_case_that_was_only_added_to_and_an_effect_that_failed_are_shown(folder):
    with edited(folder / "x.h5") as file:
        text("case", {**json.loads(file.attrs["case"]), "later": 1})(file)
        field(np.full(ON_BODIES, np.nan))(file)
    shown = CliRunner().invoke(command_line, ["show", "x.h5", "--json"])
    assert shown.exception is None
    save = json.loads(shown.stdout)["saves"][0]
    assert save["bodies"]["ball"]["effects"] == {"film": {"min": None, "max": None}}
