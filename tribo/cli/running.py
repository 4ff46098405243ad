"""What the commands that run a simulation share."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

import click

from tribo.core.errors import TriboWarning


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
            click.echo(str(message), err=True)

    with warnings.catch_warnings():
        warnings.simplefilter("always", TriboWarning)
        warnings.showwarning = show
        yield
