"""Kill runs at random moments and go on with them."""

import random
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from trust.damages import flip
from trust.trial import contents, dying, resume, run, same, start, whole

from tribo import CaseError, Result
from tribo.result.checkpoint import RunFolder

WRITES = 60
"""About as many writes as a run makes."""


@dataclass
class Kills:
    """What became of the runs that were killed."""

    killed: int = 0
    finished: int = 0
    """Done before the signal came."""
    checkpoints_damaged: int = 0
    """Had their newest checkpoint damaged after the kill, and went on from the one before."""
    identical: int = 0
    lost_saves: int = 0
    unreadable: int = 0
    not_resumed: int = 0
    different: int = 0
    left_over: int = 0
    """Files that a finished run leaves behind."""
    other_exits: int = 0
    """Runs that ended by themselves, and badly."""

    @property
    def good(self):
        bad = self.lost_saves + self.unreadable + self.left_over + self.other_exits
        return self.killed == self.identical and not bad


def kill_and_resume(count, seed):
    """Kill `count` runs, each at a moment of its own, and resume each.

    Every other one dies in the middle of a write, and half of them once more as they go on. A
    bit of the newest checkpoint is flipped in every other one that has two.
    """
    kills = Kills()
    chance = random.Random(seed)
    with TemporaryDirectory() as folder:
        undisturbed = contents(whole(folder))
        begun = time.monotonic()
        start(run, Path(folder) / "run.h5").wait()
        duration = time.monotonic() - begun
        while kills.killed + kills.other_exits < count:
            _one(Path(folder) / "run.h5", chance, duration, undisturbed, kills)
    return kills


def _one(path, chance, duration, undisturbed, kills):
    acknowledged, code = _killed(run, path, chance, duration, kills.killed % 2)
    if code == 0:
        kills.finished += 1
        return
    if code > 0:
        kills.other_exits += 1
        return
    if not acknowledged:
        # It had not begun to save: there is nothing to lose or to go on with.
        return
    kills.killed += 1
    while code != 0:
        kills.unreadable += not _readable(path)
        kills.lost_saves += len(set(acknowledged) - set(_times(path)))
        if code > 0:
            kills.not_resumed += 1
            return
        if not RunFolder(path).path.exists():
            # It was done.
            break
        if chance.random() < 0.5 and _damaged(path, chance):
            kills.checkpoints_damaged += 1
            # What the newest had is computed again, as long as it is not killed before.
            acknowledged = _times(path)
        if chance.random() < 0.5:
            told, code = _killed(resume, path, chance, duration, kills.killed % 2)
        else:
            code, told = start(resume, path).wait()
        acknowledged += list(told)
    kills.left_over += len(list(path.parent.glob(path.name + ".*")))
    if same(contents(path), undisturbed):
        kills.identical += 1
    else:
        kills.different += 1


def _killed(work, path, chance, duration, writing):
    """Kill a process that does `work`; return the saves it told of, and how it ended."""
    if writing:
        child = start(dying(work, chance.randrange(WRITES)), path)
    else:
        child = start(work, path)
        time.sleep(chance.uniform(0, 0.7 * duration))
        child.kill()
    code, told = child.wait()
    return list(told), code


def _damaged(path, chance):
    """Flip a bit of the newest of two checkpoints; return whether there are two."""
    folder = RunFolder(path)
    if not (folder.checkpoint.exists() and folder.previous.exists()):
        return False
    data = bytearray(folder.checkpoint.read_bytes())
    flip(data, chance)
    folder.checkpoint.write_bytes(data)
    return True


def _times(path):
    with Result.open(path) as result:
        return list(result.times)


def _readable(path):
    try:
        Result.open(path).dataset.load()
    except CaseError as error:
        print(error, file=sys.stderr)
        return False
    return True
