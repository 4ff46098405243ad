"""Run a command as from the shell, but in this process."""

import io
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from typing import NamedTuple

from tribo.cli.main import main


class Done(NamedTuple):
    """How a command ended: its exit code, and what it wrote."""

    returncode: int
    stdout: str
    stderr: str


def tribo(*arguments, cwd="."):
    out, err = io.StringIO(), io.StringIO()
    before, sys.argv = sys.argv, ["tribo", *map(str, arguments)]
    code = 0
    try:
        with chdir(cwd), redirect_stdout(out), redirect_stderr(err):
            main()
    except SystemExit as left:
        code = left.code or 0
    except KeyboardInterrupt:
        code = 130
    finally:
        sys.argv = before
    return Done(code, out.getvalue(), err.getvalue())
