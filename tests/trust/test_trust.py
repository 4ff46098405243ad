"""A few of the trials; the long runs of them are commands."""

import os
import signal
from dataclasses import replace

import pytest
import trust.damages
from edited import edited
from trust import trial
from trust.damages import KINDS, damage_and_read
from trust.full_disks import FullDisks, fill_and_resume
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


def test_a_file_read_wrong_would_be_seen(tmp_path, monkeypatch):
    def other_load(data, chance):
        path = tmp_path / "other.h5"
        path.write_bytes(data)
        with edited(path) as file:
            file.attrs["load_N"] = chance.uniform(1, 100)
        data[:] = path.read_bytes()

    monkeypatch.setattr(trust.damages, "KINDS", (other_load,))
    monkeypatch.chdir(tmp_path)
    damages = damage_and_read(2, seed=3)
    assert damages.ends() == {"silently wrong": 2}
    assert not damages.good


def test_other_bits_after_a_kill_would_be_seen(monkeypatch):
    write = RunFolder.write_checkpoint

    def other(folder, kept, **options):
        state = replace(kept.state, distance=kept.state.distance + 1e-9)
        write(folder, replace(kept, state=state), **options)

    monkeypatch.setattr(RunFolder, "write_checkpoint", other)
    kills = kill_and_resume(1, seed=3)
    assert kills.different > 0
    assert not kills.good


def test_a_save_lost_to_a_full_disk_would_be_seen():
    sound = FullDisks(stopped=2, identical=2)
    assert sound.good
    bad = ({"lost_saves": 1}, {"other_exits": 1}, {"identical": 1}, {"stopped": 0, "identical": 0})
    assert not any(replace(sound, **change).good for change in bad)
