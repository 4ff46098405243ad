"""A few of the trials; the long runs of them are commands."""

import pytest
from trust.damages import damage_and_read
from trust.full_disks import fill_and_resume

pytestmark = pytest.mark.slow


def test_damaged_files_are_never_read_wrong():
    damages = damage_and_read(30, seed=3)
    assert damages.refused == damages.files == 30


def test_a_full_disk_costs_nothing_that_was_saved():
    assert fill_and_resume(1, seed=5).good
