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
"""CPU time of a plugin's import over that of tribo's own, which takes 0.6 s: SciPy takes 1 time."""
LIMIT = "TRIBO_PLUGIN_TIME_LIMIT"

_CHILD = """
import sys, time
began = time.process_time(), time.perf_counter()
from tribo.registry.probe import answer
answer(*began, *sys.argv[1:])
"""
_LATE: tuple[int, ...] = (1,)
if sys.platform != "win32":
    _LATE = (-signal.SIGPROF, -signal.SIGALRM)


def probe(plugin: Plugin, time_limit: float | None = None) -> Plugin:
    """Return the record of an installed plugin after its import in a child process.

    It is ``not ready`` if that takes more than `time_limit` seconds of CPU time; those of the
    environment variable TRIBO_PLUGIN_TIME_LIMIT, or 30 times the import of tribo in that process,
    if left out. One that waits has as much longer as tribo's import took longer than its CPU time.
    A plugin that is not ``available`` is returned unchanged.
    """
    return probe_all([plugin], time_limit)[0]


def probe_all(plugins: Iterable[Plugin], time_limit: float | None = None) -> list[Plugin]:
    """Return the records of plugins as `probe` does, from one child process.

    Where that does not come to its end, each plugin has one of its own.
    """
    limit = time_limit_of_plugins(time_limit)
    plugins = list(plugins)
    waiting = [plugin for plugin in plugins if plugin.status == "available"]
    tried = _imported(waiting, limit) if waiting else []
    if len(tried) < len(waiting):
        with ThreadPoolExecutor(2) as pool:
            tried = [*pool.map(lambda plugin: _imported([plugin], limit)[0], waiting)]
    return [tried.pop(0) if plugin.status == "available" else plugin for plugin in plugins]


def import_all(registry: Registry) -> list[Plugin]:
    """Import every plugin that can be imported; return those that cannot be used.

    A child process imports them first, and what ends it is not imported here.
    """
    usable = [plugin for plugin in registry.plugins if plugin.usable]
    # Where no process can be started, as in a browser, they are imported untried.
    with suppress(OSError):
        for plugin, tried in zip(usable, probe_all(usable), strict=True):
            if not tried.usable:
                plugin.status, plugin.reason = tried.status, tried.reason
    return registry.load_all()


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
    """Return what a child process did that ended with an exit code."""
    if code < 0:
        known = {number.value: number.name for number in signal.Signals}
        return f"crashed the process ({known.get(-code, f'signal {-code}')})"
    return f"ended the process with exit code {code}"


def _imported(plugins: Sequence[Plugin], limit: float | None) -> list[Plugin]:
    """Return the records of plugins after their import in one child process.

    If it does not come to its end, none is returned but that of a plugin which was alone.
    """
    names = [name for each in plugins for name in (each.distribution, each.entry_point)]
    # The child finds what this process would find.
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    # To a file: what a plugin starts may outlive the child, and would hold a pipe open.
    with TemporaryFile() as answers:
        child = subprocess.run(
            [sys.executable, "-P", "-c", _CHILD, f"{limit or 0}", *names],
            stdin=subprocess.DEVNULL,
            stdout=answers,
            stderr=subprocess.DEVNULL,
            env=environment,
            check=False,
        )
        answers.seek(0)
        # A process that crashes as it ends would take a command with it too.
        with suppress(ValueError):
            if child.returncode == 0:
                facts: list[dict[str, Any]] = json.load(answers)
                return [replace(each, **its) for each, its in zip(plugins, facts, strict=True)]
    if len(plugins) > 1:
        return []
    status: Status = "broken"
    reason = f"its import {how_it_ended(child.returncode)}"
    if child.returncode in _LATE:
        within = f"{limit:g} s" if limit else f"{TIMES} times what tribo's own import takes"
        status, reason = "not ready", f"within {within}; {LIMIT}, in s, sets another limit"
    return [replace(plugins[0], status=status, reason=reason)]


def answer(cpu: float, began: float, limit: str, *names: str) -> None:
    """Import plugins in this process, and write their records to stdout as JSON.

    `cpu` and `began` are the CPU time and the time (s) before tribo was imported.
    """
    limits = allowed(time.process_time() - cpu, time.perf_counter() - began, float(limit))
    answers = os.dup(1)
    os.dup2(2, 1)
    known = {(plugin.distribution, plugin.entry_point): plugin for plugin in installed()}
    wanted = zip(names[::2], names[1::2], strict=True)
    registry = Registry([known[key] for key in wanted])
    for plugin in registry.plugins:
        _end_after(*limits)
        registry.load(plugin)
    os.write(answers, json.dumps([plugin.facts for plugin in registry.plugins]).encode())


def allowed(cpu: float, took: float, limit: float) -> tuple[float, float]:
    """Return the CPU time and the time (s) of an import, where tribo's own took `cpu` and `took`.

    The CPU time is `limit`, unless that is 0. On a busy machine what waits has as much longer.
    """
    most = limit or TIMES * cpu
    return most, most * max(1.0, took / cpu)


def _end_after(cpu: float, seconds: float) -> None:
    """Let the system end this process, without a core dump, after so many s from now on.

    Windows counts the time alone, as it has no such clock for CPU time.
    """
    if sys.platform == "win32":
        import faulthandler

        faulthandler.dump_traceback_later(seconds, exit=True)
    else:
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.setitimer(signal.ITIMER_PROF, cpu)
        signal.setitimer(signal.ITIMER_REAL, seconds)
