"""Standard streams that cannot be written to: a full disk, a pipe that nobody reads."""

from __future__ import annotations

import io
import os
import sys
from typing import TYPE_CHECKING, TextIO

from tribo.core.errors import OutputError, ReaderGone

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer


class Output(io.FileIO):
    """Standard output: it ends the command where it cannot be written to."""

    def write(self, data: ReadableBuffer) -> int:
        """Write, or raise `OutputError` or `ReaderGone`."""
        try:
            return super().write(data)
        except OSError as error:
            # Or Python tries once more as it ends, and complains.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())
            if isinstance(error, BrokenPipeError):
                raise ReaderGone("nobody reads standard output any more") from error
            raise OutputError(f"cannot write to standard output: {error.strerror}") from error


class Remarks(io.FileIO):
    """Standard error: progress and messages that cannot be written are left out."""

    def write(self, data: ReadableBuffer) -> int:
        """Write, or say nothing."""
        try:
            return super().write(data)
        except OSError:
            return memoryview(data).nbytes


def over(stream: TextIO, kind: type[Output | Remarks]) -> TextIO:
    """Return a stream to where `stream` goes that fails as `kind` does."""
    try:
        number = stream.fileno()
    except (AttributeError, OSError, ValueError):
        # None of the operating system's: a test's, a notebook's, or none at all.
        return stream
    if not isinstance(stream, io.TextIOWrapper) or (sys.platform == "win32" and stream.isatty()):
        # A console of Windows takes text, not bytes.
        return stream
    # As good as none where `python -u` asks for no buffer.
    size = 1 if stream.write_through else io.DEFAULT_BUFFER_SIZE
    return io.TextIOWrapper(
        io.BufferedWriter(kind(number, "w", closefd=False), size),
        encoding=stream.encoding,
        errors=stream.errors,
        line_buffering=stream.line_buffering,
        write_through=stream.write_through,
    )
