"""What is calculated before there is anything to print."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer

import click

from tribo.observers.progress import QUIET


@contextmanager
def waiting_for(what: str) -> Iterator[None]:
    """Print on stderr what is calculated inside, once that has taken two seconds."""
    line = Timer(QUIET, click.echo, (f"{what} …",), {"err": True})
    line.daemon = True
    line.start()
    try:
        yield
    finally:
        line.cancel()
