"""When compiled code is used, what says so, and what happens where it does not load."""

import json
import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import numpy as np
import pytest
from tribo import CaseError, HalfSpace, solve_bounded
from tribo.kernel_api import PeriodicHalfSpace, WornOperator

import tribo_fast
from tribo_fast.iterate import CompiledIterate, CompiledOperator, tried

ROOT = Path(__file__).parents[3]
SHAPE, SPACING = (16, 12), (1e-5, 1e-5)
SOLVE = """
import sys, warnings
import numpy as np
import tribo
grid = tribo.Grid("0.4 mm", 256)
gap = -tribo.Sphere(radius="5 mm").height(grid)
steel = tribo.HalfSpace(grid.cells, grid.spacing, modulus=115e9)
with warnings.catch_warnings(record=True, category=tribo.TriboWarning) as caught:
    warnings.simplefilter("always")
    for load in (5.0, 10.0):
        contact = tribo.solve_bounded(steel, gap, load)
sys.stdout.buffer.write(contact.pressure.tobytes())
print(*(each.message for each in caught), sep="\\n", file=sys.stderr, end="")
"""
WITHOUT = "import sys; sys.modules[{!r}] = None\n"


def process(script, **variables):
    done = subprocess.run(
        [sys.executable, "-c", script], env={**os.environ, **variables}, capture_output=True
    )
    assert done.returncode == 0
    return np.frombuffer(done.stdout), done.stderr.decode()


@pytest.mark.parametrize(
    ("first", "variables", "reason"),
    [
        (WITHOUT.format("numba"), {}, "numba"),
        (WITHOUT.format("rocket_fft"), {}, "rocket_fft"),
        ("", {"NUMBA_DISABLE_JIT": "1"}, "NotImplementedError"),
    ],
)
@pytest.mark.slow
def test_a_broken_compiler_leaves_solves_to_numpy_with_one_warning(first, variables, reason):
    known, _ = process(SOLVE, TRIBO_FAST="0")
    pressure, warned = process(first + SOLVE, **variables)
    assert (pressure == known).all()
    assert len(warned.splitlines()) == 1
    assert reason in warned


def test_compiled_code_that_answers_otherwise_is_refused(monkeypatch):
    monkeypatch.setattr(CompiledOperator, "apply", lambda operator, pressure: 1.01 * pressure)
    with pytest.raises(ArithmeticError, match="off by"):
        tried()


@pytest.mark.slow
def test_a_large_solve_is_compiled_unless_it_is_turned_off():
    (known, nothing), (pressure, _) = process(SOLVE, TRIBO_FAST="0"), process(SOLVE)
    assert nothing == ""
    assert not (pressure == known).all()
    assert pressure == pytest.approx(known, rel=0, abs=1e-12 * float(known.max()))


def test_it_takes_the_half_spaces_of_the_kernel_and_large_solves_only():
    class Own(HalfSpace):
        pass

    for cls in (HalfSpace, PeriodicHalfSpace):
        operator = cls(SHAPE, SPACING, 1e11)
        for each in (operator, WornOperator(operator, None)):
            assert tribo_fast.iterates(each, tribo_fast.FEWEST) is CompiledIterate
            assert tribo_fast.iterates(each, tribo_fast.FEWEST - 1) is None
    assert tribo_fast.iterates(Own(SHAPE, SPACING, 1e11), tribo_fast.FEWEST) is None


@pytest.mark.parametrize("threads", ["two", "-1", "1.5"])
def test_threads_are_a_number(threads, monkeypatch):
    monkeypatch.setenv("TRIBO_FAST", threads)
    monkeypatch.setattr(tribo_fast, "FEWEST", 0)
    with pytest.raises(CaseError, match="TRIBO_FAST"):
        solve_bounded(HalfSpace(SHAPE, SPACING, 1e11), np.zeros(SHAPE), 1.0)


@pytest.mark.parametrize("none", ["0", "00"])
def test_no_threads_turn_it_off(none, monkeypatch):
    monkeypatch.setenv("TRIBO_FAST", none)
    assert tribo_fast.iterates(HalfSpace(SHAPE, SPACING, 1e11), tribo_fast.FEWEST) is None
    assert tribo_fast.versions() == {}


def test_doctor_checks_it_against_numpy():
    _, well, detail = tribo_fast.check()
    assert well
    assert detail.startswith("off by")


@pytest.mark.slow
def test_doctor_states_in_json_why_it_does_not_load():
    script = (
        WITHOUT.format("numba")
        + "from tribo.cli.main import main; sys.argv[1:] = ['doctor', '--json']; main()"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True)
    assert done.returncode == 3
    (compiled,) = json.loads(done.stdout)["checks"]
    assert not compiled["ok"]
    assert "numba" in compiled["detail"]


def test_the_provenance_states_what_is_installed_unless_it_is_turned_off(monkeypatch):
    environment = "from tribo.result.provenance import environment; import sys\n"
    said = environment + "print(*environment()['packages'], file=sys.stderr)"
    (_, used), (_, not_used) = process(said), process(said, TRIBO_FAST="0")
    assert set(used.split()) - set(not_used.split()) == {"tribo-fast", "numba", "rocket-fft"}
    missing = metadata.PackageNotFoundError
    monkeypatch.setattr(metadata, "version", lambda name: (_ for _ in ()).throw(missing(name)))
    assert tribo_fast.versions() == {}


@pytest.mark.slow
def test_the_kernels_tests_of_contact_hold_where_all_solves_are_compiled(tmp_path):
    (tmp_path / "everywhere.py").write_text("import tribo_fast\ntribo_fast.FEWEST = 0\n")
    alone = ["-o", "addopts=--import-mode=importlib", "-p", "everywhere"]
    command = [sys.executable, "-m", "pytest", "-q", *alone]
    tests = [ROOT / "tests" / "contact", ROOT / "tests" / "stepping" / "test_resolved.py"]
    done = subprocess.run(
        [*command, "-p", "no:cacheprovider", *tests],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
