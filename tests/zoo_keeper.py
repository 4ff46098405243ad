"""Keep a zoo of faulty components: each knows what the one message about it must say."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from pydantic import create_model

from tribo import Registry, Result, hookimpl
from tribo.registry.kinds import KINDS

CASE = """
contact = {contact}
kinematics = {kinematics}
effects = [{effect}]
observers = [{observer}]
output = {{ save_times = [7] }}
{more}
[grid]
size = "0.7 mm"
cells = 32
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


def kind_of(cls: type) -> str:
    return next(kind.name for kind in KINDS.values() if issubclass(cls, kind.interface))


class Zoo:
    """Faulty components of one kind, whose configurations have the fields given here."""

    def __init__(self, **config: Any) -> None:
        self.kept: list[Any] = []
        self._config = config

    def bad(self, words: str, code: int = 3, *, saved: bool = False) -> Any:
        """Call a class zoo.its_name, and say what its message holds and whether a file is left."""

        def keep(cls: Any) -> Any:
            name = "zoo." + re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()
            cls = create_model(
                cls.__name__, __base__=cls, __module__=cls.__module__, **self._config
            )
            cls.type = name
            cls.words, cls.code, cls.saved = words, code, saved
            self.kept.append(cls)
            return cls

        return keep

    def plugin(self) -> object:
        """Return a plugin that offers all of them."""
        plugin = ModuleType("zoo-tribo")
        plugin.tribo_components = hookimpl(specname="tribo_components")(lambda: self.kept)
        return plugin

    def registry(self) -> Registry:
        return Registry.with_plugins(self.plugin())


def case_of(*classes: Any, **changes: str) -> str:
    """Return a case that names `classes`, as TOML."""
    named = {SLOTS.get(kind_of(c), kind_of(c)): f'"{c.type}"' for c in classes}
    return CASE.format(**SOUND | named | changes)


@dataclass(frozen=True)
class Ended:
    """How a command ended: its exit code, what it said on stderr, and its result file."""

    code: int
    said: list[str]
    path: Path


def expect_one_message(ended: Ended, cls: Any) -> None:
    """One line, no traceback, names component and fault; what was saved is there to be read."""
    line, *kept = ended.said
    assert len(kept) == cls.saved
    assert line.startswith("error: ")
    assert repr(cls.type) in line
    assert cls.words in line
    assert ended.code == cls.code
    assert ended.path.exists() == cls.saved
    if cls.saved:
        with Result.open(ended.path) as result:
            assert result.status == "failed"
            assert result.times[0] == 0
            assert all(np.isfinite(result.pressure(i)).all() for i in range(len(result.times)))
            assert line.removeprefix("error: ") in result.notices[-1]


def expect_harmless(ended: Ended) -> None:
    """Nothing was said, and the run came to its end."""
    assert (ended.code, ended.said) == (0, [])
    with Result.open(ended.path) as result:
        assert result.status == "done"
