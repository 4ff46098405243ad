"""Results side by side: what is the same differs by round-off, what is not by what was changed."""

import json
import shutil
import tomllib
import warnings
from pathlib import Path

import pytest
from made_results import written

from tribo import TriboWarning, compare
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError, NumericalError
from tribo.study.runs import file_names
from tribo.templates import template

K, MU = 3.11e-16, 0.1
CASE = apply_settings(
    tomllib.loads(template("ball_on_disk")),
    {
        "grid": {"size": "0.9 mm", "cells": 26},
        "stepping": {"type": "implicit", "depth_tolerance": 1e-2, "pressure_tolerance": 0.3},
        "kinematics.duration": 300,
        "output": {"save_times": [0, 100]},
    },
)
CONTACTS = {"contact.type": ("dcfft", "winkler")}


@pytest.fixture(scope="module")
def foundations(tmp_path_factory):
    with compare(CASE, CONTACTS, tmp_path_factory.mktemp("whole")) as comparison:
        yield comparison


def test_json_has_every_common_save_and_is_json(foundations):
    data = json.loads(json.dumps(foundations.as_json(), allow_nan=False))
    assert data["reference"] == "dcfft"
    assert list(data["results"]) == ["dcfft", "winkler"]
    assert data["results"]["winkler"]["settings"] == {"contact.type": "winkler"}
    assert data["results"]["dcfft"]["totals"]["contact_solves"] > 3
    assert [each["time_s"] for each in data["differences"]] == [0, 100, 300]
    first, *_, last = (each["results"]["winkler"] for each in data["differences"])
    assert list(first) == ["pressure"]
    # Once worn, depths are compared as well.
    assert list(last) == ["pressure", "bodies.ball.wear_depth", "bodies.disk.wear_depth"]
    assert last["pressure"].keys() == {"l2", "largest"}


@pytest.fixture(scope="module")
def saved_at(tmp_path_factory):
    """Compare made results that were saved at these times."""
    folder, kept = tmp_path_factory.mktemp("saved"), {}

    def compared(*times):
        for each in times:
            if each not in kept:
                kept[each] = written(folder / f"{each[-1]}.h5", times=each)
        return compare([kept[each] for each in times])

    return compared


def test_only_common_saves_count(saved_at):
    with saved_at((0, 50, 100, 300), (0, 100, 150)) as comparison:
        assert comparison.times == comparison.chosen_times() == [0, 100]
        with pytest.raises(CaseError, match="has no saved time 50 s; saved times: "):
            comparison.chosen_times([50])


def test_results_without_a_common_save_are_refused(saved_at):
    with pytest.raises(CaseError, match="no time of a save in common: 150 <Result"):
        saved_at((0, 100, 150), (75, 200))


def test_bodies_of_other_names_are_refused(tmp_path):
    pin = written(tmp_path / "pin.h5", names=("pin", "disk"))
    with pytest.raises(CaseError, match="bodies of pin are called pin and disk, of ball ball and"):
        compare([written(tmp_path / "ball.h5"), pin])


def test_a_folder_with_another_case_is_left_alone(foundations):
    folder = Path(foundations.results["dcfft"].name).parent
    with pytest.raises(CaseError, match="is the result of another case; choose another folder"):
        compare(CASE | {"load": {"normal": 120}}, CONTACTS, folder)


@pytest.mark.slow
def test_a_run_that_fails_is_named():
    settings = [{"grid.size": "0.2 mm"}, {}]
    with pytest.raises((CaseError, NumericalError), match=r"^grid\.size=0\.2 mm: "):
        compare(CASE, settings)


@pytest.mark.parametrize(
    ("vary", "options", "message"),
    [
        ({"contact.type": ("dcfft", "winklr")}, {}, "did you mean 'winkler'"),
        ({"load.normal": (50, 100)}, {"labels": ["a", "a"]}, "as many different labels"),
        ([{"load.normal": 10.0}], {}, "give 2 or more"),
    ],
)
def test_what_is_wrong_is_told_before_anything_runs(tmp_path, vary, options, message):
    with pytest.raises(CaseError, match=message):
        compare(CASE, vary, tmp_path / "new", **options)
    assert not (tmp_path / "new").exists()


def test_files_are_compared_under_their_names(tmp_path):
    (tmp_path / "other").mkdir()
    a = written(tmp_path / "a.h5")
    b, c = (Path(shutil.copy(a, tmp_path / name)) for name in ("b.h5", "other/a.h5"))
    with compare([a, b]) as comparison:
        assert list(comparison.results) == ["a", "b"]
        assert comparison.settings == {}
    with compare([a, b, c]) as comparison:
        assert list(comparison.results) == [str(path) for path in (a, b, c)]
    for names, message in (
        ([], "0 to compare; give 2 or more"),
        ([a], "1 to compare; give 2 or more"),
        ([a, a], "2 results need as many different labels"),
        ([a, tmp_path / "none.h5"], "is not a file"),
    ):
        with pytest.raises(CaseError, match=message):
            compare(names)


def test_a_finding_of_several_runs_is_given_once():
    coarse = CASE | {"grid": {"size": "0.9 mm", "cells": 12}}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        with compare(coarse, CONTACTS) as comparison:
            found, *_ = comparison.findings
    assert (found.kind, found.limit) == ("resolution", 8)
    assert found.words.startswith("dcfft; winkler: ")


def test_file_names_are_safe_and_different():
    names = file_names(["load.normal=50 N", "load.normal=50/N", "a" * 200, "a" * 201])
    assert names[:2] == ["load.normal=50_N.h5", "load.normal=50_N~1.h5"]
    assert len(set(names)) == 4
    assert max(map(len, names)) < 120


def test_the_data_frame_has_a_row_for_each_result_and_time(foundations, capsys):
    table = foundations.to_dataframe([100])
    assert list(table["result"]) == ["dcfft", "winkler"]
    assert list(table["time (s)"]) == [100, 100]
    peak = foundations.save("winkler", 100)["max_pressure_Pa"]
    assert table["p max (MPa)"][1] == pytest.approx(1e-6 * peak, rel=1e-12)
    foundations.show([100])
    printed = capsys.readouterr().out
    assert "at 100 s" in printed
    assert "at 300 s" not in printed.split("Note:")[0]
