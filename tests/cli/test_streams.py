"""Standard streams that cannot be written to, or lack signs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from made_results import written

from tribo import Result
from tribo.templates import template

QUICK = ["--set", "grid.cells=24", "--set", "kinematics.duration=20"]
QUICK += ["--set", "output.save_times=[10]", "--set", "grid.size=0.7 mm"]
# A run as short as this one is silent otherwise.
TALKATIVE = """
import tribo.cli.main, tribo.observers.progress
tribo.observers.progress.QUIET = -1.0
tribo.cli.main.main()
"""
FULL = Path("/dev/full")
needs_full = pytest.mark.skipif(not FULL.exists(), reason="there is no /dev/full")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("streams")
    (folder / "my.toml").write_text(template("ball_on_disk"), encoding="utf-8")
    written(folder / "my.h5")
    return folder


@pytest.fixture
def full():
    with FULL.open("wb") as device:
        yield device


@pytest.fixture
def unread():
    """Return a pipe that nobody reads."""
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as pipe:
        yield pipe


def tribo(folder, *arguments, code=TALKATIVE, **options):
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, cwd=folder, check=False, timeout=300, **options)


@pytest.mark.slow
def test_a_pipe_that_nobody_reads_ends_quietly(folder, unread):
    done = tribo(folder, "show", "my.h5", "--json", stdout=unread, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.slow
def test_a_run_goes_on_without_a_reader_of_its_progress(folder, unread):
    done = tribo(folder, "run", "my.toml", "-o", "unread.h5", *QUICK, stdout=unread, stderr=unread)
    assert done.returncode == 141
    with Result.open(folder / "unread.h5") as result:
        assert result.status == "done"


@needs_full
@pytest.mark.slow
def test_an_error_that_cannot_be_told_has_its_exit_code(folder, full):
    assert tribo(folder, "run", "none.toml", stderr=full).returncode == 2


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="a shell of POSIX closes it")
@pytest.mark.parametrize("arguments", [["show", "my.h5"], ["--help"]])
def test_a_closed_standard_output_is_one_line_and_exit_code_3(folder, arguments):
    command = [sys.executable, "-m", "tribo", *arguments]
    closed = ["sh", "-c", 'exec "$@" >&-', "sh", *command]
    done = subprocess.run(closed, cwd=folder, stderr=subprocess.PIPE, timeout=300)
    assert done.returncode == 3
    assert done.stderr.count(b"\n") == 1
    assert b"standard output" in done.stderr


@pytest.mark.skipif(os.name == "nt", reason="a shell of POSIX closes it")
def test_an_error_is_not_put_on_standard_output_where_standard_error_is_closed(folder):
    closed = ["sh", "-c", 'exec "$@" 2>&-', "sh", sys.executable, "-m", "tribo", "show", "none.h5"]
    done = subprocess.run(closed, cwd=folder, stdout=subprocess.PIPE, timeout=300)
    assert (done.returncode, done.stdout) == (2, b"")


@pytest.mark.slow
def test_a_result_is_shown_on_a_stream_that_carries_ascii_only(folder):
    ascii_only = {**os.environ, "LC_ALL": "C", "PYTHONIOENCODING": "ascii"}
    done = tribo(folder, "show", "my.h5", env=ascii_only, capture_output=True)
    assert done.returncode == 0, done.stderr
    assert rb"mm\xb3/(N\xb7m)" in done.stdout
