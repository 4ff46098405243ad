"""Ctrl-C where Python would lose it."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer, main_thread
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

AGAIN = 0.2
"""Time by which the timer has been started, on a busy machine too, in s."""


@contextmanager
def no_interrupt_lost() -> Iterator[None]:
    """Repeat an interrupt that arrives in a destructor, where Python would only print it."""

    def hook(unraisable: UnraisableHookArgs) -> None:
        if unraisable.exc_type is KeyboardInterrupt:
            # Later: here it would be lost again.
            waiting.append(Timer(AGAIN, _interrupt))
            waiting[-1].start()
        else:
            before(unraisable)

    waiting: list[Timer] = []
    before, sys.unraisablehook = sys.unraisablehook, hook
    try:
        yield
    finally:
        sys.unraisablehook = before
        for timer in waiting:
            timer.cancel()


def _interrupt() -> None:
    """Interrupt the main thread, also where it waits."""
    if sys.platform == "win32":
        signal.raise_signal(signal.SIGINT)
    else:
        signal.pthread_kill(main_thread().ident or 0, signal.SIGINT)
