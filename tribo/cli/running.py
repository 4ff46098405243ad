"""What the commands that run a simulation share."""

from __future__ import annotations

import signal
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer
from typing import TYPE_CHECKING, TextIO

import click

from tribo.cli.harmless import echo
from tribo.core.errors import TriboWarning

if TYPE_CHECKING:
    from sys import UnraisableHookArgs

AGAIN = 0.2
"""Time by which the timer has been started, on a busy machine too, in s."""


@contextmanager
def warnings_on_stderr() -> Iterator[None]:
    """Print a run's warnings as one line each."""

    def show(
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        if issubclass(category, TriboWarning):
            click.secho("warning: ", fg="yellow", bold=True, err=True, nl=False)
            echo(str(message), err=True)

    with warnings.catch_warnings():
        warnings.simplefilter("always", TriboWarning)
        warnings.showwarning = show
        yield


@contextmanager
def no_interrupt_lost() -> Iterator[None]:
    """Ask again for an interrupt that comes while Python tidies up, where it is only printed."""

    def hook(unraisable: UnraisableHookArgs) -> None:
        if unraisable.exc_type is KeyboardInterrupt:
            # Later: here it would be lost again.
            waiting.append(Timer(AGAIN, signal.raise_signal, [signal.SIGINT]))
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
