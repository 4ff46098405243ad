"""A killed sweep, parent or worker, goes on; nothing is lost, nothing done twice."""

import os
import signal
import time
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from pathlib import Path

import pandas
import pytest
import sweeps

from tribo import Result, sweep
from tribo.core.errors import CaseError
from tribo.study.sweeping.executors import processes

# Of checkpoints that were not whole when their process was killed.
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::tribo.TriboWarning")]
PATIENCE = 120.0
LOADS = {"load.normal": [50, 60, 70]}


def until(found, what):
    """Wait for a function to return something true, and return that."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = found()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"no {what} within {PATIENCE:g} s")


def workers(parent):
    """Return the worker processes of a process."""
    threads = Path(f"/proc/{parent.pid}/task").glob("*/children")
    children = [int(child) for thread in threads for child in thread.read_text().split()]
    return [c for c in children if "spawn_main" in Path(f"/proc/{c}/cmdline").read_text()]


def alive(process):
    status = Path(f"/proc/{process}/stat")
    return status.exists() and status.read_text().rsplit(")", 1)[1].split()[0] != "Z"


def results(folder):
    return folder / "my-sweep" / "results"


def half_done(folder):
    return list(results(folder).glob("*.run/checkpoint"))


def written_since(folder, moment):
    files = results(folder).glob("*.run/*")
    with suppress(FileNotFoundError):
        return any(path.stat().st_mtime > moment for path in files)


def in_progress(folder):
    """Wait until a run writes, after what was killed."""
    moment = time.time()
    until(lambda: written_since(folder, moment), "run in progress")


def done(folder):
    """Return the finished results, each with what changes when a file is written."""
    found = {}
    for path in results(folder).glob("*.h5"):
        # What another process is writing cannot always be read.
        with suppress(CaseError), Result.open(path) as result:
            if result.status == "done" and not path.with_name(f"{path.name}.run").exists():
                found[path] = (path.stat().st_ino, path.stat().st_mtime_ns)
    return found


def table(folder):
    return pandas.read_csv(folder / "my-sweep" / "runs.csv").drop(
        columns="wall_time_s", errors="ignore"
    )


def test_a_sweep_survives_a_killed_worker_ctrl_c_and_a_killed_parent(tmp_path):
    case = sweeps.case(tmp_path, sweeps.SLOW)
    command = "sweep", case, "--vary", "load.normal=50,60,70", "--jobs", 2
    process = sweeps.tribo(*command, cwd=tmp_path)
    until(lambda: half_done(tmp_path), "run in progress")
    os.kill(workers(process)[0], signal.SIGKILL)
    until(lambda: done(tmp_path), "run that is done")
    in_progress(tmp_path)
    assert len(workers(process)) == 2
    # As a terminal does, to the parent and to its workers.
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    assert err.endswith("error: stopped; the same command continues\n")
    assert "Traceback" not in err
    assert "interrupted" in set(table(tmp_path)["status"])
    begun = time.time()
    killed = sweeps.tribo(*command, cwd=tmp_path)
    # A worker that loses its parent while it starts complains, in words of Python's.
    until(lambda: written_since(tmp_path, begun), "run that goes on")
    children = workers(killed)
    killed.kill()
    killed.communicate()
    until(lambda: not any(map(alive, children)), "end of the workers")
    before = done(tmp_path)
    # A worker may still have ended its run.
    assert 0 < len(before) < 3
    assert not (tmp_path / "my-sweep" / "runs.csv").exists()
    assert sweep(case, LOADS, executor=sweeps.Inline()).failures() == {}
    undisturbed = tmp_path / "undisturbed"
    sweep(sweeps.case(undisturbed, sweeps.SLOW), LOADS, executor=sweeps.Inline())
    pandas.testing.assert_frame_equal(table(tmp_path), table(undisturbed))
    assert before.items() <= done(tmp_path).items()


def test_the_death_of_a_worker_costs_no_other_run():
    with processes(2) as executor:
        fatal, slow = executor.submit(os._exit, 1), executor.submit(time.sleep, 1)
        with pytest.raises(BrokenProcessPool):
            fatal.result(PATIENCE)
        assert slow.result(PATIENCE) is None
        assert executor.submit(abs, -1).result(PATIENCE) == 1
