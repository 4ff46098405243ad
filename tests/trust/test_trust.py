"""A few of the trials; the long runs of them are commands."""

import pytest
from trust.damages import KINDS, damage_and_read
from trust.full_disks import fill_and_resume
from trust.kills import kill_and_resume


def test_killed_runs_go_on_to_the_same_bits():
    kills = kill_and_resume(6, seed=3)
    assert kills.killed == kills.identical == 6
    assert (kills.lost_saves, kills.unreadable) == (0, 0)


def test_damaged_files_are_never_read_wrong():
    damages = damage_and_read(10 * len(KINDS), seed=3)
    assert set(damages.ends()) <= {"refused", "read right"}
    assert damages.ends()["refused"] > 50


@pytest.mark.parametrize("tmpfs", [False, True], ids=["size limit", "tmpfs"])
def test_a_full_disk_costs_nothing_that_was_saved(tmpfs):
    try:
        disks = fill_and_resume(5, seed=5, tmpfs=tmpfs)
    except PermissionError as error:
        pytest.skip(str(error))
    assert disks.stopped == disks.identical > 0
    assert (disks.other_exits, disks.lost_saves) == (0, 0)
