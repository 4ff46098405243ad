"""Feed tribo cases and files made at random, and see how each ends.

Case 4711 of seed 1 again: python -c "from fuzz import trial; print(trial.timed(4711, 1))", in
this folder's parent.
"""

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


def fuzz(count, seed, *, workers=None):
    """Try `count` cases of `seed`; TimeoutError if one hangs."""
    done, begun = Fuzz(), time.monotonic()
    with processes(workers) as executor:
        futures = {number: executor.submit(trial.timed, number, seed) for number in range(count)}
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
                print(f"case {number} of seed {seed}: {fault}", flush=True)
    done.seconds = time.monotonic() - begun
    return done
