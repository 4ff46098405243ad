"""What a run takes of memory, and that too large a case is refused before it takes any."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path
from unittest.mock import Mock

import pytest
from paper_models import archard, flat, named, small, steel

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.surfaces.forms import Sphere

TESTS = Path(__file__).parents[1]
MEASURE = """
    import json, os, sys, warnings
    from paper_models import *
    from tribo.simulation.memory import memory_needed
    from tribo.simulation.run import Simulation
    warnings.simplefilter("ignore")
    # Imported when they are first used, and no part of what a case takes.
    import h5py, scipy.fft, scipy.ndimage, scipy.optimize
    cells = 128
    for case in sys.argv[1:]:
        if not os.fork():
            break
        assert os.wait()[1] == 0
    else:
        sys.exit()
    parts = dict(grid=Grid((1.3e-3, 1.3e-3), (cells, cells)), kinematics=motion(duration=0.5))
    if case == "plastic":
        bodies = [named(n, s(), steel("4 GPa"), archard()) for n, s in (("a", sphere), ("b", flat))]
        parts |= dict(bodies=bodies, load=900.0)
    if case == "flat punch":
        bodies = [named(n, flat(), steel(), archard()) for n in "ab"]
        parts |= dict(bodies=bodies, ends_at_window=True)
    if case == "resolved":
        parts["kinematics"] = motion(stroke="1.1 mm", duration=0.2, positions=17)
    def most():
        # Not ru_maxrss, which begins with that of the process this one was forked from.
        lines = open("/proc/self/status").read().splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))
    first = most()
    model = small(**parts)
    Simulation(model.case).run(case + ".h5").close()
    peak = most()
    needed = memory_needed(model.case, len(model.cycle))
    print(json.dumps([1024 * (peak - first), needed]))
"""


@pytest.mark.slow
def test_the_estimate_is_above_the_peak_and_not_far(tmp_path):
    cases = ["ball", "plastic", "flat punch", "resolved"]
    script = [sys.executable, "-c", textwrap.dedent(MEASURE), *cases]
    # Loading a compiler takes more than such small cases.
    paths = {**os.environ, "PYTHONPATH": str(TESTS), "TRIBO_FAST": "0"}
    done = subprocess.run(
        script, cwd=tmp_path, env=paths, capture_output=True, text=True, check=True
    )
    for case, line in zip(cases, done.stdout.splitlines(), strict=True):
        peak, needed = json.loads(line)
        # A contact that fills the window comes near; one that does not may still grow to.
        assert (0.5 if case == "flat punch" else 0.25) * needed < peak < needed, case


def test_more_than_the_machine_has_is_refused_with_the_estimate(monkeypatch):
    monkeypatch.setattr("psutil.virtual_memory", lambda: Mock(total=2**28))
    small(grid=Grid((0.7e-3, 0.7e-3), (64, 64)))
    with pytest.raises(CaseError, match=r"^grid\.cells: .* 13\.6 GiB .* 0\.25 GiB"):
        small(grid=Grid((0.7e-3, 0.7e-3), (4000, 4000)))


def test_running_out_of_memory_all_the_same_is_one_message():
    class Huge(Sphere):
        def height(self, grid):
            raise MemoryError

    surface = Huge(radius="5 mm")
    with pytest.raises(Exception, match=r"surface 'sphere' .*ran out of memory; lower grid\.cells"):
        small(bodies=[named("ball", surface, steel(), archard()), named("disk", flat(), steel())])
