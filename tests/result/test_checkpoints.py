"""What a run keeps beside its result: parts, checkpoints and a lock."""

import errno
import os
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from edited import bits
from paper_models import StopAfter, case, motion

from tribo import CaseError, Grid, Interrupted, Result, Simulation
from tribo.core import locks
from tribo.core.errors import OutputError, TriboWarning
from tribo.observers import recorder
from tribo.observers.observer import Observer
from tribo.result.checkpoint import RunFolder, _load, store
from tribo.result.sealed import open_sealed


def simulation():
    grid = Grid((0.7e-3, 0.7e-3), (24, 24))
    return Simulation(case(grid=grid, kinematics=motion(duration=60), save_times=(5, 20)))


@pytest.fixture(scope="module")
def undisturbed():
    with simulation().run() as result:
        return bits(result)


@pytest.fixture(scope="module")
def left(tmp_path_factory):
    """A folder left by a killed run: a checkpoint at its second save, and one at its end."""
    folder = tmp_path_factory.mktemp("left")
    with pytest.MonkeyPatch.context() as patch:

        def full(*_, **__):
            raise OSError(errno.ENOSPC, "No space left on device")

        # As if it were killed before it writes the whole result.
        patch.setattr(recorder, "filled_image", full)
        with pytest.warns(TriboWarning, match="No space"), pytest.raises(Interrupted):
            simulation().run(folder / "run.h5", observers=[StopAfter(steps=13)])
    return folder


@pytest.fixture
def killed(left, tmp_path):
    shutil.copytree(left, tmp_path, dirs_exist_ok=True)
    return tmp_path / "run.h5"


def flip(path, at):
    data = bytearray(path.read_bytes())
    data[at] ^= 1
    path.write_bytes(data)


@pytest.mark.slow
def test_a_killed_run_is_shown_as_far_as_it_came_and_goes_on_to_the_same_bits(killed, undisturbed):
    with Result.open(killed) as result:
        assert (result.status, result.wall_time) == ("killed", None)
        np.testing.assert_array_equal(result.times, [0, 5])
        assert len(result.table("history")["time_s"]) == 14
        assert float(result.pressure.sel(time=5).max()) > 0
    with simulation().resume(killed) as result:
        assert bits(result) == undisturbed
    assert list(killed.parent.iterdir()) == [killed]


@pytest.mark.parametrize(
    ("name", "at"),
    [("checkpoint", 2000), ("000002.part", 1000)],
)
def test_where_the_newest_checkpoint_is_damaged_the_one_before_is_used(
    killed, undisturbed, name, at
):
    flip(RunFolder(killed).path / name, at)
    with Result.open(killed) as result:
        np.testing.assert_array_equal(result.times, [0, 5])
        assert re.search(rf"{name} is damaged.*before it$", result.warnings[-1])
    with pytest.warns(TriboWarning, match=rf"{name} is .*from the .* before, at 5 s$") as told:
        resumed = simulation().resume(killed)
    assert len(told) == 1
    with resumed as result:
        assert bits(result) == undisturbed


def test_a_damaged_checkpoint_is_never_the_only_one(killed):
    folder = RunFolder(killed)
    flip(folder.checkpoint, 2000)
    with pytest.warns(TriboWarning, match="checkpoint"), pytest.raises(Interrupted):
        simulation().resume(killed, observers=[StopAfter(steps=14)])
    for path in (folder.checkpoint, folder.previous):
        open_sealed(path).close()


@pytest.mark.parametrize("names", [("checkpoint", "checkpoint.previous"), ("000000.part",)])
def test_where_no_checkpoint_is_sound_the_run_is_not_resumed(killed, names):
    for name in names:
        flip(RunFolder(killed).path / name, 2000)
    with pytest.raises(CaseError, match=r"tribo run -o") as raised:
        simulation().resume(killed)
    for name in names:
        assert str(raised.value).count(f"{name} is damaged") == 1
    with pytest.raises(CaseError, match=f"{names[0]} is damaged"):
        Result.open(killed)


def test_a_checkpoint_of_another_version_of_tribo_is_refused(killed):
    folder = RunFolder(killed)
    for path in (folder.checkpoint, folder.previous):
        data = _load(path)
        data["state"]["invariants"]["unheard_of"] = 1.0
        store(path, data)
    with pytest.raises(CaseError, match=r"another version.*unheard_of"):
        simulation().resume(killed)


def test_a_file_system_without_locks_is_told_of_once(tmp_path, monkeypatch):
    def flock(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(locks.fcntl, "flock", flock)
    with pytest.warns(
        TriboWarning, match=r"run\.h5\.run.lock: its file system has no locks"
    ) as told:
        simulation().run(tmp_path / "run.h5").close()
    assert len([each for each in told if "locks" in str(each.message)]) == 1


@pytest.mark.parametrize("length", [300, 253, 250])
def test_an_output_that_cannot_be_written_is_one_message(tmp_path, length):
    with pytest.raises(OutputError, match=r"cannot write .*too long.*choose another place"):
        simulation().run(tmp_path / ("a" * length + ".h5"))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["run.h5.run/notes.txt", "run.h5.run/checkpoint", "run.h5.run"])
def test_what_has_the_name_of_its_folder_is_refused_and_stays(tmp_path, name):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine")
    with pytest.raises(CaseError, match=r"run\.h5\.run was not made by tribo"):
        simulation().run(tmp_path / "run.h5", overwrite=True)
    assert (tmp_path / name).read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["run.h5.run"]


SPECIAL = {
    "a folder": Path.mkdir,
    "a pipe": os.mkfifo if hasattr(os, "mkfifo") else Path.mkdir,
    "a link to nothing": lambda path: path.symlink_to("nothing"),
}


@pytest.mark.parametrize("make", SPECIAL.values(), ids=SPECIAL)
def test_what_has_the_name_of_a_lock_is_refused_and_holds_nobody_up(killed, make):
    place = RunFolder(killed).path / "lock"
    place.unlink()
    make(place)
    before = place.lstat()
    with pytest.raises(CaseError, match=r"run\.h5\.run was not made by tribo"):
        simulation().resume(killed)
    assert place.lstat().st_ino == before.st_ino


def test_what_is_put_into_the_folder_of_a_run_stays(tmp_path):
    class Puts(Observer):
        def on_save(self, snapshot):
            (tmp_path / "run.h5.run" / "notes.txt").write_text("mine")

    simulation().run(tmp_path / "run.h5", observers=[Puts()]).close()
    assert [path.name for path in (tmp_path / "run.h5.run").iterdir()] == ["notes.txt"]
