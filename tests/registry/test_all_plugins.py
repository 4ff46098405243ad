"""What importing a plugin in a process of its own shows, however it behaves."""

import subprocess

import pytest
from fake_distributions import distribute, observer, plugins

from tribo.core.errors import TriboWarning
from tribo.registry import child as module
from tribo.registry.all_plugins import import_all, try_out
from tribo.registry.registry import Registry

CALM = observer("probe.calm")
FORKS = "import os, time\nif os.fork() == 0:\n    time.sleep(20)\n    os._exit(0)\n"
THREAD = "import threading, time\nthreading.Thread(target=time.sleep, args=(20,)).start()\n"


def plugin(folder, module, code):
    distribute(folder, module, "1.0", {"probe.calm": module}, **{module: code})
    (found,) = plugins(module)
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "code", "status", "reason"),
    [
        ("forks", FORKS + CALM, "available", ""),
        ("forks_and_crashes", FORKS + "os.abort()", "broken", "SIGABRT"),
        ("forks_and_hangs", FORKS + "time.sleep(600)", "broken", "did not end"),
        ("threads_and_hangs", THREAD + CALM, "broken", "did not end"),
        ("burns_and_hangs", "while True: pass", "broken", "did not end"),
        (
            "keeps_no_core",
            "import resource; raise ValueError(resource.getrlimit(resource.RLIMIT_CORE))",
            "broken",
            "ValueError: (0, 0)",
        ),
        ("leaves", "import os; os._exit(7)", "broken", "exit code 7"),
        ("asks", "input()" + CALM, "broken", "asks.py, line 1)"),
        ("ends_badly", "import atexit, os; atexit.register(os.abort)" + CALM, "broken", "SIGABRT"),
    ],
)
def test_a_plugin_cannot_hold_up_who_tries_it(folder, monkeypatch, name, code, status, reason):
    monkeypatch.setattr(module, "TIMES", 0.5 if "hangs" in name else 90)
    tried = plugin(folder, name, code)
    try_out([tried])
    assert tried.status == status
    assert reason in tried.reason
    assert tried.reason.count(".py, line") <= 1


@pytest.fixture
def children(monkeypatch):
    """The calls of child processes, as a list that grows."""
    calls, run = [], subprocess.run

    def counted(*args, **options):
        calls.append(args)
        return run(*args, **options)

    monkeypatch.setattr(module.subprocess, "run", counted)
    return calls


def three(folder, code):
    """Return a registry of two calm plugins, and between them one of this code."""
    for name, text in (("first", CALM), ("middle", code), ("third", CALM)):
        named = text.replace("probe.calm", f"{name}.calm")
        distribute(folder, name, "1.0", {f"{name}.calm": name}, **{name: named})
    return Registry(plugins("first", "middle", "third"))


def test_one_child_tries_all_plugins_that_end_it_not(folder, children):
    registry = three(folder, "1 / 0")
    try_out(registry.plugins)
    assert [each.status for each in registry.plugins] == ["available", "broken", "available"]
    assert len(children) == 1


def test_of_plugins_one_that_crashes_is_left_out_alone(folder, children):
    registry = three(folder, "import os; os.abort()")
    with pytest.warns(TriboWarning, match="middle 1.0 is left out: .*SIGABRT"):
        import_all(registry)
    assert set(registry.components) == {"first.calm", "third.calm"}
    assert len(children) == 1 + 3


def test_where_no_process_starts_plugins_are_imported_untried(folder, monkeypatch):
    def refuse(*args, **options):
        raise OSError("no processes here")

    monkeypatch.setattr(module.subprocess, "run", refuse)
    registry = three(folder, "1 / 0")
    with pytest.warns(TriboWarning, match="middle 1.0 is left out: ZeroDivisionError"):
        import_all(registry)
    assert set(registry.components) == {"first.calm", "third.calm"}
