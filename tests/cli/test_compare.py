"""`tribo compare`, as a user meets it."""

import json

import pytest
from click.testing import CliRunner
from edited import edited
from made_results import empty_pictures, written

from tribo.cli.main import tribo
from tribo.core.errors import CaseError
from tribo.templates import template

QUICK = ["--set", "grid.cells=24", "--set", "grid.size=0.7 mm", "--set", "kinematics.duration=60"]
QUICK += ["--set", "output.save_times=[0, 20]"]
CONTACTS = ["--vary", "contact.type=dcfft,winkler"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("compare")
    (path / "my.toml").write_text(template("ball_on_disk"), encoding="utf-8")
    return path


def invoke(*args):
    return CliRunner().invoke(tribo, ["compare", *map(str, args)], catch_exceptions=False)


@pytest.fixture(scope="module")
def compared(folder):
    with pytest.MonkeyPatch.context() as monkeypatch:
        empty_pictures(monkeypatch)
        return invoke(folder / "my.toml", *CONTACTS, *QUICK)


def row(text, label):
    return next(line for line in text.splitlines() if label in line).split(label)[1].split()


@pytest.mark.slow
def test_the_table_has_a_column_a_variant(folder, compared):
    assert compared.exit_code == 0
    text = compared.stdout
    assert "Varied: contact.type" in text
    assert row(text, "steps")[0].isdigit()
    for words in ("time to solution, s", "at 0 s", "at 60 s", "ball depth, µm", "ball depth map"):
        assert words in text
    half_space, springs, *percent = row(text, "largest pressure, MPa")
    assert float(springs) / float(half_space) == pytest.approx(4 / 3, rel=0.05)
    assert percent == [f"+{100 * (float(springs) / float(half_space) - 1):.1f}", "%"]
    names = {path.name for path in (folder / "my-compare").iterdir()}
    assert {"contact.type=dcfft.h5", "contact.type=winkler.h5", "comparison_60s.png"} <= names


def test_json_is_one_object_and_files_compare_alike(folder, compared):
    files = [folder / "my-compare" / f"contact.type={name}.h5" for name in ("dcfft", "winkler")]
    written = [path.stat().st_mtime_ns for path in files]
    again = invoke(folder / "my.toml", *CONTACTS, *QUICK, "--json", "--no-plots")
    # What is done is not run again.
    assert [path.stat().st_mtime_ns for path in files] == written
    data = json.loads(again.stdout)
    assert [each["time_s"] for each in data["differences"]] == [0, 20, 60]
    assert data["pictures"] == []
    of_files = json.loads(invoke(*files, "--json", "--no-plots", "--at", "1 min").stdout)
    (last,) = of_files["differences"]
    assert list(last["results"].values()) == list(data["differences"][-1]["results"].values())


@pytest.mark.parametrize(
    ("files", "options", "message"),
    [
        (["my.toml"], [], "1 to compare; give 2 or more, or what varies in a case"),
        (["my.toml", "b.h5"], CONTACTS, "--vary varies one case, 2 files are given"),
        (["a.h5", "b.h5"], ["--set", "a=1"], "--set is for a case that varies"),
        (["a.h5", "b.h5"], ["--at", "1 mm"], "--at: '1 mm' is a length [m]; a time [s] is needed"),
    ],
)
def test_bad_input_is_told_before_anything_runs(folder, tmp_path, files, options, message):
    target = ["-o", tmp_path / "none", *(QUICK if "--vary" in options else [])]
    with pytest.raises(CaseError) as caught:
        invoke(*(folder / name for name in files), *options, *target)
    assert message in str(caught.value)
    assert not (tmp_path / "none").exists()


def test_the_time_of_a_run_that_was_killed_is_not_known(tmp_path):
    files = written(tmp_path / "whole.h5"), written(tmp_path / "killed.h5", status="killed")
    with edited(files[1]) as file:
        del file.attrs["wall_time_s"]
    whole, killed = row(invoke(*files, "--no-plots").stdout, "time to solution, s")
    assert (whole.replace(".", "").isdigit(), killed) == (True, "–")
    results = json.loads(invoke(*files, "--no-plots", "--json").stdout)["results"]
    assert results["killed"]["totals"]["wall_time_s"] is None
    shown = CliRunner().invoke(tribo, ["show", str(files[1])])
    assert "contact solves.\n" in shown.stdout
