"""A few of the trials; the long runs of them are commands."""

import os
import signal

import pytest
from trust import trial
from trust.damages import KINDS, damage_and_read
from trust.full_disks import fill_and_resume
from trust.kills import kill_and_resume
from trust.trial import contents, resume, run, same, start, whole

from tribo.observers.recorder import Recorder
from tribo.result.checkpoint import RunFolder

pytestmark = pytest.mark.slow


def test_killed_runs_go_on_to_the_same_bits():
    kills = kill_and_resume(4, seed=3)
    assert kills.killed == kills.identical == 4
    assert (kills.lost_saves, kills.unreadable) == (0, 0)


def test_damaged_files_are_never_read_wrong():
    damages = damage_and_read(5 * len(KINDS), seed=3)
    assert set(damages.ends()) <= {"refused", "read right"}
    assert damages.ends()["refused"] > 20


def test_a_full_disk_costs_nothing_that_was_saved():
    disks = fill_and_resume(2, seed=5)
    assert disks.stopped == disks.identical == 2
    assert (disks.other_exits, disks.lost_saves) == (0, 0)


def test_killed_between_a_step_and_its_save(tmp_path, monkeypatch):
    monkeypatch.setattr(trial, "CHECKPOINTS", 0.0)
    undisturbed = contents(whole(tmp_path))
    path = tmp_path / "run.h5"

    def dies(*args):
        append_save, left = Recorder._append_save, [3]

        def killed(self, snapshot):
            left[0] -= 1
            if not left[0]:
                os.kill(os.getpid(), signal.SIGKILL)
            append_save(self, snapshot)

        Recorder._append_save = killed
        run(*args)

    code, told = start(dies, path).wait()
    assert (code, list(told)) == (-signal.SIGKILL, [0.0, 10.0])
    assert start(resume, path).wait()[0] == 0
    assert same(contents(path), undisturbed)


def test_killed_as_it_ended(tmp_path):
    undisturbed = contents(whole(tmp_path))
    path = tmp_path / "run.h5"

    def dies(*args):
        RunFolder.remove = lambda folder: os.kill(os.getpid(), signal.SIGKILL)
        run(*args)

    assert start(dies, path).wait()[0] == -signal.SIGKILL
    assert start(resume, path).wait()[0] == 0
    assert same(contents(path), undisturbed)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["run.h5", "whole.h5"]
