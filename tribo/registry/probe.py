"""Try a plugin in a process of its own, where it can neither hang nor crash this one."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from tempfile import TemporaryFile

import psutil

from tribo.core.errors import CaseError
from tribo.registry.loader import Source
from tribo.registry.records import Status
from tribo.registry.verdicts import remember

TIME_LIMIT = 20.0
LIMIT = "TRIBO_PLUGIN_TIME_LIMIT"
_PROBES = 2
_CODE = """
import json, os, sys
answer = os.dup(1)
os.dup2(2, 1)
from tribo.registry.loader import installed, load
wanted = tuple(sys.argv[1:3])
for source in installed():
    if (source.record.distribution, source.record.entry_point) == wanted:
        record, _ = load(source)
        os.write(answer, json.dumps([record.status, record.reason]).encode())
"""


def probe(source: Source, time_limit: float | None = None) -> Source:
    """Return `source` with what importing it in a child process showed, and remember that.

    Parameters
    ----------
    source : Source
        An installed plugin.
    time_limit : float, optional
        In s; that of the environment variable TRIBO_PLUGIN_TIME_LIMIT, or
        20 s, if left out.

    Returns
    -------
    Source
        Its status is ``loaded``, or ``broken`` with the reason: what it
        raised, the signal that ended it, or that it took too long.

    Raises
    ------
    CaseError
        If the time limit is no number above 0.
    """
    status, reason = _tried(source.record.distribution, source.record.entry_point, time_limit)
    remember(source.record, status == "loaded")
    return replace(source, record=replace(source.record, status=status, reason=reason))


def probe_all(sources: Iterable[Source], time_limit: float | None = None) -> list[Source]:
    """Return `sources` with those tried that might be used; the others stay as they are."""

    def tried(source: Source) -> Source:
        usable = source.record.status == "available"
        return probe(source, time_limit) if usable else source

    with ThreadPoolExecutor(_PROBES) as pool:
        return list(pool.map(tried, sources))


def _tried(distribution: str, entry_point: str, time_limit: float | None) -> tuple[Status, str]:
    limit = _limit(time_limit)
    command = [sys.executable, "-P", "-c", _CODE, distribution, entry_point]
    # The child finds what this process would find.
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    # A file and a session of its own: what the plugin starts may outlive the child, and would
    # hold a pipe open.
    with TemporaryFile() as answer:
        child = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=answer,
            stderr=subprocess.DEVNULL,
            env=environment,
            start_new_session=True,
        )
        try:
            code = child.wait(limit)
        except subprocess.TimeoutExpired:
            # It answers as soon as the import ends.
            ended = os.fstat(answer.fileno()).st_size > 0
            what = "its import left a thread running that" if ended else "its import"
            return "broken", f"{what} did not end within {limit:g} s"
        finally:
            _end(child)
        answer.seek(0)
        try:
            status, reason = json.load(answer)
        except ValueError:
            return "broken", _ended(code)
        return status, reason


def _end(child: subprocess.Popen[bytes]) -> None:
    """End the child, and what it has started."""
    if sys.platform == "win32":
        with suppress(psutil.NoSuchProcess):
            for process in psutil.Process(child.pid).children(recursive=True):
                process.kill()
        child.kill()
    else:
        with suppress(ProcessLookupError):
            os.killpg(child.pid, signal.SIGKILL)
    child.wait()


def _limit(given: float | None) -> float:
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


def _ended(code: int) -> str:
    if code < 0:
        known = {number.value: number.name for number in signal.Signals}
        return f"its import crashed the process ({known.get(-code, f'signal {-code}')})"
    return f"its import ended the process with exit code {code}"
