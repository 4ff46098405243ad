"""Run a command in an executed page and show it with what it prints."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys

COLUMNS = "88"


def sh(command: str, code: int = 0, lines: int | None = None) -> None:
    """Run ``tribo …``, show the command and its output; fail on another exit code than `code`.

    ``pip`` and ``pytest`` are run too, as modules of the same Python.

    With `lines`, only so many lines of the output are shown.
    """
    program, *arguments = shlex.split(command)
    assert program in ("tribo", "pip", "pytest")
    done = subprocess.run(
        [sys.executable, "-m", program, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={**os.environ, "COLUMNS": COLUMNS},
        text=True,
        check=False,
    )
    if done.returncode != code:
        raise RuntimeError(f"{command} exited with {done.returncode}:\n{done.stdout}")
    _show(command, done.stdout, lines)


def here(command: str, lines: int | None = None) -> None:
    """Run ``tribo …`` as `sh` does, but in this process, which spares its start."""
    from click.testing import CliRunner

    from tribo.cli.main import tribo

    ended = CliRunner(env={"COLUMNS": COLUMNS}).invoke(tribo, shlex.split(command)[1:])
    if ended.exit_code:
        raise RuntimeError(f"{command}:\n{ended.output}") from ended.exception
    _show(command, ended.output, lines)


def _show(command: str, printed: str, lines: int | None) -> None:
    # Progress, which depends on how fast the machine is.
    progress = r"(?m)^(?:[\d.e+]+ s of [\d.e+]+ s, step|run and pass back) \d+.*\n?"
    output = re.sub(progress, "", printed.replace(" left at least", ""))
    output = re.sub(r"(?m)^(run \d+: .*), \d+ s$", r"\1", output).splitlines()
    if lines is not None and len(output) > lines:
        output = [*output[:lines], "…"]
    print(f"$ {command}")
    print("\n".join(line.rstrip() for line in output))
