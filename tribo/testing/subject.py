"""What is checked, and what a check is."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any, overload

from tribo.component import Component
from tribo.core.arrays import Array

FieldValue = float | Callable[[Array], Array]
"""The value of a local field, or how it follows from the pressure."""


class CheckFailed(AssertionError):
    """The fact that a check states does not hold."""


def require(holds: object, message: str) -> None:
    """Raise `CheckFailed` with `message` unless `holds`."""
    if not holds:
        raise CheckFailed(message)


@dataclass(frozen=True)
class Subject:
    """A class with one of its configurations.

    Parameters
    ----------
    cls : type
        The class.
    kind : str
        Its kind, as ``"wear_law"``.
    config : Component
        One valid configuration.
    fields : Mapping[str, float or callable]
        Typical values of local fields, in SI, or functions of the pressure.
    revival : Revival
        Whether configurations reach a new process, asked once for all of them.
    index : int
        Number of the configuration.
    """

    cls: type[Component]
    kind: str
    config: Component
    fields: Mapping[str, FieldValue]
    revival: Revival
    index: int

    def make(self) -> Any:
        """Return a new component with the configuration."""
        return self.cls.model_validate(self.config.model_dump())

    @property
    def label(self) -> str:
        """The configuration as short text."""
        values = self.config.model_dump(exclude_defaults=True)
        del values["type"]
        text = ", ".join(f"{name}={value!r}" for name, value in values.items()) or "its defaults"
        return text if len(text) <= 60 else text[:59] + "…"


@dataclass(frozen=True)
class Check:
    """A fact that every implementation of an interface must fulfil.

    Parameters
    ----------
    name : str
        Its name in reports.
    fact : str
        The fact, in one sentence.
    run : callable
        Raises if the fact does not hold for a subject.
    unless : callable
        Returns why the check does not apply to a subject, None if it does.
    """

    name: str
    fact: str
    run: Callable[[Subject], None]
    unless: Callable[[Subject], str | None] = field(default=lambda subject: None)


Unless = Callable[[Subject], str | None]


@overload
def fact(function: Callable[[Subject], None], /) -> Check: ...
@overload
def fact(*, unless: Unless) -> Callable[[Callable[[Subject], None]], Check]: ...
def fact(
    function: Callable[[Subject], None] | None = None, /, *, unless: Unless = lambda subject: None
) -> Check | Callable[[Callable[[Subject], None]], Check]:
    """Make a check of a function; its docstring states the fact."""
    if function is None:
        return partial(_made, unless=unless)
    return _made(function, unless=unless)


def _made(function: Callable[[Subject], None], *, unless: Unless) -> Check:
    stated = (function.__doc__ or "").split("\n\n")[0]
    return Check(function.__name__, " ".join(stated.split()), function, unless)


_READ = """
import os, pickle, sys
answer = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
sys.path[:] = pickle.load(sys.stdin.buffer)
for blob in pickle.load(sys.stdin.buffer):
    try:
        config = pickle.loads(blob)
        print(repr((True, config.model_dump_json())), file=answer)
    except Exception as error:
        print(repr((False, f"{type(error).__name__}: {error}")), file=answer)
"""


class Revival:
    """Sends all configurations of a class to one new process.

    Parameters
    ----------
    configs : sequence of Component
        The configurations.
    """

    def __init__(self, configs: list[Component]) -> None:
        self._configs = configs

    @cached_property
    def answers(self) -> list[tuple[bool, str]]:
        """For each, whether it arrived, and its JSON there or what was raised."""
        import ast
        import pickle

        blobs: list[bytes] = []
        broken: dict[int, str] = {}
        for number, config in enumerate(self._configs):
            try:
                blobs.append(pickle.dumps(config))
            except Exception as error:
                broken[number] = f"{type(error).__name__}: {error}"
        done = subprocess.run(
            [sys.executable, "-c", _READ],
            input=pickle.dumps(sys.path) + pickle.dumps(blobs),
            capture_output=True,
            timeout=120,
            check=False,
        )
        lines = done.stdout.decode().splitlines()
        if done.returncode or len(lines) != len(blobs):
            said = done.stderr.decode().strip().splitlines() or ["the process died"]
            return [(False, said[-1])] * len(self._configs)
        arrived = iter([ast.literal_eval(line) for line in lines])
        return [
            (False, broken[number]) if number in broken else next(arrived)
            for number in range(len(self._configs))
        ]
