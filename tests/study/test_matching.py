"""Bodies of results are matched whatever they are called, and that is said."""

import pytest
from made_results import written

from tribo import compare
from tribo.core.errors import CaseError
from tribo.plotting.overlays import save_overlays
from tribo.study.differences import differences

BODIES = {
    "ball and disk": {"names": ("ball", "disk")},
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


@pytest.mark.parametrize(
    ("other", "match", "pairs"),
    [
        ("plate and pin", {}, {"ball": "pin", "disk": "plate"}),
        ("ball and plate", {}, {"ball": "ball", "disk": "plate"}),
        ("two pins", {}, {"ball": "left", "disk": "right"}),
        ("two pins", {"ball": "right"}, {"ball": "right", "disk": "left"}),
    ],
)
def test_a_body_is_matched_as_told_else_by_name_else_by_role_else_in_order(
    files, other, match, pairs
):
    with compare(files("ball and disk", other), match=match) as comparison:
        assert [each["bodies"] for each in comparison.as_json()["results"]] == [
            {"ball": "ball", "disk": "disk"},
            pairs,
        ]


@pytest.mark.slow
def test_matched_bodies_are_compared_and_told(files, tmp_path):
    with compare(files("ball and disk", "plate and pin")) as comparison:
        one, other = comparison.results.values()
        found = differences(other, one, 200.0)
        assert {name: each.largest for name, each in found.items()} == {
            "pressure": 0.0,
            "bodies.ball.wear_depth": 0.0,
            "bodies.disk.wear_depth": 0.0,
        }
        assert other.body("disk").swept
        assert other.dataset["body"].values.tolist() == ["disk", "ball"]
        saves = [comparison.save(label, 200.0)["bodies"] for label in comparison.results]
        assert saves[0] == saves[1]
        (note,) = comparison.notes
        assert note.startswith("plate and pin: compares 'pin' with 'ball', 'plate' with 'disk'; ")
        (drawn,) = save_overlays(comparison.results, [200.0], tmp_path)
        assert drawn.name == "comparison_200s.png"


@pytest.mark.parametrize("match", [{"bal": "pin"}, {"ball": "pim"}, {"ball": "pin", "disk": "pin"}])
def test_a_match_of_no_body_is_refused(files, match):
    with pytest.raises(
        CaseError, match=r"first result \(ball, disk\) .* another \(plate, pin\)"
    ) as caught:
        compare(files("ball and disk", "plate and pin"), match=match)
    assert caught.value.path == "match"
