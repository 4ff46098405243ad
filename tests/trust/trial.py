"""The run that the trials are made with, and how one of them is watched."""

import os
import signal
import sys
import time
import traceback
import warnings
from functools import partial
from pathlib import Path

import h5py
import numpy as np
from paper_models import half_space, motion, pair, small
from strangers.debris import Debris
from strangers.running_in import RunningIn

import tribo.simulation.run
from tribo import Grid, Simulation
from tribo.core.errors import TriboError
from tribo.observers import recorder
from tribo.observers.observer import Observer

SAVES = (2, 4, 6)
TIME_LIMIT = 120.0
CHECKPOINTS = 0.1
"""Wall time between checkpoints, in s, so that many fall between the saves."""


def simulation():
    """Eight seconds of a ball on a disk, whose laws remember, and debris between them."""
    law = RunningIn(k_first=9e-16, k_last=3e-16, length=5.0)
    model = small(
        grid=Grid((0.7e-3, 0.7e-3), (20, 20)),
        contact=half_space(),
        bodies=pair(law, law),
        kinematics=motion(duration=8),
        effects=[Debris(length=0.5)],
        save_times=SAVES,
    )
    return Simulation(model.case)


class Acknowledge(Observer):
    """Writes the time of each save to a pipe once the recorder has it."""

    pipe: int

    def on_save(self, snapshot):
        os.write(self.pipe, np.float64(snapshot.state.time).tobytes())


def run(path, pipe):
    simulation().run(path, observers=[Acknowledge(pipe=pipe)], overwrite=True).close()


def resume(path, pipe):
    simulation().resume(path, observers=[Acknowledge(pipe=pipe)]).close()


def start(work, *args):
    """Fork a process that does `work` and return it, with what it acknowledges.

    It exits as the command line would: 0, or the exit code of the error, which goes to stderr.
    """
    reading, writing = os.pipe()
    pid = os.fork()
    if pid:
        os.close(writing)
        return Child(pid, reading)
    code = 70
    try:
        os.close(reading)
        warnings.simplefilter("ignore")
        tribo.simulation.run.Recorder = partial(recorder.Recorder, checkpoint_every=CHECKPOINTS)
        work(*args, writing)
        code = 0
    except TriboError as error:
        code = error.exit_code
        print(f"error: {error}", file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)


class Child:
    """A forked process."""

    def __init__(self, pid, pipe):
        self.pid, self._pipe = pid, pipe

    def kill(self):
        os.kill(self.pid, signal.SIGKILL)

    def wait(self):
        """Return how it ended, as `subprocess` has it, and the times of the saves it told of."""
        told = b""
        end = time.monotonic() + TIME_LIMIT
        status = 0
        while True:
            done, status = os.waitpid(self.pid, os.WNOHANG)
            if done:
                break
            if time.monotonic() > end:
                self.kill()
                os.waitpid(self.pid, 0)
                raise TimeoutError(f"a process took more than {TIME_LIMIT:g} s")
            time.sleep(0.002)
        while part := os.read(self._pipe, 4096):
            told += part
        os.close(self._pipe)
        return os.waitstatus_to_exitcode(status), np.frombuffer(told)


def contents(path):
    """Every dataset of a result, read without tribo."""
    with h5py.File(path) as file:
        return {name: dataset[()] for name, dataset in file.items()}


def same(first, second):
    """Whether two results hold the same bits."""
    return first.keys() == second.keys() and all(
        # Densities that are not given are NaN.
        np.array_equal(first[name], second[name], equal_nan=first[name].dtype.kind == "f")
        for name in first
    )


def whole(folder):
    """Make the run that nothing disturbs; in this process, so that those forked off find the
    modules and hashes that it needed."""
    path = Path(folder) / "whole.h5"
    simulation().run(path).close()
    return path
