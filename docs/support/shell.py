"""Run a command in an executed page and show it with what it prints."""

from __future__ import annotations

import io
import os
import re
import shlex
import subprocess
import sys
from contextlib import nullcontext, redirect_stderr, redirect_stdout
from unittest import mock

COLUMNS = {"COLUMNS": "88"}


def sh(command: str, code: int = 0, lines: int | None = None) -> None:
    """Run ``tribo …``, show the command and its output; fail on another exit code than `code`.

    It runs in this process, which spares its start. With `lines`, only so many lines of the
    output are shown.
    """
    from tribo.cli.main import main

    program, *arguments = shlex.split(command)
    assert program == "tribo"
    printed, ended = io.StringIO(), 0
    with (
        mock.patch.object(sys, "argv", [program, *arguments]),
        mock.patch.dict(os.environ, COLUMNS),
        # Tables as on a terminal, also in a notebook.
        mock.patch("rich.console._is_jupyter", return_value=False),
        # Nothing of a spinner either.
        mock.patch("rich.console.Console.status", return_value=nullcontext()),
        redirect_stdout(printed),
        redirect_stderr(printed),
    ):
        try:
            main()
        except SystemExit as left:
            ended = left.code or 0
    _show(command, printed.getvalue(), ended, code, lines)


def apart(command: str, code: int = 0) -> None:
    """Run ``tribo …`` or ``pip …`` as `sh` does, but in a process of its own.

    It knows the plugins that have been installed since this one began.
    """
    program, *arguments = shlex.split(command)
    assert program in ("tribo", "pip")
    done = subprocess.run(
        [sys.executable, "-m", program, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={**os.environ, **COLUMNS},
        text=True,
        check=False,
    )
    _show(command, done.stdout, done.returncode, code)


def _show(command: str, printed: str, ended: object, code: int, lines: int | None = None) -> None:
    if ended != code:
        raise RuntimeError(f"{command} exited with {ended}:\n{printed}")
    # Progress, which depends on how fast the machine is.
    progress = r"(?m)^(?:[\d.e+]+ s of [\d.e+]+ s, step|run and pass back) \d+.*\n?"
    output = re.sub(progress, "", printed).splitlines()
    if lines is not None and len(output) > lines:
        output = [*output[:lines], "…"]
    print(f"$ {command}")
    print("\n".join(line.rstrip() for line in output))
