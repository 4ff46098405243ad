"""Feed tribo cases and files made at random, and see how each ends.

PYTHONPATH=tests python -m fuzz.fuzzing --count 10000 --seed 1
PYTHONPATH=tests python -m fuzz.fuzzing --only 4711 --seed 1
"""

import argparse
import sys
import time
from collections import Counter
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field

from fuzz import trial

from tribo.study.sweeping.executors import processes

HANG = 120.0
"""Time after which a case that does not heed being stopped is said to hang, in s."""


@dataclass
class Fuzz:
    """How the cases ended."""

    codes: Counter = field(default_factory=Counter)
    """How many ended with which exit code."""
    faults: dict = field(default_factory=dict)
    """What must not be, by the number of the case."""
    slowest: float = 0.0
    """In s."""
    seconds: float = 0.0

    @property
    def good(self):
        return not self.faults

    def figures(self):
        """Return the figures by name."""
        return {
            "cases": self.codes.total(),
            "exit codes": {str(code): self.codes[code] for code in sorted(self.codes)},
            "faults": len(self.faults),
            "deaths": sum(fault.startswith("death") for fault in self.faults.values()),
            "slowest, s": round(self.slowest, 2),
            "in all, s": round(self.seconds),
        }

    def __str__(self):
        lines = [f"case {number}: {fault}" for number, fault in sorted(self.faults.items())]
        return "\n".join([*lines, *(f"{k}: {v}" for k, v in self.figures().items())])


def fuzz(count, seed, *, workers=None, numbers=None):
    """Try `count` cases of `seed`, or the cases of these numbers; TimeoutError if one hangs."""
    done, begun = Fuzz(), time.monotonic()
    numbers = range(count) if numbers is None else numbers
    with processes(workers) as executor:
        futures = {number: executor.submit(trial.timed, number, seed) for number in numbers}
        for number, future in futures.items():
            try:
                code, fault, seconds = future.result(HANG)
            except BrokenProcessPool:
                code, fault, seconds = -1, "death: the process ended", 0.0
            except TimeoutError:
                raise TimeoutError(f"case {number} takes more than {HANG:g} s") from None
            done.codes[code] += 1
            done.slowest = max(done.slowest, seconds)
            if fault is not None:
                done.faults[number] = fault
    done.seconds = time.monotonic() - begun
    return done


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
