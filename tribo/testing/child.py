"""A child process for calls that might end it, or never end."""

from __future__ import annotations

import atexit
import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from threading import Timer
from typing import Any

from tribo.registry.probe import how_it_ended, time_limit_of_plugins

_READY = b"ready"
TIME_LIMIT = 20.0
"""Seconds, of which a call may take three times as much."""


class Lost(Exception):
    """The process ended, or took too long; the text says how."""


class Unknown(Exception):
    """The process cannot find what it was sent, or it cannot be sent."""


class Child:
    """A process that makes calls, one after the other, and is begun again when it has ended."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def call(self, function: Callable[..., Any], *given: Any) -> Any:
        """Return the result of a function there; `Unknown` or `Lost` if it fails to return."""
        try:
            sent = pickle.dumps((function, given))
        except Exception as error:
            raise Unknown(str(error)) from error
        # A check may be some runs.
        limit = 3 * (time_limit_of_plugins() or TIME_LIMIT)
        process = self._process = self._process or _begin()
        assert process.stdin is not None
        assert process.stdout is not None
        late = Timer(limit, process.kill)
        late.start()
        try:
            pickle.dump(sent, process.stdin)
            process.stdin.flush()
            answer, fault = pickle.load(process.stdout)
        except (OSError, EOFError, pickle.UnpicklingError):
            code, self._process = process.wait(), None
            with suppress(OSError):
                process.stdin.close()
            process.stdout.close()
            how = (
                f"did not end within {limit:g} s" if late.finished.is_set() else how_it_ended(code)
            )
            raise Lost(f"it {how}") from None
        finally:
            late.cancel()
        if fault is not None:
            raise Unknown(fault)
        return pickle.loads(answer)

    def end(self) -> None:
        """End the process, if one runs."""
        if self._process is not None:
            self._process.kill()
            with self._process:  # Closes its pipes, and waits for it.
                pass


@cache
def child() -> Child:
    """Return the one child of this process."""
    made = Child()
    atexit.register(made.end)
    return made


def _begin() -> subprocess.Popen[bytes]:
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(path or os.getcwd() for path in sys.path),
    }
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", f"import {__name__} as child; child.serve()"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=environment,
    )
    assert process.stdout is not None
    process.stdout.read(len(_READY))
    return process


def serve() -> None:
    """Make the calls received on the standard input, until it ends."""
    # Whoever began it ends it, on Ctrl-C too.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # What a model prints goes elsewhere.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    answers.write(_READY)
    answers.flush()
    while True:
        try:
            sent = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        try:
            function, given = pickle.loads(sent)
        except Exception as error:
            reply: tuple[bytes | None, str | None] = None, str(error)
        else:
            reply = pickle.dumps(function(*given)), None
        pickle.dump(reply, answers)
        answers.flush()
