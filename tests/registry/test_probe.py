"""What importing a plugin in a process of its own shows, however it behaves."""

import pytest
from fake_distributions import distribute, observer, plugins

from tribo import CaseError
from tribo.registry.probe import probe

CALM = observer("probe.calm")
FORKS = "import os, time\nif os.fork() == 0:\n    time.sleep(20)\n    os._exit(0)\n"
THREAD = "import threading, time\nthreading.Thread(target=time.sleep, args=(20,)).start()\n"


def plugin(folder, module, code):
    distribute(folder, module, "1.0", {"probe.calm": module}, **{module: code})
    (found,) = plugins(module)
    return found


@pytest.mark.parametrize("limit", ["abc", "0", "nan", "inf", ""])
def test_a_time_limit_that_is_none_is_one_clear_error(folder, monkeypatch, limit):
    monkeypatch.setenv("TRIBO_PLUGIN_TIME_LIMIT", limit)
    with pytest.raises(CaseError, match=f"TRIBO_PLUGIN_TIME_LIMIT.* {limit!r} was given"):
        probe(plugin(folder, "limited", CALM))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "code", "status", "reason"),
    [
        ("forks", FORKS + CALM, "loaded", ""),
        ("forks_and_crashes", FORKS + "os.abort()", "broken", "SIGABRT"),
        ("forks_and_hangs", FORKS + "time.sleep(600)", "not ready", "1.5 s"),
        ("threads_and_hangs", THREAD + CALM, "not ready", "1.5 s"),
        ("leaves", "import os; os._exit(7)", "broken", "exit code 7"),
        ("asks", "input()" + CALM, "broken", "asks.py, line 1)"),
    ],
)
def test_a_plugin_cannot_hold_up_who_tries_it(folder, name, code, status, reason):
    tried = probe(plugin(folder, name, code), 1.5 if "hangs" in name else 60.0)
    assert tried.status == status
    assert not tried.usable or status == "loaded"
    assert reason in tried.reason
    assert tried.reason.count(".py, line") <= 1
