"""The report of a comparison."""

import re

import pytest
import tribo
from command_line import tribo as command
from made_results import SHAPES, written
from pages import Checked

import tribo_report


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    folder = tmp_path_factory.mktemp("compared")
    written(folder / "a.h5", times=(0.0, 200.0, 500.0))
    written(folder / "b.h5", times=(0.0, 500.0), **SHAPES["line contact"])
    return folder, command("report", "a.h5", "b.h5", cwd=folder)


def test_it_says_how_far_the_second_is_off_the_first(ran):
    folder, done = ran
    assert done.returncode == 0, done.stderr
    assert "Wrote a-b-report.html" in done.stdout
    page = (folder / "a-b-report.html").read_text(encoding="utf-8")
    assert len(page.encode()) < 4_000_000
    Checked(page)
    with tribo.compare([folder / "a.h5", folder / "b.h5"]) as comparison:
        a, b = (comparison.save(label, 500.0)["bodies"]["ball"] for label in "ab")
    off = 100 * (b["max_wear_depth_m"] / a["max_wear_depth_m"] - 1)
    (answer, *_) = re.findall('<p class="answer">(.*?)</p>', page, re.S)
    assert f"is worn {1e6 * a['max_wear_depth_m']:.3g} µm (b: {off + 0.0:+.1f} %) deep" in answer


@pytest.mark.slow
def test_the_files_of_a_folder_are_compared(tmp_path, monkeypatch):
    monkeypatch.setattr("tribo_report.comparison.stills", lambda pictures: [])
    for name in "ab":
        written(tmp_path / f"{name}.h5", times=(0.0, 500.0))
    path = tribo_report.write_report(tmp_path, tmp_path / "report.html")
    assert "<h1>a and b</h1>" in path.read_text(encoding="utf-8")


def test_a_study_of_one_case_does_not_go_with_several_results(ran):
    done = command("report", "a.h5", "b.h5", "--verified", "study.json", cwd=ran[0])
    assert done.returncode == 2
    assert "--verified: a study of one case goes with one result" in done.stderr


def test_a_folder_without_results_is_told_and_none_is_made(tmp_path):
    with pytest.raises(tribo.CaseError, match=r"there is no folder .*; make it with: mkdir"):
        tribo_report.write_report(tmp_path, tmp_path / "new" / "report.html")
    with pytest.raises(tribo.CaseError, match="holds no result file"):
        tribo_report.write_report(tmp_path, tmp_path / "report.html")
