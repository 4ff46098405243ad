"""Small, short runs to be swept, and executors that misbehave."""

import os
import subprocess
import sys
import tomllib
from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool

from tribo.config.overrides import apply_settings
from tribo.core.toml import to_toml
from tribo.templates import template

QUICK = {
    "grid": {"cells": 24, "size": "0.6 mm"},
    "contact.type": "winkler",
    "kinematics.duration": "10 s",
    "output.save_times": [1, 2],
}
LOADS = {"load.normal": ["50 N", "60 N"]}
# A second a run, with a checkpoint in between.
SLOW = {
    "grid": {"cells": 32, "size": "0.7 mm"},
    "contact.type": "winkler",
    "kinematics.duration": "10 s",
    "stepping": {"type": "explicit", "time_step": "0.08 s"},
    "output.save_times": [0.1, 0.5, 1, 2, 4, 6, 8],
}


def case(folder, settings=QUICK):
    """Write a case; return the file."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "my.toml"
    tables = apply_settings(tomllib.loads(template("ball_on_disk")), settings)
    path.write_text(to_toml(tables), encoding="utf-8")
    return path


def start(arguments, cwd):
    """Start Python in a process group of its own."""
    return subprocess.Popen(
        [sys.executable, *map(str, arguments)],
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def tribo(*arguments, cwd):
    """Start the command line."""
    return start(["-m", "tribo", *arguments], cwd)


def turn_off_energy():
    """Prepare a worker that lacks a plugin."""
    os.environ["TRIBO_DISABLE_PLUGINS"] = "tribo-energy"


class Inline(Executor):
    """Calls at once; what `instead` returns for a case replaces the call."""

    def __init__(self, instead=lambda case: None):
        self.calls = []
        self._instead = instead

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        self.calls.append(args[1])
        given = self._instead(args[0])
        if isinstance(given, Exception):
            future.set_exception(given)
        else:
            future.set_result(fn(*args, **kwargs) if given is None else given)
        return future


def dies_at(load):
    """Return what an executor does whose worker dies at a load."""
    return lambda case: BrokenProcessPool("killed") if case["load"]["normal"] == load else None
