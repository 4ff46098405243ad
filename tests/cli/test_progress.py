"""The line that shows how a run gets on."""

import io
import re
import sys

from paper_models import case, motion

from tribo import Grid, Simulation
from tribo.observers import progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


SAVES = {
    "grid": Grid((1.2e-3, 1.2e-3), (32, 32)),
    "kinematics": motion(duration=1600),
    "save_times": tuple(range(100, 1600, 100)),
}


def shown(monkeypatch, stream):
    """Return what a run shows."""
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "QUIET", 0.0)
    Simulation(case(**SAVES)).run(observers=[progress.Progress()])
    return stream.getvalue()


def test_a_narrow_terminal_shows_the_time_left_and_the_depths(monkeypatch):
    for name, value in {"TERM": "xterm", "COLUMNS": "80", "NO_COLOR": "1"}.items():
        monkeypatch.setenv(name, value)
    text = shown(monkeypatch, Terminal())
    lines = re.findall(r"━+╸? +\d+:\d\d left · [^\x1b\r\n]*", text)
    assert lines
    assert all(len(line) <= 80 and re.search(r"ball \S+, disk \S+ µm", line) for line in lines)


def test_no_bar_is_drawn_into_what_is_no_terminal(monkeypatch):
    for forced in ("FORCE_COLOR", "TTY_COMPATIBLE"):
        monkeypatch.setenv(forced, "1")
    text = shown(monkeypatch, io.StringIO())
    assert "━" not in text
    assert "\x1b" not in text
    assert text.count(" of 1600 s, step ") >= len(SAVES["save_times"])
