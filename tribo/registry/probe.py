"""Try a plugin in a process of its own, where it can neither hang nor crash this one."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from tribo.registry.loader import Source
from tribo.registry.records import Status

TIME_LIMIT = 20.0
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
    """Return `source` with what importing it in a child process showed.

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
    """
    record = source.record
    limit = time_limit or float(os.environ.get("TRIBO_PLUGIN_TIME_LIMIT", TIME_LIMIT))
    command = [sys.executable, "-P", "-c", _CODE, record.distribution, record.entry_point]
    # The child finds what this process would find.
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    status: Status = "broken"
    try:
        child = subprocess.run(
            command, capture_output=True, timeout=limit, check=False, env=environment
        )
        status, reason = json.loads(child.stdout)
    except subprocess.TimeoutExpired:
        reason = f"its import did not end within {limit:g} s"
    except ValueError:
        reason = _ended(child.returncode)
    return replace(source, record=replace(record, status=status, reason=reason))


def probe_all(sources: Iterable[Source], time_limit: float | None = None) -> list[Source]:
    """Return `sources` with those tried that might be used; the others stay as they are."""

    def tried(source: Source) -> Source:
        usable = source.record.status == "available"
        return probe(source, time_limit) if usable else source

    with ThreadPoolExecutor(_PROBES) as pool:
        return list(pool.map(tried, sources))


def _ended(code: int) -> str:
    if code < 0:
        known = {number.value: number.name for number in signal.Signals}
        return f"its import crashed the process ({known.get(-code, f'signal {-code}')})"
    return f"its import ended the process with exit code {code}"
