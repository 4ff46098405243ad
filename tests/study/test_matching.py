"""Bodies of results are matched whatever they are called, and that is said."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from made_results import made

from tribo import compare
from tribo.cli.main import tribo
from tribo.core.errors import CaseError
from tribo.result.seal import write_sealed
from tribo.study.differences import differences

BODIES = {
    "ball and disk": {"names": ("ball", "disk")},
    "pin and plate": {"names": ("pin", "plate")},
    "plate and pin": {"names": ("plate", "pin"), "swept": (True, False)},
    "ball and plate": {"names": ("ball", "plate")},
    "two pins": {"names": ("left", "right"), "swept": (False, False)},
    "one body": {"names": ("pin",), "swept": (False,), "worn": (True,), "densities": (None,)},
    "three bodies": {
        "names": ("pin", "x", "y"),
        "swept": (False, True, True),
        "worn": (True, True, True),
        "densities": (None, None, None),
    },
}


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    for name, bodies in BODIES.items():
        image = made(times=(0.0, 200.0), **bodies)._file.file.id.get_file_image()
        write_sealed(folder / f"{name}.h5", image, identity=bytes(16), sync=False)
    return lambda *names: [folder / f"{name}.h5" for name in names]


def own(comparison):
    return comparison.as_json()["results"][1]["bodies"]


@pytest.mark.parametrize(
    ("other", "pairs"),
    [
        ("pin and plate", {"ball": "pin", "disk": "plate"}),
        ("plate and pin", {"ball": "pin", "disk": "plate"}),
        ("ball and plate", {"ball": "ball", "disk": "plate"}),
        ("two pins", {"ball": "left", "disk": "right"}),
    ],
)
def test_a_body_is_matched_by_name_else_by_role_else_in_order(files, other, pairs):
    with compare(files("ball and disk", other)) as comparison:
        assert own(comparison) == pairs


def test_a_user_says_which_body_is_which(files):
    paths = files("ball and disk", "pin and plate")
    with compare(paths, match={"ball": "plate"}) as comparison:
        assert own(comparison) == {"ball": "plate", "disk": "pin"}
        reference, result = comparison.results.values()
        assert np.array_equal(result.wear_depth("ball", -1), reference.wear_depth("disk", -1))


def test_matched_bodies_are_compared(files):
    with compare(files("ball and disk", "plate and pin")) as comparison:
        found = differences(*reversed(comparison.results.values()), 200.0)
        assert {each.field: each.largest for each in found} == {
            "pressure": 0.0,
            "bodies.ball.wear_depth": 0.0,
            "bodies.disk.wear_depth": 0.0,
        }
        saves = [comparison.save(label, 200.0)["bodies"] for label in comparison.results]
        assert saves[0] == saves[1]


def test_what_was_matched_is_told(files):
    with compare(files("ball and disk", "pin and plate")) as comparison:
        (note,) = comparison.notes
        assert note.startswith("pin and plate: compares 'pin' with 'ball', 'plate' with 'disk'; ")
        assert "--match NAME=NAME" in note


@pytest.mark.parametrize("other", ["one body", "three bodies"])
def test_a_file_that_has_not_two_bodies_is_refused(files, other):
    with pytest.raises(CaseError, match=r"is damaged: .* two are needed"):
        compare(files("ball and disk", other))


@pytest.mark.parametrize(
    ("match", "message"),
    [
        ({"bal": "pin"}, "match: the first result has no body 'bal'; its bodies are ball, disk"),
        ({"ball": "pim"}, "match: no other result has a body 'pim'; theirs are pin, plate"),
        ({"ball": "pin", "disk": "pin"}, "match: 'pin' cannot be two bodies of the first result"),
    ],
)
def test_a_match_of_no_body_is_refused(files, match, message):
    with pytest.raises(CaseError) as caught:
        compare(files("ball and disk", "pin and plate"), match=match)
    assert str(caught.value) == message


def invoke(*args):
    return CliRunner().invoke(tribo, ["compare", *map(str, args)], catch_exceptions=False)


PAIRS = [name for name, bodies in BODIES.items() if len(bodies["names"]) == 2]


@pytest.mark.parametrize("first", PAIRS)
def test_no_files_end_in_a_traceback(files, first):
    every = files(first, *(set(PAIRS) - {first}))
    assert invoke(*every, "--no-plots").exit_code == 0
    assert json.loads(invoke(*every, "--json", "--no-plots").stdout)["saves"]


def test_pictures_of_matched_bodies_are_drawn(files, tmp_path):
    invoke(*files("ball and disk", "plate and pin"), "--at", "200 s", "-o", tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {
        "pressure_200s.png",
        "ball_200s.png",
        "disk_200s.png",
    }


def test_the_command_takes_a_match(files):
    done = invoke(
        *files("ball and disk", "pin and plate"), "--no-plots", "--match", "ball=plate", "--json"
    )
    assert json.loads(done.stdout)["results"][1]["bodies"] == {"ball": "plate", "disk": "pin"}
    with pytest.raises(CaseError, match="--match: 'ball' is not of the form NAME=NAME"):
        invoke(*files("ball and disk", "two pins"), "--match", "ball")
