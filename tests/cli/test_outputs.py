"""What a command writes replaces a regular file, and nothing else."""

import os
import stat
import sys

import pytest
from click.testing import CliRunner
from made_results import quick_reports, written

from tribo.cli.main import tribo
from tribo.core.errors import CaseError

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")
COMMANDS = {
    "new --force ball_on_disk out.toml": "out.toml",
    "report my.h5 -o out.html": "out.html",
    "export my.h5 -d out": "out/history.csv",
    "plot my.h5 -d out --column max_pressure_Pa": "out/history.png",
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    quick_reports(monkeypatch)
    written(tmp_path / "my.h5")
    (tmp_path / "out").mkdir()
    return tmp_path


def called(command):
    return CliRunner().invoke(tribo, command.split())


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("kind", ["link", "pipe"])
def test_a_link_or_a_pipe_is_refused_and_stays(folder, command, kind):
    output, mine = folder / COMMANDS[command], folder / "mine"
    mine.write_text("mine")
    os.mkfifo(output) if kind == "pipe" else output.symlink_to(mine)
    before = output.lstat()
    done = called(command)
    assert isinstance(done.exception, CaseError)
    assert COMMANDS[command] in str(done.exception)
    assert (output.lstat().st_ino, mine.read_text()) == (before.st_ino, "mine")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_file_is_replaced_and_its_mode_stays(folder, command):
    output = folder / COMMANDS[command]
    output.write_text("old")
    output.chmod(0o600)
    with output.open() as reader:
        assert called(command).exit_code == 0
        # Whoever reads the old file reads it to its end.
        assert reader.read() == "old"
    assert stat.S_IMODE(output.stat().st_mode) == 0o600
    assert not list(folder.rglob("*.new"))
