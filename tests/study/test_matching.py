"""Bodies of results are matched whatever they are called, and that is said."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from made_results import written

from tribo import compare
from tribo.cli.main import tribo
from tribo.core.errors import CaseError
from tribo.study.differences import differences

BODIES = {
    "ball and disk": {"names": ("ball", "disk")},
    "pin and plate": {"names": ("pin", "plate")},
    "plate and pin": {"names": ("plate", "pin"), "swept": (True, False)},
    "ball and plate": {"names": ("ball", "plate")},
    "two pins": {"names": ("left", "right"), "swept": (False, False)},
}


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    for name, bodies in BODIES.items():
        written(folder / f"{name}.h5", times=(0.0, 200.0), **bodies)
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
        assert np.array_equal(
            result.field("wear_depth", -1, "ball"), reference.field("wear_depth", -1, "disk")
        )


def test_matched_bodies_are_compared_and_told(files):
    with compare(files("ball and disk", "plate and pin")) as comparison:
        found = differences(*reversed(comparison.results.values()), 200.0)
        assert {each.field: each.largest for each in found} == {
            "pressure": 0.0,
            "bodies.ball.wear_depth": 0.0,
            "bodies.disk.wear_depth": 0.0,
        }
        saves = [comparison.save(label, 200.0)["bodies"] for label in comparison.results]
        assert saves[0] == saves[1]
        (note,) = comparison.notes
        assert note.startswith("plate and pin: compares 'pin' with 'ball', 'plate' with 'disk'; ")


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


@pytest.mark.parametrize("first", BODIES)
@pytest.mark.slow
def test_any_files_are_compared_by_the_command(files, first):
    every = files(first, *(BODIES.keys() - {first}))
    assert invoke(*every, "--no-plots").exit_code == 0
    assert json.loads(invoke(*every, "--json", "--no-plots").stdout)["saves"]


@pytest.mark.slow
def test_pictures_of_matched_bodies_are_drawn(files, tmp_path):
    pair = files("ball and disk", "plate and pin")
    invoke(*pair, "--at", "200 s", "-o", tmp_path, "--match", "ball=pin")
    drawn = {path.name for path in tmp_path.iterdir()}
    assert drawn == {"pressure_200s.png", "ball_200s.png", "disk_200s.png"}
