"""Import a plugin in a child process, so that it can neither hang nor crash this one."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
from dataclasses import replace
from tempfile import TemporaryFile

from tribo.core.errors import CaseError
from tribo.registry.plugins import Plugin, installed
from tribo.registry.registry import Registry

TIME_LIMIT = 20.0
LIMIT = "TRIBO_PLUGIN_TIME_LIMIT"


def probe(plugin: Plugin, time_limit: float | None = None) -> Plugin:
    """Return the record of an installed plugin after its import in a child process.

    It is ``not ready`` after `time_limit` seconds; those of the environment variable
    TRIBO_PLUGIN_TIME_LIMIT, or 20, if left out. A plugin that is not ``available`` is returned
    unchanged.
    """
    if plugin.status != "available":
        return plugin
    limit = time_limit_of_plugins(time_limit)
    command = [sys.executable, "-P", "-m", __name__, plugin.distribution, plugin.entry_point]
    # The child finds what this process would find.
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    # To a file: what the plugin starts may outlive the child, and would hold a pipe open.
    with TemporaryFile() as answer:
        try:
            child = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=answer,
                stderr=subprocess.DEVNULL,
                env=environment,
                timeout=limit,
                check=False,
            )
            answer.seek(0)
            return replace(plugin, **json.load(answer))
        except subprocess.TimeoutExpired:
            reason = f"within {limit:g} s (busy machine? --time-limit {3 * limit:g}, or {LIMIT})"
            return replace(plugin, status="not ready", reason=reason)
        except ValueError:
            reason = f"its import {how_it_ended(child.returncode)}"
    return replace(plugin, status="broken", reason=reason)


def time_limit_of_plugins(given: float | None = None) -> float:
    """Return the seconds that a plugin has in a child process; see `probe`."""
    chosen = os.environ.get(LIMIT, TIME_LIMIT) if given is None else given
    try:
        limit = float(chosen)
    except ValueError:
        limit = math.nan
    if not 0 < limit < math.inf:
        raise CaseError(
            f"the time limit of a plugin ({LIMIT}, --time-limit) must be a number of seconds above "
            f"0; {str(chosen)!r} was given"
        )
    return limit


def how_it_ended(code: int) -> str:
    """Return what a child process did that ended with an exit code."""
    if code < 0:
        known = {number.value: number.name for number in signal.Signals}
        return f"crashed the process ({known.get(-code, f'signal {-code}')})"
    return f"ended the process with exit code {code}"


def _answer(distribution: str, entry_point: str) -> None:
    """Import the plugin in this process, and write its record to stdout as JSON."""
    answer = os.dup(1)
    os.dup2(2, 1)
    wanted = (distribution, entry_point)
    registry = Registry(p for p in installed() if (p.distribution, p.entry_point) == wanted)
    registry.load_all()
    os.write(answer, json.dumps(registry.plugins[0].facts).encode())


if __name__ == "__main__":
    _answer(*sys.argv[1:])
