"""Feed tribo cases and files made at random, and see how each ends.

PYTHONPATH=tests python -m fuzz.fuzzing --count 10000 --seed 1
PYTHONPATH=tests python -m fuzz.fuzzing --only 4711 --seed 1
"""

import argparse
import multiprocessing
import os
import signal
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from queue import SimpleQueue
from tempfile import TemporaryDirectory

from fuzz import trial

HANG = 120.0
"""Time after which a case that does not heed being stopped is said to hang, in s."""
START = "spawn"


@dataclass
class Fuzz:
    """How the cases ended."""

    counts: Counter = field(default_factory=Counter)
    """How many ended how, by (kind, exit code)."""
    faults: dict = field(default_factory=dict)
    """What must not be, by the number of the case."""
    slowest: float = 0.0
    """In s."""
    seconds: float = 0.0
    stopped: bool = False
    """Whether it was, before all cases were tried."""

    @property
    def good(self):
        return not (self.faults or self.stopped)

    def add(self, number, code, fault, seconds):
        self.counts[trial.kind(number), code] += 1
        self.slowest = max(self.slowest, seconds)
        if fault is not None:
            self.faults[number] = fault

    def figures(self):
        """Return the figures by name."""
        codes = Counter()
        for (_, code), count in self.counts.items():
            codes[code] += count
        return {
            "cases": sum(codes.values()),
            "exit codes": {str(code): codes[code] for code in sorted(codes)},
            "faults": len(self.faults),
            "hangs": sum(fault.startswith("hang") for fault in self.faults.values()),
            "deaths": sum(fault.startswith("death") for fault in self.faults.values()),
            "slowest, s": round(self.slowest, 2),
            "in all, s": round(self.seconds),
        }

    def __str__(self):
        lines = [f"{kind:10}exit {code:<5}{n}" for (kind, code), n in sorted(self.counts.items())]
        lines += [f"case {number}: {fault}" for number, fault in sorted(self.faults.items())]
        return "\n".join([*lines, *(f"{k}: {v}" for k, v in self.figures().items())])


class Worker:
    """A process that tries one case after another, replaced where it hangs or dies."""

    def __init__(self):
        self._start()

    def _start(self):
        self._folder = TemporaryDirectory()
        context = multiprocessing.get_context(START)
        self._pool = ProcessPoolExecutor(1, context, trial.prepare, (self._folder.name,))
        self._pid = self._pool.submit(os.getpid).result()

    def tried(self, number, seed):
        """Return (exit code, fault, time) of a case."""
        try:
            return self._pool.submit(trial.timed, number, seed).result(HANG)
        except TimeoutError:
            os.kill(self._pid, signal.SIGKILL)
            fault = -9, f"hang: more than {HANG:g} s", HANG
        except BrokenProcessPool:
            fault = -1, "death: the process ended", 0.0
        self.stop()
        self._start()
        return fault

    def stop(self):
        self._pool.shutdown(cancel_futures=True)
        self._folder.cleanup()


def fuzz(count, seed, *, workers=None, numbers=None):
    """Try `count` cases of `seed`, or those of certain numbers."""
    fuzz, begun = Fuzz(), time.monotonic()
    waiting = list(numbers if numbers is not None else range(count))
    idle, threads = SimpleQueue(), workers or os.cpu_count() or 1

    def tried(number):
        worker = idle.get()
        try:
            return number, *worker.tried(number, seed)
        finally:
            idle.put(worker)

    for _ in range(threads):
        idle.put(Worker())
    pool = ThreadPoolExecutor(threads)
    try:
        for answer in pool.map(tried, waiting):
            fuzz.add(*answer)
    except KeyboardInterrupt:
        fuzz.stopped = True
        print("stopped; what was tried so far:", file=sys.stderr)
    finally:
        pool.shutdown(cancel_futures=True)
        for _ in range(threads):
            idle.get().stop()
    fuzz.seconds = time.monotonic() - begun
    return fuzz


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, help="the number of one case")
    given = parser.parse_args()
    numbers = None if given.only is None else [given.only]
    done = fuzz(given.count, given.seed, numbers=numbers)
    print(done)
    sys.exit(not done.good)


if __name__ == "__main__":
    main()
