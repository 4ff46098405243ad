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


def shown(monkeypatch, stream, **changes):
    monkeypatch.setattr(sys, "stderr", stream)
    now = 0.0

    class Clock(Observer):
        """Puts the clock on by 10 s at each step."""

        def on_step(self, snapshot):
            nonlocal now
            now += 10.0

    progress = Progress()
    progress._clock = lambda: now
    steps = Simulation(case(**changes)).run(observers=[Clock(), progress]).totals()["steps"]
    return stream.getvalue(), steps


def frames(text):
    """Return the filled part of the bar and the seconds left of each line shown."""
    line = r"(?:\x1b\[32m(━*)\x1b\[0m)?\x1b\[2m━*\x1b\[0m (?:(\d+):)?(\d+):(\d\d) left"
    found = re.findall(line, text)
    return [(len(bar), 3600 * int(h or 0) + 60 * int(m) + int(s)) for bar, h, m, s in found]


@pytest.fixture
def terminal(monkeypatch):
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.delenv("NO_COLOR", raising=False)
    return Terminal()


SAVES = {
    "grid": Grid((1.2e-3, 1.2e-3), (48, 48)),
    "kinematics": motion(duration=3000),
    "save_times": tuple(range(200, 3000, 200)),
}


def test_the_bar_and_the_time_left_go_on_evenly_past_many_saves(monkeypatch, terminal):
    text, steps = shown(monkeypatch, terminal, **SAVES)
    seen = frames(text)
    assert len(seen) > 0.9 * steps
    assert all(after[0] >= before[0] for before, after in itertools.pairwise(seen))
    left = [seconds for _, seconds in seen]
    second_half = left[len(left) // 2 :]
    # A step takes 10 s: the estimate falls by that, give or take as much, at saves and between.
    assert all(abs(b - a + 10) <= 25 for a, b in itertools.pairwise(second_half))


@pytest.mark.parametrize("forced", ["FORCE_COLOR", "TTY_COMPATIBLE"])
def test_no_bar_is_drawn_into_what_is_no_terminal(monkeypatch, forced):
    monkeypatch.setenv(forced, "1")
    text, _ = shown(monkeypatch, io.StringIO(), **SAVES)
    assert "━" not in text
    assert "\x1b" not in text
    assert text.count(" of 3000 s, step ") >= len(SAVES["save_times"])
