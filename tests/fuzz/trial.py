"""One fuzzed case, as a user would meet it: a command line, and what came of it."""

import os
import random
import runpy
import signal
import time
import warnings
from contextlib import chdir
from copy import deepcopy
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import psutil
from command_line import tribo
from fuzz.generate import PARTS, ROOT, damaged, mutated, plausible, small, valid_cases
from trust.trial import contents, same

from tribo import Result
from tribo.core.rounding import SAME
from tribo.core.toml import to_toml as toml
from tribo.result.summary import worst
from tribo.stepping.invariants import CONDITIONS

DOCUMENTED = {0, 2, 3, 130}
LIMITS = {
    "force_error": SAME,
    "complementarity_error": CONDITIONS,
    "penetration_error": CONDITIONS,
    "volume_error": SAME,
    "regrowth_m": 0.0,
}
PATIENCE = 3.0
"""Time of the processor after which a command is told to stop, in s, as Ctrl-C does."""
MEMORY = 2**30
"""What a case may take, in bytes, beyond what the process has."""
KINDS = (
    *("mutated", "mutated", "plausible", "plausible", "plausible"),
    *("text", "override", "surface", "stop"),
)
FORMATS = ("opd", "x3p", "asc", "npy")


@cache
def prepare():
    """Get ready once in a new process: modules, a memory limit, no warnings as errors."""
    warnings.simplefilter("ignore")
    # A shell may have set it to be ignored, and workers ignore it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    # Not while a case is told to stop, which would leave half a module.
    import SurfaceTopography  # noqa: F401

    process = psutil.Process()
    limit = process.memory_info().vms + MEMORY
    process.rlimit(psutil.RLIMIT_AS, (limit, process.rlimit(psutil.RLIMIT_AS)[1]))


def timed(number, seed):
    """Make case `number` of `seed` in a folder of its own, and try it.

    Returns its exit code, its fault and the time that it took, in s. The fault is None, or says
    what must not be; whatever comes out is one.
    """
    prepare()
    begun = time.monotonic()
    chance = random.Random(f"{seed}/{number}")
    kind = KINDS[number % len(KINDS)]
    with TemporaryDirectory() as folder, chdir(folder):
        try:
            code, fault = globals()[f"_{kind}"](Path("case.toml"), chance)
        except BaseException as error:
            code, fault = -1, f"traceback: {type(error).__name__}: {error}"
    return code, fault, time.monotonic() - begun


@cache
def sound(name):
    """Return the bytes of a valid surface, by its format."""
    made = runpy.run_path(str(ROOT / "plugins/tribo-topography/tests/conftest.py"))
    heights = 1e-7 * np.random.default_rng(1).standard_normal((24, 20))
    path = Path(f"sound.{name}")
    made["WRITERS"][name](path, heights, (1e-3, 1e-3))
    return path.read_bytes()


def _plausible(path, chance):
    path.write_text(toml(plausible(chance.choice(valid_cases()), chance)))
    return _tried(path, chance)


def _mutated(path, chance):
    case = small(chance.choice(valid_cases()), chance)
    path.write_text(toml(mutated(case, chance)))
    return _tried(path, chance)


def _text(path, chance):
    case = small(chance.choice(valid_cases()), chance)
    path.write_bytes(damaged(toml(case).encode(), chance))
    return _tried(path, chance)


def _override(path, chance):
    path.write_text(toml(small(chance.choice(valid_cases()), chance)))
    words = ("load.normal", "grid", "bodies.ball.wear.k", "contact.type", "stop.depth", "a.b", "")
    values = ("1", "-1 N", "winkler", "nan", "[1", "{a=1}", '"', "1e3 µm", "")
    sets = [f"{chance.choice(words)}{chance.choice('==. ')}{chance.choice(values)}" for _ in "ab"]
    return _tried(path, chance, "--set", sets[0], "--set", sets[1])


def _surface(path, chance):
    form = chance.choice(FORMATS)
    scan = path.with_name(f"scan.{form}")
    scan.write_bytes(damaged(sound(form), chance))
    case = _tiny(chance)
    case["bodies"]["ball"]["surface"] = {"type": "topography.file", "path": scan.name}
    if form in ("npy", "asc"):
        case["bodies"]["ball"]["surface"] |= {"size": [1e-3, 1e-3], "unit": "1 m"}
    case["grid"] |= {"size": 0.5e-3, "ends_at_window": True}
    path.write_text(toml(case))
    return _tried(path, chance)


def _stop(path, chance):
    """Stop a run at any moment, and go on to the bits of one that was not stopped."""
    case = _tiny(chance)
    case["grid"]["cells"], case["kinematics"]["duration"] = 24, 300
    path.write_text(toml(case))
    code, text = _command("run", str(path), "-o", "whole.h5", "--force")
    if code != 0:
        return _judged(code, text)
    output = path.with_name("stopped.h5")
    code, text = _command(
        "run", str(path), "-o", str(output), "--force", patience=chance.uniform(1e-3, 0.8)
    )
    patience = 0.2
    while code == 130 and output.exists():
        patience *= chance.uniform(1, 2)
        code, text = _command("resume", str(output), patience=patience)
    code, fault = _judged(code, text)
    # It may have been done, and stopped as it printed what it found.
    done = code == 0 or "is done; there is nothing to resume" in text
    if done and not same(contents("whole.h5"), contents(output)):
        fault = "what was stopped and gone on with has other bits"
    return code, fault


def _tiny(chance):
    case = small(valid_cases()[0], chance)
    case["grid"] |= {"size": 0.7e-3, "cells": 16}
    case["kinematics"]["duration"], case["output"] = 20, {"save_times": [5]}
    if chance.random() < 0.5:
        case["load"] = deepcopy(chance.choice(PARTS["load"][:2]))
    return case


def _tried(path, chance, *options):
    """Check a case, or run it and hold the result to what must be true of it."""
    if chance.random() < 0.05:
        return _judged(*_command("check", str(path), *options))
    output = path.with_suffix(".h5")
    output.unlink(missing_ok=True)
    code, fault = _judged(*_command("run", str(path), *options))
    if fault is None and code in (0, 130) and output.exists():
        fault = broken(output, code)
    return code, fault


def _command(*arguments, patience=PATIENCE):
    """Run a command as from the shell; return its exit code and what it wrote to stderr."""
    signal.signal(signal.SIGPROF, lambda *_: os.kill(os.getpid(), signal.SIGINT))
    signal.setitimer(signal.ITIMER_PROF, patience, 1.0)
    try:
        done = tribo(*arguments)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return done.returncode, done.stderr


def _judged(code, text):
    if code not in DOCUMENTED:
        return code, f"exit code {code}: {text.strip()[:400]}"
    # Python prints one of its own where Ctrl-C meets it in a callback.
    if ("Traceback" in text and "Exception ignored" not in text) or "internal error" in text:
        return code, f"traceback: {text.strip()[:400]}"
    if code in (2, 3) and not any(word in text for word in ("error: ", "Error: ")):
        return code, f"no message: {text.strip()[:400]}"
    return code, None


def broken(path, code):
    """Say what is not as it must be in a result, read back from its file."""
    with Result.open(path) as result:
        if code == 0 and result.status != "done":
            return f"status {result.status!r} after success"
        off, system = worst(result), result.system
        for name, most in LIMITS.items():
            if not off[name] <= most:
                return f"{name} is {off[name]:g}"
        for save, load in enumerate(result.table("saves")["load_N"]):
            carried = float(result.field("pressure", save).sum()) * system.grid.cell_area
            if not abs(carried / load - 1) <= SAME or result.field("pressure", save).min() < 0:
                return f"the pressure of save {save} carries {carried:g} N of {load:g} N"
        for name in result.body_names:
            body = result.body(name)
            fields = (body.height, body.wear_depth, body.plastic_depth, *body.state.values())
            if not all(np.isfinite(values).all() for values in fields):
                return f"a field of {name} is not finite"
            if np.diff(body.wear_depth, axis=0).min(initial=0) < 0:
                return f"{name} grows back between saves"
    return None
