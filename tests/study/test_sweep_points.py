"""A study says which points are run; what is wrong with it is said before anything runs."""

import pytest
import sweeps

from tribo.core.errors import CaseError
from tribo.study.sweeping.study_file import load_study, points
from tribo.study.sweeping.sweep import plan


def made(tmp_path, text):
    study, _ = load_study(sweeps.study(tmp_path, sweeps.QUICK + text))
    return points(study)


def test_grid_zip_and_list_multiply(tmp_path):
    text = """
    [grid]
    load.normal = [50, 60]
    [zip]
    "bodies.ball.wear.k" = [1e-16, 2e-16]
    "bodies.disk.wear.k" = [3e-16, 4e-16]
    [[list]]
    kinematics.frequency = "25 Hz"
    [[list]]
    kinematics.stroke = "1 mm"
    """
    found = made(tmp_path, text)
    assert len(found) == 8
    ball, disk = "bodies.ball.wear.k", "bodies.disk.wear.k"
    assert found[0] == {
        "kinematics.frequency": "25 Hz",
        ball: 1e-16,
        disk: 3e-16,
        "load.normal": 50,
    }
    assert {(point[ball], point[disk]) for point in found} == {(1e-16, 3e-16), (2e-16, 4e-16)}
    assert [point["load.normal"] for point in found] == [50, 60] * 4


GRID = "[grid]\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", 'grid = { "load.normal" = ['),
        (GRID + "load.normal = []", 'grid."load.normal": at least 1 needed'),
        ("[gird]\nload.normal = [1]", "did you mean 'grid'?"),
        (GRID + "loda.normal = [1]", "did you mean 'load'?"),
        (GRID + "load.normal=[1]\n'load.normal'=[2]", "grid: 'load.normal' is given twice"),
        (GRID + "load.normal = [1]\n[zip]\nload.normal = [2]", "load.normal: varies twice"),
        ("[zip]\nload.normal = [1, 2]\nkinematics.stroke = [1e-3]", "zip: values that go together"),
    ],
)
def test_what_is_wrong_is_said_before_anything_runs(tmp_path, text, message):
    with pytest.raises(CaseError) as caught:
        plan(sweeps.study(tmp_path, sweeps.QUICK + text), tmp_path / "out")
    assert message in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_a_case_in_the_place_of_a_study_is_told(tmp_path):
    sweeps.study(tmp_path)
    with pytest.raises(CaseError, match=r"case\.toml is a case, not a study.*tribo new sweep"):
        plan(tmp_path / "case.toml", tmp_path / "out")


def test_a_missing_base_case_is_named(tmp_path):
    path = sweeps.study(tmp_path)
    (tmp_path / "case.toml").unlink()
    with pytest.raises(CaseError, match=r"^case: .*case\.toml: there is no such file"):
        plan(path, tmp_path / "out")
