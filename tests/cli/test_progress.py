"""The line that shows how a run gets on."""

import io
import itertools
import re
import sys

import pytest
from paper_models import case, motion

from tribo import Grid, Simulation
from tribo.observers.observer import Observer
from tribo.observers.progress import Progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


SAVES = {
    "grid": Grid((1.2e-3, 1.2e-3), (32, 32)),
    "kinematics": motion(duration=1600),
    "save_times": tuple(range(100, 1600, 100)),
}


def shown(monkeypatch, stream):
    """Return what a run shows of which each step takes 10 s, and its number of steps."""
    monkeypatch.setattr(sys, "stderr", stream)
    now = 0.0

    class Clock(Observer):
        def on_step(self, snapshot):
            nonlocal now
            now += 10.0

    progress = Progress()
    progress._clock = lambda: now
    steps = Simulation(case(**SAVES)).run(observers=[Clock(), progress]).totals()["steps"]
    return stream.getvalue(), steps


def test_a_narrow_terminal_shows_the_time_left_and_the_depths(monkeypatch):
    for name, value in {"TERM": "xterm", "COLUMNS": "80", "NO_COLOR": "1"}.items():
        monkeypatch.setenv(name, value)
    text, _ = shown(monkeypatch, Terminal())
    lines = re.findall(r"━+╸? +\d+:\d\d left · [^\x1b\r\n]*", text)
    assert lines
    assert all(len(line) <= 80 and re.search(r"ball \S+, disk \S+ µm", line) for line in lines)


@pytest.mark.slow
def test_the_bar_and_the_time_left_go_on_evenly_past_many_saves(monkeypatch):
    for name, value in {"TERM": "xterm", "COLUMNS": "200", "NO_COLOR": "1"}.items():
        monkeypatch.setenv(name, value)
    text, steps = shown(monkeypatch, Terminal())
    seen = re.findall(r"(━*)╸? +(\d+):(\d\d) left", text)
    assert len(seen) > 0.9 * steps
    bars = [len(bar) for bar, *_ in seen]
    assert bars == sorted(bars)
    left = [60 * int(minutes) + int(seconds) for _, minutes, seconds in seen]
    # The estimate falls by what a step takes, give or take as much, at saves and between.
    later = itertools.pairwise(left[len(left) // 2 :])
    assert all(abs(after - before + 10) <= 25 for before, after in later)


def test_no_bar_is_drawn_into_what_is_no_terminal(monkeypatch):
    for forced in ("FORCE_COLOR", "TTY_COMPATIBLE"):
        monkeypatch.setenv(forced, "1")
    text, _ = shown(monkeypatch, io.StringIO())
    assert "━" not in text
    assert "\x1b" not in text
    assert text.count(" of 1600 s, step ") >= len(SAVES["save_times"])
