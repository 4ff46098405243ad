"""Let runs meet a full disk, make room, and go on with them."""

import random
import resource
import warnings
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest import mock

from trust.trial import Acknowledge, contents, same, simulation, whole

import tribo.simulation.run
from tribo import OutputError, Result
from tribo.observers.recorder import Recorder


@dataclass
class FullDisks:
    """What became of the runs that met a full disk; whatever else comes out of one is raised."""

    stopped: int = 0
    finished: int = 0
    """There was room enough."""
    not_begun: int = 0
    """There was no room for the first save."""
    identical: int = 0
    lost_saves: int = 0

    @property
    def good(self):
        return self.stopped == self.identical > 0 and not self.lost_saves


def fill_and_resume(count, seed):
    """Stop `count` runs by less room than they need, which is a limit on the size of a file."""
    disks, chance = FullDisks(), random.Random(seed)
    # A checkpoint at every step.
    often = partial(Recorder, checkpoint_every=0.0)
    with (
        TemporaryDirectory() as folder,
        mock.patch.object(tribo.simulation.run, "Recorder", often),
        warnings.catch_warnings(action="ignore"),
    ):
        path = whole(folder)
        undisturbed, most = contents(path), path.stat().st_size
        while disks.stopped < count:
            # A part is smaller than the result.
            room = chance.randrange(most // 2, most)
            _one(Path(folder) / "run.h5", room, undisturbed, disks)
    return disks


def _one(path, room, undisturbed, disks):
    told = []
    saves = Acknowledge(tell=told.append)
    try:
        with limited(room):
            simulation().run(path, observers=[saves], overwrite=True).close()
    except OutputError:
        disks.stopped += bool(told)
        disks.not_begun += not told
    else:
        disks.finished += 1
    if told and path.with_name("run.h5.run").exists():
        with Result.open(path) as result:
            disks.lost_saves += len({*told} - {*result.times})
        simulation().resume(path).close()
        disks.identical += same(contents(path), undisturbed)
    path.unlink(missing_ok=True)


@contextmanager
def limited(room):
    """Let no file grow beyond so many bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
