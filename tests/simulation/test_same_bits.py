"""The same case gives the same bits: with any number of threads, from the shell, in a sweep, in
a fresh process and in one that goes on."""

import os
import subprocess
import sys

import edited
import pytest

from tribo import Result
from tribo.templates import template

pytestmark = pytest.mark.slow

SETTINGS = {
    "grid.cells": "48",
    "kinematics.duration": "8",
    "output.save_times": "[3]",
    "load.normal": "900",  # beyond the hardness: plastic flow takes part
}
SHELL = "from tribo.cli.main import main; main()"
STOPPED = """
import sys, warnings
from tribo import Simulation
from tribo.config.load import load_case
from tribo.observers.observer import Observer
warnings.simplefilter("ignore")
class Stop(Observer):
    type = "stop"
    def on_step(self, snapshot):
        if snapshot.state.steps == 7:
            raise KeyboardInterrupt
simulation = Simulation(load_case(sys.argv[1], overrides=sys.argv[2].split("|")))
try:
    simulation.run(sys.argv[3], observers=[Stop()])
except BaseException:
    pass
"""


def process(script, *arguments, threads):
    names = ("OMP", "OPENBLAS", "MKL", "NUMEXPR")
    limits = {f"{name}_NUM_THREADS": str(threads) for name in names}
    script = f"import scipy.fft\nwith scipy.fft.set_workers({threads}):\n" + "".join(
        f"    {line}\n" for line in script.strip().splitlines()
    )
    subprocess.run(
        [sys.executable, "-c", script, *map(str, arguments)],
        env={**os.environ, **limits},
        check=True,
        capture_output=True,
        timeout=120,
    )


def bits(path):
    with Result.open(path) as result:
        return edited.bits(result) | {"case": result.case_tables}


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("bits") / "case.toml"
    path.write_text(template("ball_on_disk"))
    return path


@pytest.fixture(scope="module")
def first(case):
    path = case.with_name("first.h5")
    process(SHELL, "run", case, "-o", path, *_options(), threads=1)
    return bits(path)


def _options():
    return [part for item in SETTINGS.items() for part in ("--set", "=".join(item))]


def _words():
    return "|".join("=".join(item) for item in SETTINGS.items())


def test_enough_is_compared(first):
    assert {"pressure", "wear_depth", "history_regrowth", "case"} <= set(first)
    assert len(first) > 40


def test_resumed_with_another_number_of_threads(case, first, tmp_path):
    path = tmp_path / "resumed.h5"
    process(STOPPED, case, _words(), path, threads=1)
    assert path.with_name("resumed.h5.run").exists()
    process(SHELL, "resume", path, threads=2)
    assert bits(path) == first


def test_sweep(case, first, tmp_path):
    settings = [part for each in SETTINGS.items() for part in ("--set", "=".join(each))]
    vary = ["--vary", "load.normal=[900]", "-o", tmp_path / "sweep", "--jobs", 1]
    process(SHELL, "sweep", case, *settings, *vary, threads=2)
    found = [bits(path) for path in (tmp_path / "sweep").rglob("*.h5")]
    assert found == [first]
