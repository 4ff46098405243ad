"""Standard streams that may be full, closed, or unable to encode µ and ³."""

from __future__ import annotations

import io
import os
import re
import sys
from typing import TYPE_CHECKING, TextIO

import click

from tribo.core.errors import OutputError, ReaderGone

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

# File descriptors, as POSIX numbers them.
STDOUT, STDERR = 1, 2
_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]")
"""All but tab and line feed, and the marks that change the direction of text."""


class GuardedStream(io.FileIO):
    """Standard output, at which the command ends if it cannot be written, or standard error."""

    def write(self, data: ReadableBuffer) -> int:
        """Write, or raise `OutputError` or `ReaderGone`; leave out what standard error lacks."""
        try:
            return super().write(data)
        except OSError as error:
            if self.fileno() == STDERR:
                return memoryview(data).nbytes
            # Otherwise Python writes again as it exits, and reports the failure.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())
            if isinstance(error, BrokenPipeError):
                raise ReaderGone("nobody reads standard output any more") from error
            raise OutputError(f"cannot write to standard output: {error.strerror}") from error


def harmless(text: str) -> str:
    """Return `text` with control characters as escapes, as in a Python string."""
    return _CONTROL.sub(lambda match: match[0].encode("unicode_escape").decode(), text)


def say(what: str, colour: str, text: str) -> None:
    """Print a message on standard error, as ``"error: there is no such file"``."""
    label = click.style(f"{what}: ", fg=colour, bold=True)
    # Looked up now: a live progress line replaces sys.stderr, to print above itself.
    click.echo(label + harmless(text), file=sys.stderr)


def over(stream: TextIO | None, number: int) -> TextIO:
    """Return a guarded stream to the file of a standard stream, which escapes signs it lacks.

    None is a closed stream.
    """
    if stream is None:
        # Otherwise the next file that is opened has its number.
        os.dup2(os.open(os.devnull, os.O_RDONLY), number)
        stream = io.TextIOWrapper(io.FileIO(number, "w", closefd=False), encoding="utf-8")
    try:
        number = stream.fileno()
    except (AttributeError, OSError, ValueError):
        # No file: in a test, in a notebook, or none at all.
        return stream
    if not isinstance(stream, io.TextIOWrapper) or (sys.platform == "win32" and stream.isatty()):
        # A console of Windows takes text, not bytes.
        return stream
    return io.TextIOWrapper(
        io.BufferedWriter(GuardedStream(number, "w", closefd=False)),
        encoding=stream.encoding,
        errors="backslashreplace",
        # `python -u` asks for no buffer, and gets a line at a time.
        line_buffering=stream.line_buffering or stream.write_through,
    )
