"""`tribo compare`, as a user meets it."""

import json
import shutil

import pytest
from click.testing import CliRunner
from made_results import made

from tribo.cli.main import tribo
from tribo.core.errors import CaseError
from tribo.result.seal import write_sealed
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
    return invoke(folder / "my.toml", *CONTACTS, *QUICK)


def row(text, label):
    return next(line for line in text.splitlines() if label in line).split(label)[1].split()


def test_the_table_has_a_column_a_variant(compared):
    assert compared.exit_code == 0
    text = compared.stdout
    assert "Varied: contact.type" in text
    assert row(text, "steps")[0].isdigit()
    for words in ("time to solution, s", "at 0 s", "at 60 s", "ball depth, µm", "ball wear field"):
        assert words in text
    half_space, springs, *percent = row(text, "largest pressure, MPa")
    assert float(springs) / float(half_space) == pytest.approx(4 / 3, rel=0.05)
    assert percent == [f"+{100 * (float(springs) / float(half_space) - 1):.1f}", "%"]


def test_results_and_pictures_stand_beside_the_case(folder, compared):
    names = {path.name for path in (folder / "my-compare").iterdir()}
    assert {"contact.type=dcfft.h5", "contact.type=winkler.h5", "pressure_60s.png"} <= names
    assert "ball_60s.png" in compared.stdout
    assert "1 of 2, contact.type=dcfft" in compared.stderr


def test_json_is_one_object_and_files_compare_alike(folder, compared):
    again = invoke(folder / "my.toml", *CONTACTS, *QUICK, "--json", "--no-plots")
    assert "done already" in again.stderr
    data = json.loads(again.stdout)
    assert [save["time_s"] for save in data["saves"]] == [0, 20, 60]
    assert data["pictures"] == []
    files = [folder / "my-compare" / f"contact.type={name}.h5" for name in ("dcfft", "winkler")]
    of_files = json.loads(invoke(*files, "--json", "--no-plots", "--at", "1 min").stdout)
    (last,) = of_files["saves"]
    assert list(last["results"].values()) == list(data["saves"][-1]["results"].values())


@pytest.mark.parametrize(
    ("files", "options", "message"),
    [
        (["my.toml"], [], "is a case; say what varies in it with --vary"),
        (["my.toml", "b.h5"], CONTACTS, "--vary varies one case, 2 files are given"),
        (["my.toml"], ["--vary", "contact.type=dcfft"], "1 variant; give 2 to 12"),
        (["my.toml"], ["--vary", "contact.type="], "contact.type: a value is missing"),
        (["my.toml"], ["--vary", "loda.normal=1,2"], "unknown key 'loda'; did you mean 'load'?"),
        (["a.h5", "b.h5"], ["--force"], "--set and --force are for a case that varies"),
        (["a.h5", "b.h5"], [], "a.h5 is not a file"),
        (["a.h5", "b.h5"], ["--at", "1 mm"], "--at: '1 mm' is a length [m]; a time [s] is needed"),
    ],
)
def test_bad_input_is_told(folder, files, options, message):
    with pytest.raises(CaseError) as caught:
        invoke(
            *(folder / name for name in files), *options, *(QUICK if "--vary" in options else [])
        )
    assert message in str(caught.value)
    assert caught.value.exit_code == 2


def test_a_time_that_is_not_saved_is_told_before_anything_runs(folder):
    nowhere = folder / "nowhere"
    with pytest.raises(CaseError, match="nothing is saved at 3600 s, only at 0, 20, 60 s; add it"):
        invoke(folder / "my.toml", *CONTACTS, *QUICK, "--at", "1 h", "-o", nowhere)
    assert not nowhere.exists()


def test_a_damaged_file_is_named_before_anything_is_shown(folder, compared):
    whole = folder / "my-compare" / "contact.type=dcfft.h5"
    damaged = folder / "damaged.h5"
    data = bytearray(whole.read_bytes())
    data[len(data) // 2] ^= 1
    damaged.write_bytes(data)
    done = CliRunner().invoke(tribo, ["compare", str(whole), str(damaged)])
    assert isinstance(done.exception, CaseError)
    assert "damaged.h5 is damaged" in str(done.exception)
    assert done.stdout == ""


def test_the_time_of_a_run_that_was_killed_is_not_known(tmp_path):
    for name, status in (("whole", "done"), ("killed", "running")):
        image = made(status=status)._file.file.id.get_file_image()
        write_sealed(tmp_path / f"{name}.h5", image, identity=bytes(16), sync=False)
    files = [tmp_path / "whole.h5", tmp_path / "killed.h5", "--no-plots"]
    whole, killed = row(invoke(*files).stdout, "time to solution, s")
    assert (whole.replace(".", "").isdigit(), killed) == (True, "–")
    results = json.loads(invoke(*files, "--json").stdout)["results"]
    assert results[1]["totals"]["wall_time_s"] is None
    shown = CliRunner().invoke(tribo, ["show", str(tmp_path / "killed.h5")])
    assert "contact solves.\n" in shown.stdout


def test_names_of_files_are_shown_as_they_are_and_not_broken(folder):
    names = ["[m]", "steel_on_steel_in_oil", "steel_on_bronze_in_oil"]
    of_grids = folder / "grids"
    cells = ["--vary", "grid.cells=18,20", *QUICK, "--no-plots", "-o", of_grids]
    assert invoke(folder / "my.toml", *cells).exit_code == 0
    for name, count in zip(names, (18, 20, 20), strict=True):
        shutil.copy(of_grids / f"grid.cells={count}.h5", folder / f"{name}.h5")
    done = invoke(*(folder / f"{name}.h5" for name in names), "--no-plots")
    lines = done.stdout.splitlines()
    first_note = next(i for i, line in enumerate(lines) if line.startswith("Note"))
    tables = map(str.split, lines[2:first_note])
    heads = [words for words in tables if words and words[0] in names]
    assert [head for line in heads for head in line] == names
    assert "relative to [m];" in done.stdout
    assert f"Note: {names[1]}, {names[2]}: not on the grid of [m]," in done.stdout.replace(
        "\n", " "
    )
    assert max(map(len, lines)) <= 80


def test_many_results_go_below_each_other(folder):
    loads = ["--vary", "load.normal=50,60,70,80,90"]
    done = invoke(folder / "my.toml", *loads, *QUICK, "-o", folder / "loads", "--no-plots")
    assert done.stdout.count("contact solves") == 2
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_another_comparison_of_a_case_does_not_overwrite_the_first(folder, compared):
    before = {path: path.stat().st_mtime_ns for path in (folder / "my-compare").iterdir()}
    with pytest.raises(CaseError, match=r"my-compare holds another comparison, contact\.type"):
        invoke(folder / "my.toml", "--vary", "load.normal=50,100", *QUICK)
    assert {path: path.stat().st_mtime_ns for path in (folder / "my-compare").iterdir()} == before


def test_a_comparison_that_has_grown_goes_on_in_its_folder(folder):
    target = ["-o", folder / "grown", "--no-plots"]
    invoke(folder / "my.toml", "--vary", "load.normal=50,60", *QUICK, *target)
    grown = invoke(folder / "my.toml", "--vary", "load.normal=50,60,70", *QUICK, *target)
    assert grown.stderr.count("done already") == 2


def test_pictures_of_other_files_go_to_another_folder(folder, compared, tmp_path):
    for name in "abc":
        shutil.copy(folder / "my-compare" / "contact.type=dcfft.h5", tmp_path / f"{name}.h5")
    for other in "bc":
        assert invoke(tmp_path / "a.h5", tmp_path / f"{other}.h5", "--at", "0").exit_code == 0
    assert {path.name for path in tmp_path.iterdir() if path.is_dir()} == {
        "a-b-compare",
        "a-c-compare",
    }
