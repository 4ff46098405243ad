"""A result from anyone, its checksum made to fit, reads nothing else and writes nowhere else."""

import json
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from click.testing import CliRunner
from edited import edited
from made_results import written

from tribo import CaseError, Result
from tribo.cli.main import tribo as command_line

# Five saves, nine steps, 50 × 40 cells, two bodies.
FIELD = (5, 50, 40)
ON_BODIES = (5, 2, 50, 40)


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return written(tmp_path_factory.mktemp("sound") / "x.h5")


@pytest.fixture
def path(sound, tmp_path):
    return Path(shutil.copy(sound, tmp_path))


def attribute(name, value):
    return lambda file: file.attrs.__setitem__(name, value)


def text(name, data):
    return attribute(name, json.dumps(data))


def film(file):
    file["film"] = np.full(ON_BODIES, np.nan)
    attributes = {"kind": "effect", "field": "../up", "units": "1", "long_name": "Film"}
    file["film"].attrs.update({**attributes, "bodies": ["ball", "disk"]})


def pressure(make):
    def edit(file):
        del file["pressure"]
        make(file)

    return edit


def virtual(file):
    layout = h5py.VirtualLayout(FIELD, "f8")
    layout[...] = h5py.VirtualSource("other.h5", "p", FIELD)
    file.create_virtual_dataset("pressure", layout)


EDITS = {
    "a name that leaves the folder": text("case", {"bodies": {"../../up": {}, "disk": {}}}),
    "no name": text("case", {"bodies": {"": {}, "disk": {}}}),
    "a field that leaves the folder": film,
    "a link to another file": pressure(
        lambda file: file.__setitem__("pressure", h5py.ExternalLink("other.h5", "p"))
    ),
    "a virtual dataset": pressure(virtual),
    "values in a file of another program": pressure(
        lambda file: file.create_dataset("pressure", FIELD, "f8", external=[("x.h5", 0, 80000)])
    ),
    "a terabyte that was never written": lambda file: file.create_dataset(
        "more", (10**6, 10**5), "f8", chunks=(1, 1000)
    ),
    "a window of one length": attribute("window_m", [1e-3]),
    "findings that are numbers": text("findings", [1]),
    "a case that is no JSON": attribute("case", "{nope"),
    "a case that nests deeply": attribute("case", '{"bodies":' * 5000 + "1" + "}" * 5000),
    "a case with one body": text("case", {"bodies": {"ball": {}}}),
    "no status": lambda file: file.attrs.pop("status"),
}


@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS)
def test_what_tribo_does_not_write_is_refused_in_one_line(path, edit):
    with edited(path) as file:
        edit(file)
    with pytest.raises(CaseError, match=r"x\.h5 is damaged: .*\Z"):
        Result.open(path)


def test_a_case_that_was_only_added_to_is_shown(path):
    with edited(path) as file:
        text("case", {**json.loads(file.attrs["case"]), "later": 1})(file)
    assert CliRunner().invoke(command_line, ["show", str(path)]).exception is None
