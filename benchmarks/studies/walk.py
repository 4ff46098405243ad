"""How much of tribo a run passes through: functions to the first solve, calls in a step.

functions
    Distinct functions of tribo's own that are called from ``tribo run case.toml`` until the first
    contact solve begins.
calls, files
    Calls of tribo's own functions in one implicit step of the paper's case, what guards the models
    included and the contact solve left out, and the files that they are in.

Run it with ``python -m benchmarks.studies.walk``; it counts, so it gives the same numbers on any
machine.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from inspect import CO_OPTIMIZED
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import tribo

ROOT = str(Path(tribo.__file__).parent)
SOLVE = "solve_together"


class Reached(BaseException):
    """The first solve begins."""


@contextmanager
def called(*, until_solve: bool = False) -> Iterator[Counter[CodeType]]:
    """Count the calls of tribo's own functions outside solves; stop at the first solve if told."""
    counts: Counter[CodeType] = Counter()
    depth = 0

    def profile(frame: FrameType, event: str, _: Any) -> None:
        nonlocal depth
        code = frame.f_code
        # The bodies of classes and modules are no functions.
        function = code.co_flags & CO_OPTIMIZED and not code.co_name.startswith("<")
        if not (function and code.co_filename.startswith(ROOT)):
            return
        if event == "call":
            if until_solve and code.co_name == SOLVE:
                raise Reached
            depth += code.co_name == SOLVE
            if depth == 0:
                counts[code] += 1
        elif event == "return" and code.co_name == SOLVE:
            depth -= 1

    sys.setprofile(profile)
    try:
        yield counts
    finally:
        sys.setprofile(None)


def to_the_first_solve(folder: Path) -> int:
    """Return how many functions ``tribo run`` calls until it solves a contact."""
    from tribo.cli.main import tribo as command
    from tribo.core.errors import PluginError
    from tribo.templates import template

    case = folder / "case.toml"
    case.write_text(template("ball_on_disk"), encoding="utf-8")
    with called(until_solve=True) as counts:
        try:
            command(["run", str(case)], standalone_mode=False)
        except PluginError:
            # The guard of the solver takes `Reached` for an error of the solver.
            return len(counts)
    raise LookupError(f"no function is called {SOLVE} any more")


def of_a_step(folder: Path) -> tuple[int, int]:
    """Return the calls in an implicit step of the paper's case, and the files they are in."""
    from tribo import Simulation, load_case
    from tribo.simulation.march import begin, march

    case = load_case(folder / "case.toml", overrides=["grid.cells=64", "grid.size='1.3 mm'"])
    model = Simulation(case).model
    steps = march(model, begin(model))
    take: Callable[[], object] = lambda: next(steps)  # noqa: E731
    for _ in range(3):
        take()
    with called() as counts:
        take()
    return sum(counts.values()), len({code.co_filename for code in counts})


if __name__ == "__main__":
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as made:
        print(f"functions until the first solve: {to_the_first_solve(Path(made))}")
        calls, files = of_a_step(Path(made))
        print(f"one implicit step: {calls} calls in {files} files")
