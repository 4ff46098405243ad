"""A run that could not be written for a while ends, once resumed, as if nothing had happened."""

import errno
from functools import cache

import numpy as np
import pytest
from paper_models import motion, small

from tribo import Grid, Result, Simulation, TriboError
from tribo.case import Stop
from tribo.observers.recorder import Recorder


def model(stop):
    changes = {} if stop is None else {"stop": Stop(depth=stop)}
    # A stroke so short that the run gives a notice.
    kinematics = motion(stroke="0.7 mm", frequency=71, duration=60)
    grid = Grid((0.7e-3, 0.7e-3), (32, 32))
    return small(grid=grid, kinematics=kinematics, save_times=(5, 20), **changes)


def told(path):
    with Result.open(path) as result:
        fields = [result.field("pressure", i) for i in range(len(result.times))]
        return result.status, list(result.notices), list(result.times), fields


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """What a run that nothing disturbs tells, by the depth that ends it."""
    path = tmp_path_factory.mktemp("whole") / "whole.h5"

    @cache
    def whole(stop):
        Simulation(model(stop).case).run(path, overwrite=True).close()
        return told(path)

    return whole


@pytest.mark.filterwarnings("ignore::tribo.TriboWarning")
@pytest.mark.parametrize(("stop", "failing"), [(None, 1), ("1 um", 3)])
def test_resumed_it_equals_an_undisturbed_run(undisturbed, tmp_path, monkeypatch, stop, failing):
    path = tmp_path / "broken.h5"
    write, saves = Recorder._append_save, []

    def full(writer, snapshot):
        saves.append(snapshot)
        if len(saves) == failing:
            raise OSError(errno.ENOSPC, "No space left on device")
        write(writer, snapshot)

    with monkeypatch.context() as patched:
        patched.setattr(Recorder, "_append_save", full)
        with pytest.raises(TriboError, match="No space left"):
            Simulation(model(stop).case).run(path)
    Simulation(model(stop).case).resume(path).close()
    for found, needed in zip(told(path), undisturbed(stop), strict=True):
        np.testing.assert_equal(found, needed)
