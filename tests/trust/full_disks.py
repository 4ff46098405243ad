"""Let runs meet a full disk, make room, and go on with them."""

import random
import resource
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from trust.trial import contents, resume, run, same, start, whole

from tribo import Result

OUTPUT_ERROR = 3


@dataclass
class FullDisks:
    """What became of the runs that met a full disk."""

    stopped: int = 0
    finished: int = 0
    """There was room enough."""
    not_begun: int = 0
    """There was no room for the first save."""
    identical: int = 0
    other_exits: int = 0
    lost_saves: int = 0
    different: int = 0

    @property
    def good(self):
        return self.stopped == self.identical > 0 and not (self.other_exits + self.lost_saves)


def fill_and_resume(count, seed):
    """Stop `count` runs by less room than they need, which is a limit on the size of a file."""
    disks = FullDisks()
    chance = random.Random(seed)
    with TemporaryDirectory() as folder:
        path = whole(folder)
        undisturbed, most = contents(path), path.stat().st_size
        while disks.stopped + disks.other_exits < count:
            # A part is smaller than the result.
            room = chance.randrange(most // 2, most)
            _one(Path(folder) / "run.h5", room, undisturbed, disks)
    return disks


def _one(path, room, undisturbed, disks):
    path.unlink(missing_ok=True)
    code, told = start(limited(room), path).wait()
    if code == 0:
        disks.finished += 1
        return
    if code != OUTPUT_ERROR:
        disks.other_exits += 1
        return
    if len(told) == 0:
        disks.not_begun += 1
        return
    disks.stopped += 1
    with Result.open(path) as result:
        disks.lost_saves += len(set(told) - set(result.times))
    code, _ = start(resume, path).wait()
    if code == 0 and same(contents(path), undisturbed):
        disks.identical += 1
    else:
        disks.different += 1


def limited(room):
    """Return `run` in which no file may grow beyond `room` bytes."""

    def worked(path, pipe):
        hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))
        run(path, pipe)

    return worked
