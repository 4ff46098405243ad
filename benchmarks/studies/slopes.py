"""Slopes of a few values by a few numbers: exact ones, value by value, or differences of runs.

    python -m benchmarks.studies.slopes [cells]

Of each case it prints CPU times in those of a run: of the run that is gone back through, and of a
pass back for each value. Then slopes, in per cent for one per cent: exact, and by differences where
the number is raised by a fifth, as `tribo calibrate` does.
"""

from __future__ import annotations

import sys
import warnings
from contextlib import closing
from time import process_time

import numpy as np
from tribo_inverse import Depth, Volume
from tribo_inverse.adjoint.backwards import swept_back
from tribo_inverse.adjoint.numbers import changed, find
from tribo_inverse.adjoint.parameters import chain
from tribo_inverse.adjoint.view import View
from tribo_inverse.calibration.fit import STEP
from tribo_inverse.recording.tape import Tape, recorded

from benchmarks.studies.gradient_cost import cases
from tribo import Case, TriboWarning
from tribo.simulation.march import begin, march
from tribo.simulation.run import Simulation

VALUES = {
    f"{name} of the {body}": kind(body)
    for name, kind in (("volume", Volume), ("depth", Depth))
    for body in ("ball", "disk")
}


def exact(case: Case, paths: list[str]) -> tuple[np.ndarray, list[float]]:
    """Return the slopes of all values by all numbers, and the times of the run and the passes."""
    model = Simulation(case).model
    chains = [chain(model, *number, {}) for number in find(case, paths)]
    slopes, times = [], [process_time()]
    with closing(Tape(model)) as tape:
        end = recorded(model, [model.end_time], tape)[model.end_time]
        times.append(process_time())
        for value in VALUES.values():
            number, seeds = value(View(model, end))
            through = swept_back(model, tape, {model.end_time: seeds}, chains).parameters
            direct = [
                sum(by * (value(View(each.model, end))[0] - number) for by, each in one.variants)
                for one in chains
            ]
            scale = [one.value / number for one in chains]
            slopes.append((np.array(through) + direct) * scale)
            times.append(process_time())
    return np.array(slopes), list(np.diff(times))


def values(case: Case) -> np.ndarray:
    """Return the logarithms of all values of a run."""
    model = Simulation(case).model
    *_, last = march(model, begin(model))
    return np.log([value(View(model, last.state))[0] for value in VALUES.values()])


def differences(case: Case, paths: list[str]) -> np.ndarray:
    """Return the slopes by a run more for each number."""
    base, columns = values(case), []
    for path, places, value in find(case, paths):
        moved = changed(case, path, places, value * float(np.exp(STEP)))
        columns.append((values(moved) - base) / STEP)
    return np.stack(columns, axis=1)


def main(cells: int) -> None:
    """Print times and slopes of each case."""
    warnings.simplefilter("ignore", TriboWarning)
    for name, case in cases(cells).items():
        wear = case.bodies["ball"].wear
        law = "law." if hasattr(wear, "law") else ""
        paths = [f"bodies.{body}.wear.{law}k" for body in ("ball", "disk")]
        if wear.type == "power":
            paths += [f"bodies.{body}.wear.p_exponent" for body in ("ball", "disk")]
        else:
            paths += ["load.normal", "bodies.ball.material.young"]
        case.run()
        started = process_time()
        case.run()
        run = process_time() - started
        slopes, (record, *passes) = exact(case, paths)
        told = " ".join(f"{each / run:.2f}" for each in passes)
        print(f"\n{name}, {cells}²: run {run:.2f} s, recorded {record / run:.2f}, back {told}")
        for what, own, other in zip(VALUES, slopes, differences(case, paths), strict=True):
            pairs = [f"{one:+.4f} {two:+.4f}" for one, two in zip(own, other, strict=True)]
            print(f"{what:20}", "   ".join(pairs))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
