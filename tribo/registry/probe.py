"""Import plugins in a child process, so that they can neither hang nor crash this one."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from tempfile import TemporaryFile
from typing import Any

from tribo.core.errors import CaseError
from tribo.registry.plugins import Plugin, Status, installed
from tribo.registry.registry import Registry

TIMES = 30
"""CPU time of a plugin's import over the import of tribo, which takes 0.6 s: SciPy takes 1 time."""
WAIT = 200.0
"""Time (s) after which a waiting import is ended: ten times the CPU time that TIMES allows."""
LIMIT = "TRIBO_PLUGIN_TIME_LIMIT"

_LATE = -getattr(signal, "SIGPROF", 0) or None
_CHILD = "import sys; from tribo.registry.probe import answer; answer(*sys.argv[1:])"


def probe_all(plugins: Iterable[Plugin], time_limit: float | None = None) -> list[Plugin]:
    """Return the records of installed plugins after their import in one child process.

    If that process does not finish, each plugin has a process of its own. A plugin is ``not ready``
    if it takes more than `time_limit` seconds of CPU time, or waits ten times as long; by default
    the environment variable TRIBO_PLUGIN_TIME_LIMIT, or 30 times tribo's own import. A plugin that
    is not ``available`` is returned unchanged.
    """
    limit = time_limit_of_plugins(time_limit)
    plugins = list(plugins)
    waiting = [plugin for plugin in plugins if plugin.status == "available"]
    tried = _imported(waiting, limit) if waiting else []
    if len(tried) < len(waiting):
        with ThreadPoolExecutor(2) as pool:
            tried = [*pool.map(lambda plugin: _imported([plugin], limit)[0], waiting)]
    return [tried.pop(0) if plugin.status == "available" else plugin for plugin in plugins]


def time_limit_of_plugins(given: float | None = None) -> float | None:
    """Return the seconds of CPU time that a plugin has in a child process, if they are set."""
    chosen = os.environ.get(LIMIT) if given is None else given
    if chosen is None:
        return None
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
    """Word how a child process with an exit code ended."""
    if code < 0:
        known = {number.value: number.name for number in signal.Signals}
        return f"crashed the process ({known.get(-code, f'signal {-code}')})"
    return f"ended the process with exit code {code}"


def _imported(plugins: Sequence[Plugin], limit: float | None) -> list[Plugin]:
    """Return the records of plugins after their import in one child process.

    If the process does not finish, only the record of a plugin that was alone is returned.
    """
    names = [name for each in plugins for name in (each.distribution, each.entry_point)]
    # The child finds what this process would find.
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    status: Status = "broken"
    # To a file: what a plugin starts may outlive the child, and would hold a pipe open.
    with TemporaryFile() as answers:
        try:
            child = subprocess.run(
                [sys.executable, "-P", "-c", _CHILD, f"{limit or 0}", *names],
                stdin=subprocess.DEVNULL,
                stdout=answers,
                stderr=subprocess.DEVNULL,
                env=environment,
                timeout=10 * limit if limit else WAIT,
                check=False,
            )
            late = child.returncode == _LATE
            reason = f"its import {how_it_ended(child.returncode)}"
            answers.seek(0)
            # A process that crashes as it ends would take a command with it too.
            with suppress(ValueError):
                if child.returncode == 0:
                    facts: list[dict[str, Any]] = json.load(answers)
                    return [replace(each, **its) for each, its in zip(plugins, facts, strict=True)]
        except subprocess.TimeoutExpired:
            late = True
    if late:
        within = f"{limit:g} s" if limit else f"{TIMES} times the CPU time of tribo's own import"
        status, reason = "not ready", f"within {within}; {LIMIT}, in s, sets another limit"
    return [replace(plugins[0], status=status, reason=reason)] if len(plugins) == 1 else []


def answer(limit: str, *names: str) -> None:
    """Import plugins in this process, and write their records to stdout as JSON."""
    # What this process has done so far is the import of tribo.
    cpu = float(limit) or TIMES * time.process_time()
    answers = os.dup(1)
    os.dup2(2, 1)
    known = {(plugin.distribution, plugin.entry_point): plugin for plugin in installed()}
    registry = Registry([known[key] for key in zip(names[::2], names[1::2], strict=True)])
    for plugin in registry.plugins:
        _end_after(cpu)
        registry.load(plugin)
    os.write(answers, json.dumps([plugin.facts for plugin in registry.plugins]).encode())


def _end_after(cpu: float) -> None:
    """Let the system end this process, without a core dump, after so many s of CPU time.

    Windows has no such clock: there only the time of the parent counts.
    """
    if sys.platform != "win32":
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.setitimer(signal.ITIMER_PROF, cpu)
