"""The time that a trial may take: a calculation beside the run that was asked for."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from tribo.core.errors import OverTime

TRIAL_TIME = 30.0
"""Most CPU time of a trial, in s: five times the slowest of the templates, 5.4 s."""

_end = ContextVar("_end", default=math.inf)


@contextmanager
def limited() -> Iterator[None]:
    """Limit what is calculated inside to `TRIAL_TIME`: `OverTime` at the next call of a component.

    A run has no limit: only what is an estimate may depend on the machine.
    """
    token = _end.set(time.thread_time() + TRIAL_TIME)
    try:
        yield
    finally:
        _end.reset(token)


def check_time() -> None:
    """Raise `OverTime` if the trial around has taken too long."""
    if time.thread_time() > _end.get():
        raise OverTime(f"it took over {TRIAL_TIME:g} s")
