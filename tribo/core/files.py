"""Files written whole, and errors of the file system in one message."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tribo.core.errors import OutputError


@contextmanager
def writing(place: Path) -> Iterator[None]:
    """Turn an error of the file system into an `OutputError` that names a file or folder."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"cannot write to {place}: {error.strerror or error}") from error


def write_whole(path: Path, text: str) -> None:
    """Write a text file so that whoever reads it finds the old text or the new, never a part.

    Raises
    ------
    OutputError
        If it cannot be written; what was there before stays.
    """
    fresh = path.with_name(path.name + ".new")
    with writing(path):
        fresh.write_text(text, encoding="utf-8", newline="")
        fresh.replace(path)
