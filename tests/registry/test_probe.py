"""What importing a plugin in a process of its own shows, however it behaves."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_distributions import distribute, observer, plugins

from tribo.core.errors import CaseError
from tribo.registry.plugins import Plugin
from tribo.registry.probe import probe

FORKS = """
import os, time
if os.fork() == 0:
    time.sleep(20)
    os._exit(0)
"""

THREAD = """
import threading, time
threading.Thread(target=time.sleep, args=(20,)).start()
"""


def plugin(folder: Path, module: str, code: str) -> Plugin:
    distribute(folder, module, "1.0", {"probe.calm": module}, **{module: code})
    (found,) = plugins(module)
    return found


@pytest.mark.parametrize("limit", ["abc", "0", "nan", "inf", ""])
def test_a_time_limit_that_is_none_is_one_clear_error(
    folder: Path, monkeypatch: pytest.MonkeyPatch, limit: str
) -> None:
    monkeypatch.setenv("TRIBO_PLUGIN_TIME_LIMIT", limit)
    with pytest.raises(CaseError, match=f"TRIBO_PLUGIN_TIME_LIMIT.* {limit!r} was given"):
        probe(plugin(folder, "limited", observer("probe.calm")))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "code", "status", "reason"),
    [
        ("forks", FORKS + observer("probe.calm"), "loaded", ""),
        ("forks_and_crashes", FORKS + "os.abort()", "broken", "SIGABRT"),
        ("forks_and_hangs", FORKS + "time.sleep(600)", "broken", "did not end"),
        ("threads_and_hangs", THREAD + observer("probe.calm"), "broken", "left a thread running"),
        ("leaves", "import os; os._exit(7)", "broken", "exit code 7"),
        ("fails", "1/0", "broken", "fails.py, line 1)"),
        ("asks", "input()" + observer("probe.calm"), "broken", "EOFError"),
    ],
)
def test_a_plugin_cannot_hold_up_who_tries_it(
    folder: Path, name: str, code: str, status: str, reason: str
) -> None:
    limit = 3.0 if "hangs" in name else 60.0
    tried = probe(plugin(folder, name, code), limit)
    assert tried.status == status
    assert reason in tried.reason
    assert tried.reason.count(".py, line") <= 1
