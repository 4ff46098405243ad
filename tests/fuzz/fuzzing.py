"""Feed tribo cases and files made at random, and see how each ends.

PYTHONPATH=tests python -m fuzz.fuzzing --count 10000 --seed 1
PYTHONPATH=tests python -m fuzz.fuzzing --only 4711 --seed 1
"""

import argparse
import multiprocessing.connection
import os
import sys
import time
from collections import Counter
from dataclasses import dataclass, field
from importlib.util import find_spec
from tempfile import TemporaryDirectory

from fuzz import trial

HANG = 30.0
"""Time after which a case that does not heed being stopped is said to hang, in s."""
START = "spawn"


@dataclass
class Fuzz:
    """How the cases ended."""

    counts: Counter = field(default_factory=Counter)
    """How many ended how, by (kind, exit code)."""
    faults: dict = field(default_factory=dict)
    """What must not be, by the number of the case."""
    hangs: int = 0
    deaths: int = 0
    slowest: float = 0.0
    """In s."""
    seconds: float = 0.0
    stopped: bool = False
    """Whether it was, before all cases were tried."""

    @property
    def good(self):
        return not (self.faults or self.stopped)

    def figures(self):
        """Return the figures by name."""
        codes = Counter()
        for (_, code), count in self.counts.items():
            codes[code] += count
        return {
            "cases": sum(codes.values()),
            "exit codes": {str(code): codes[code] for code in sorted(codes)},
            "faults": len(self.faults),
            "hangs": self.hangs,
            "deaths": self.deaths,
            "slowest, s": round(self.slowest, 2),
            "in all, s": round(self.seconds),
        }

    def __str__(self):
        lines = [f"{kind:10}exit {code:<5}{n}" for (kind, code), n in sorted(self.counts.items())]
        lines += [f"case {number}: {fault}" for number, fault in sorted(self.faults.items())]
        return "\n".join([*lines, *(f"{k}: {v}" for k, v in self.figures().items())])


class Worker:
    """A process that tries one case after another, replaced where it hangs or dies."""

    def __init__(self, context, seed):
        self._context, self._seed = context, seed
        self._folder = TemporaryDirectory()
        self.number = None
        self._start()

    def _start(self):
        self.pipe, far = self._context.Pipe()
        arguments = (far, self._seed, self._folder.name)
        self._process = self._context.Process(target=work, args=arguments, daemon=True)
        self._process.start()
        far.close()

    def give(self, number):
        self.number, self._end = number, time.monotonic() + HANG
        self.pipe.send(number)

    def answer(self):
        """Return (kind, code, fault, time) of the case, or None while it is tried."""
        kind = trial.KINDS[self.number % len(trial.KINDS)]
        if self.pipe.poll():
            try:
                return self.pipe.recv()
            except EOFError:
                self._process.join()
                died = self._process.exitcode
                self._start()
                return kind, died, f"death: the process ended with {died}", 0.0
        if time.monotonic() > self._end:
            self._process.kill()
            self._process.join()
            self._start()
            return kind, -9, f"hang: more than {HANG:g} s", HANG
        return None

    def stop(self):
        self._process.kill()
        self._process.join()
        self._folder.cleanup()


def work(pipe, seed, folder):
    """Try cases until there are none, in a process of its own."""
    trial.prepare()
    os.chdir(folder)
    while True:
        number = pipe.recv()
        answer = trial.timed(number, seed, folder)
        trial.clean(folder)
        pipe.send(answer)


def fuzz(count, seed, *, workers=None, numbers=None):
    """Try `count` cases of `seed`, or those of certain numbers."""
    fuzz, begun = Fuzz(), time.monotonic()
    waiting = iter(numbers if numbers is not None else range(count))
    context = multiprocessing.get_context(START)
    pool = [Worker(context, seed) for _ in range(workers or os.cpu_count() or 1)]
    try:
        busy = [worker for worker in pool if _next(worker, waiting)]
        while busy:
            multiprocessing.connection.wait([worker.pipe for worker in busy], 0.5)
            for worker in list(busy):
                answer = worker.answer()
                if answer is None:
                    continue
                _add(fuzz, worker.number, *answer)
                if not _next(worker, waiting):
                    busy.remove(worker)
    except KeyboardInterrupt:
        fuzz.stopped = True
        print("stopped; what was tried so far:", file=sys.stderr)
    finally:
        for worker in pool:
            worker.stop()
    fuzz.seconds = time.monotonic() - begun
    return fuzz


def _next(worker, waiting):
    number = next(waiting, None)
    if number is not None:
        worker.give(number)
    return number is not None


def _add(fuzz, number, kind, code, fault, seconds):
    fuzz.counts[kind, code] += 1
    fuzz.slowest = max(fuzz.slowest, seconds)
    if fault is not None:
        fuzz.faults[number] = fault
        fuzz.hangs += fault.startswith("hang")
        fuzz.deaths += fault.startswith("death")


def check_needs(parser):
    """Leave, with what to install, before anything starts that could not end."""
    if find_spec("SurfaceTopography") is None:
        parser.error(
            "SurfaceTopography is not installed, which surface files are read with; run: pip "
            "install -r requirements-dev.txt"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, help="the number of one case")
    given = parser.parse_args()
    check_needs(parser)
    numbers = None if given.only is None else [given.only]
    done = fuzz(given.count, given.seed, numbers=numbers)
    print(done)
    sys.exit(not done.good)


if __name__ == "__main__":
    main()
