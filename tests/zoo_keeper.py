"""Keep a zoo of faulty components: each knows what the one message about it must say."""

from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
import pytest

from tribo import Registry, Result, hookimpl

CASE = """
contact = {contact}
kinematics = {kinematics}
effects = [{effect}]
observers = [{observer}]
output = {{ save_times = [7] }}
{more}
[grid]
size = "0.7 mm"
cells = 24
[load]
normal = 100
[bodies.ball]
surface = {surface}
wear = {wear_law}
[bodies.ball.material]
young = "207 GPa"
poisson = 0.3
{ball}
[bodies.disk]
surface = "flat"
[bodies.disk.material]
young = "207 GPa"
poisson = 0.3
{disk}
"""
SOUND = {
    "contact": '"dcfft"',
    "kinematics": '{ type = "unidirectional", speed = 0.1, track_length = "20 mm", distance = 2 }',
    "effect": "",
    "observer": "",
    "surface": '{ type = "sphere", radius = "5 mm" }',
    "ball": 'hardness = "2 GPa"',
    "disk": "",
    "wear_law": '{ type = "archard", k = 3e-16 }',
    "more": "",
}
SLOTS = {"contact_solver": "contact"}


class Bad(NamedTuple):
    """A faulty class, the words of its message, its exit code, whether a file is left, its case."""

    cls: Any
    words: str
    code: int
    saved: bool
    case: dict[str, str]


class Zoo:
    """Faulty components."""

    def __init__(self):
        self.kept = []

    def bad(self, name, base, words="", code=3, saved=False, case=(), **parts):
        """Keep a class zoo.name that differs from `base` by some parts, and where it shows."""
        own = {"__module__": __name__, "type": f"zoo.{name}"}
        cls = type(name, (base,), {**own, **parts})
        self.kept.append(Bad(cls, words, code, saved, dict(case)))
        return cls

    @property
    def each(self):
        """A test of each of them, as the argument `bad`."""
        return pytest.mark.parametrize("bad", self.kept, ids=lambda bad: bad.cls.__name__)

    def plugin(self):
        """Return a plugin that offers all of them."""
        plugin = ModuleType("zoo-tribo")
        classes = [bad.cls for bad in self.kept]
        plugin.tribo_components = hookimpl(specname="tribo_components")(lambda: classes)
        return plugin

    def registry(self):
        return Registry.with_plugins(self.plugin())


def case_of(*classes, **changes):
    """Return a case that names `classes`, as TOML."""
    named = {SLOTS.get(c.kind(), c.kind()): f'"{c.type}"' for c in classes}
    return CASE.format(**SOUND | named | changes)


def expect_one_message(done, bad):
    """One line, no traceback, names component and fault; what was saved is there to be read."""
    line, *kept = done.stderr.splitlines()
    assert len(kept) == bad.saved
    assert line.startswith("error: ")
    assert repr(bad.cls.type) in line
    assert bad.words in line
    assert done.returncode == bad.code
    assert Path("case.h5").exists() == bad.saved
    if bad.saved:
        with Result.open("case.h5") as result:
            assert result.status == "failed"
            assert result.times[0] == 0
            assert all(
                np.isfinite(result.field("pressure", i)).all() for i in range(len(result.times))
            )
            assert line.removeprefix("error: ") in result.warnings[-1]


def expect_harmless(done):
    """Nothing was said, and the run came to its end."""
    assert (done.returncode, done.stderr) == (0, "")
    with Result.open("case.h5") as result:
        assert result.status == "done"
