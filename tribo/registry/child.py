"""Calls that might end this process, or never end, in a process of their own."""

from __future__ import annotations

import faulthandler
import io
import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from tempfile import TemporaryFile
from typing import Any

TIMES = 30
"""CPU time of a call over the import of tribo, which takes 0.6 s: the import of SciPy takes 1."""

_LATE = -getattr(signal, "SIGPROF", 0) or None
_CHILD = f"from {__name__} import answer; answer()"


def in_child(
    function: Callable[..., Any], calls: Sequence[tuple[Any, ...]]
) -> tuple[list[Any], str]:
    """Return what some calls of a function return, and how its process ended if not well.

    Each may take 30 times the CPU time of tribo's own import, and wait ten times as long. Where no
    process can be started, or it cannot import what it is sent, the function is called in this one.
    """
    # The child finds what this process would find.
    path = os.pathsep.join(each or os.getcwd() for each in sys.path)
    # To a file: what a plugin starts may outlive the child, and would hold a pipe open.
    with TemporaryFile() as answers:
        try:
            code = subprocess.run(
                [sys.executable, "-P", "-c", _CHILD],
                input=pickle.dumps((TIMES, pickle.dumps((function, calls)))),
                stdout=answers,
                stderr=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": path},
                check=False,
            ).returncode
        except (OSError, pickle.PicklingError, AttributeError, TypeError):
            return [function(*given) for given in calls], ""
        answers.seek(0)
        came, rest = _loaded(answers.read())
    if came == [False]:
        return [function(*given) for given in calls], ""
    if code == _LATE or rest.startswith(b"Timeout"):
        return came[1:], f"did not end within {TIMES} times the CPU time of tribo's own import"
    return came[1:], _how(code)


def answer() -> None:
    """Answer in this process what `in_child` sends it."""
    times, sent = pickle.loads(sys.stdin.buffer.read())
    answers = os.fdopen(os.dup(1), "wb", buffering=0)
    # What a model prints goes elsewhere.
    os.dup2(2, 1)
    try:
        function, calls = pickle.loads(sent)
    except Exception:
        pickle.dump(False, answers)
        return
    pickle.dump(True, answers)
    # What this process has done so far is the import of tribo.
    cpu = times * time.process_time()
    for given in calls:
        _end_after(cpu, answers)
        answers.write(pickle.dumps(function(*given)))


def _end_after(cpu: float, answers: Any) -> None:
    """Let this process end, without a core dump, after so many s of CPU time, or ten times that.

    Windows has no clock of CPU time.
    """
    faulthandler.dump_traceback_later(10 * cpu, exit=True, file=answers)
    if sys.platform != "win32":
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.setitimer(signal.ITIMER_PROF, cpu)


def _loaded(data: bytes) -> tuple[list[Any], bytes]:
    """Return what was written whole, and the rest."""
    file, came, end = io.BytesIO(data), [], 0
    try:
        while True:
            came.append(pickle.load(file))
            end = file.tell()
    except (EOFError, pickle.UnpicklingError):
        return came, data[end:]


def _how(code: int) -> str:
    """Word how a process with an exit code ended; empty if well."""
    if code < 0:
        known = {number.value: number.name for number in signal.Signals}
        return f"crashed the process ({known.get(-code, f'signal {-code}')})"
    return f"ended the process with exit code {code}" if code else ""
