"""Kill runs at random moments and go on with them.

PYTHONPATH=tests python -m trust.kills --count 100 --seed 1
"""

import argparse
import random
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from trust.trial import contents, dying, resume, run, same, start, whole

from tribo import CaseError, Result

WRITES = 700
"""About as many writes as a run makes."""


@dataclass
class Kills:
    """What became of the runs that were killed."""

    killed: int = 0
    finished: int = 0
    """Done before the signal came."""
    identical: int = 0
    lost_saves: int = 0
    unreadable: int = 0
    not_resumed: int = 0
    different: int = 0

    @property
    def good(self):
        return self.killed == self.identical


def kill_and_resume(count, seed):
    """Kill `count` runs, each at a moment of its own, and resume each.

    Every other one dies in the middle of a write, and half of them once more as they go on.
    """
    kills = Kills()
    chance = random.Random(seed)
    with TemporaryDirectory() as folder:
        begun = time.monotonic()
        undisturbed = contents(whole(folder))
        duration = time.monotonic() - begun
        while kills.killed < count:
            _one(Path(folder) / "run.h5", chance, duration, undisturbed, kills)
    return kills


def _one(path, chance, duration, undisturbed, kills):
    acknowledged, code = _killed(run, path, chance, duration, kills.killed % 2)
    if code == 0:
        kills.finished += 1
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
        if chance.random() < 0.5:
            told, code = _killed(resume, path, chance, duration, kills.killed % 2)
        else:
            code, told = start(resume, path).wait()
        acknowledged += list(told)
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
        time.sleep(chance.uniform(0, duration))
        child.kill()
    code, told = child.wait()
    return list(told), code


def _times(path):
    with Result.open(path) as result:
        return list(result.times)


def _readable(path):
    try:
        with Result.open(path) as result:
            result.check()
    except CaseError as error:
        print(error, file=sys.stderr)
        return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    kills = kill_and_resume(given.count, given.seed)
    print(kills)
    sys.exit(not kills.good)


if __name__ == "__main__":
    main()
