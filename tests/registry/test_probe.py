"""What importing a plugin in a process of its own shows, however it behaves."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_distributions import distribute, observer, sources

from tribo.core.errors import CaseError
from tribo.registry.loader import Source
from tribo.registry.probe import probe

FORKS = """
import os, time
if os.fork() == 0:
    time.sleep(600)
    os._exit(0)
"""

THREAD = """
import threading, time
threading.Thread(target=time.sleep, args=(600,)).start()
"""


def source(folder: Path, module: str, code: str) -> Source:
    points = {"tribo.v1.observer": {"probe.calm": module}}
    distribute(folder, module, "1.0", points, **{module: code})
    (found,) = sources(module)
    return found


@pytest.mark.parametrize("limit", ["abc", "-1", "0", "nan", "inf", ""])
def test_a_time_limit_that_is_none_is_one_clear_error(
    folder: Path, monkeypatch: pytest.MonkeyPatch, limit: str
) -> None:
    monkeypatch.setenv("TRIBO_PLUGIN_TIME_LIMIT", limit)
    with pytest.raises(CaseError) as caught:
        probe(source(folder, "limited", observer("probe.calm")))
    assert "TRIBO_PLUGIN_TIME_LIMIT" in str(caught.value)
    assert f"above 0; {limit!r} was given" in str(caught.value)


@pytest.mark.parametrize(
    ("name", "code", "status", "reason"),
    [
        ("forks", FORKS + observer("probe.calm"), "loaded", ""),
        ("forks_and_crashes", FORKS + "os.abort()", "broken", "SIGABRT"),
        ("forks_and_hangs", FORKS + "time.sleep(600)", "broken", "did not end within 3 s"),
        (
            "threads_and_hangs",
            THREAD + observer("probe.calm"),
            "broken",
            "left a thread running that did not end within 3 s",
        ),
        ("leaves", "import os; os._exit(7)", "broken", "exit code 7"),
        ("asks", "input()" + observer("probe.calm"), "broken", "EOFError"),
    ],
)
def test_a_plugin_cannot_hold_up_who_tries_it(
    folder: Path, name: str, code: str, status: str, reason: str
) -> None:
    limit = 3.0 if "hangs" in name else 60.0
    tried = probe(source(folder, name, code), limit).record
    assert tried.status == status
    assert reason in tried.reason
