"""A study says which points are run; what is wrong with it is said before anything runs."""

import math

import numpy as np
import pytest
import sweeps

from tribo.core.errors import CaseError
from tribo.study.sweeping.study_file import load_study, points
from tribo.study.sweeping.sweep import plan

RANGES = """
[sample]
method = "{method}"
count = {count}
seed = {seed}

[sample.ranges]
load.normal = {{ low = "50 N", high = "0.2 kN" }}
"bodies.ball.wear.k" = {{ low = 1e-17, high = "1e-15 1/Pa", scale = "log" }}
"""


def made(tmp_path, text):
    study, data = load_study(sweeps.study(tmp_path, sweeps.QUICK + text))
    return points(study, data)


def sampled(tmp_path, method="latin_hypercube", count=16, seed=1):
    return made(tmp_path, RANGES.format(method=method, count=count, seed=seed))


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


@pytest.mark.parametrize("method", ["latin_hypercube", "sobol"])
def test_a_sample_fills_every_slice_of_every_range_and_a_seed_gives_it_again(tmp_path, method):
    found = sampled(tmp_path, method)
    loads = (np.array([point["load.normal"] for point in found]) - 50) / 150
    logs = np.log10([point["bodies.ball.wear.k"] for point in found])
    for part in (loads, (logs + 17) / 2):
        assert sorted(np.floor(16 * part)) == list(range(16))
    assert found == sampled(tmp_path, method)
    assert found != sampled(tmp_path, method, seed=2)


def test_fewer_sobol_points_are_the_first_of_more(tmp_path):
    assert sampled(tmp_path, "sobol", count=12) == sampled(tmp_path, "sobol")[:12]


def test_a_sample_multiplies_what_is_listed_and_reads_its_ranges_there(tmp_path):
    # `layer` is a key of winkler alone, which only the list chooses.
    text = """
    [[list]]
    contact.type = "winkler"
    contact.match = "approach"
    [sample]
    method = "sobol"
    count = 1
    ranges."kinematics.stroke" = { low = "1 mm", high = "3 mm" }
    """
    (point,) = made(tmp_path, text)
    assert 1e-3 <= point["kinematics.stroke"] < 3e-3
    assert math.isfinite(point["kinematics.stroke"])


GRID, SAMPLE = "[grid]\n", '[sample]\nmethod = "sobol"\ncount = 2\n[sample.ranges]\n'


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
        (SAMPLE.replace("sobol", "sobl"), "did you mean 'sobol'?"),
        (SAMPLE, "sample.ranges: at least 1"),
        (SAMPLE + "load.normal = {low = 1}", 'sample.ranges."load.normal".high: missing'),
        (SAMPLE + "load.normal = {low = 0, high = 2}", "sample.ranges: the low ends cannot be"),
        (
            SAMPLE + "load.normal = {low = '2 N', high = 1}",
            "sample.ranges.load.normal: low, 2 N, must",
        ),
        (SAMPLE + "grid.cells = {low = 16, high = 32}", "grid.cells: is not a quantity"),
        (
            SAMPLE + "'friction.coefficient' = {low = 0, high = 1, scale = 'log'}",
            "sample.ranges.friction.coefficient: low must be greater than 0 on a log scale",
        ),
        (SAMPLE.replace("= 2", "= 1024") + "load.normal = {low = 1, high = 2}", "1024 runs; if"),
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


def test_as_many_runs_as_are_meant_are_planned(tmp_path, monkeypatch):
    monkeypatch.setattr("tribo.study.sweeping.sweep.MANY", 1)
    path = sweeps.study(tmp_path)
    with pytest.raises(CaseError, match="2 runs; if that is meant, give --yes"):
        plan(path, tmp_path / "out")
    runs, paths = plan(path, tmp_path / "out", many=True)
    assert len({run.path for run in runs}) == 2
    assert paths == ["load.normal"]
