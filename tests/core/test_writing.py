"""A file is replaced whole or not at all, and only where a regular file is."""

import os
import stat
import sys

import pytest

from tribo.core.errors import CaseError, OutputError
from tribo.core.writing import check_new, make_folder, open_lock, remove, write_file

posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_what_cannot_be_written_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch, call):
    path = tmp_path / "a.csv"
    write_file(path, "old\n")

    def fails(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, call, fails)
    with pytest.raises(OutputError, match=r"cannot write to .*a\.csv: No space left"):
        write_file(path, "new\n")
    assert path.read_text() == "old\n"
    assert names(tmp_path) == ["a.csv"]


def test_each_new_file_has_a_name_of_its_own(tmp_path, monkeypatch):
    made, replace = [], os.replace
    monkeypatch.setattr(os, "replace", lambda old, new: (made.append(old), replace(old, new)))
    for _ in range(2):
        write_file(tmp_path / "a", b"12", memoryview(b"3"))
    assert len(set(made)) == 2
    assert (tmp_path / "a").read_bytes() == b"123"


def special(kind, path, there):
    if kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    else:
        if kind == "link":
            there.write_text("mine")
        path.symlink_to("/dev/null" if kind == "device" else there)
    return path.lstat()


@posix
@pytest.mark.parametrize("act", [lambda path: write_file(path, "new"), remove, open_lock])
@pytest.mark.parametrize("kind", ["folder", "pipe", "link", "dangling", "device"])
def test_what_is_no_regular_file_is_left_alone(tmp_path, kind, act):
    path, there = tmp_path / "a", tmp_path / "there"
    before = special(kind, path, there)
    with pytest.raises(CaseError, match=str(path)):
        act(path)
    with pytest.raises(CaseError):
        check_new(path, replace=True)
    assert path.lstat().st_ino == before.st_ino
    assert there.exists() == (kind == "link")
    assert kind != "link" or there.read_text() == "mine"


def test_a_file_is_replaced_only_where_that_is_asked_for(tmp_path):
    (tmp_path / "a").touch()
    check_new(tmp_path / "a", replace=True)
    check_new(tmp_path / "b", replace=False)
    with pytest.raises(CaseError, match="--force"):
        check_new(tmp_path / "a", replace=False)


@posix
@pytest.mark.parametrize("mode", [0o600, 0o666])
def test_the_mode_of_a_file_stays(tmp_path, mode):
    path = tmp_path / "a"
    path.touch()
    path.chmod(mode)
    write_file(path, "new")
    assert stat.S_IMODE(path.stat().st_mode) == mode


@posix
def test_the_bytes_are_on_the_disk_before_the_name_and_the_name_at_the_end(tmp_path, monkeypatch):
    done, fsync, replace = [], os.fsync, os.replace
    monkeypatch.setattr(os, "fsync", lambda file: (done.append("fsync"), fsync(file)))
    monkeypatch.setattr(os, "replace", lambda *names: (done.append("replace"), replace(*names)))
    write_file(tmp_path / "a", "new")
    assert done == ["fsync", "replace", "fsync"]


def test_folders_are_made_with_those_that_they_lie_in(tmp_path):
    for _ in range(2):
        make_folder(tmp_path / "a" / "b")
    (tmp_path / "file").touch()
    with pytest.raises(OutputError):
        make_folder(tmp_path / "file" / "c")
    assert names(tmp_path) == ["a", "file"]
