"""The one way to write: all files and folders that tribo makes, moves or removes.

A file is replaced whole or not at all, and only a regular file is: a link, a device, a pipe or a
folder in its place is refused.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from secrets import token_hex
from stat import S_IMODE
from typing import IO

from tribo.core.errors import CaseError, OutputError


@contextmanager
def writing(place: Path) -> Iterator[None]:
    """Turn an error of the file system into an `OutputError` that names a file or folder."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"cannot write to {place}: {error.strerror or error}") from error


def check_output(path: Path) -> None:
    """Raise `CaseError` if a file has no folder, or what is there is no regular file."""
    if not os.path.isdir(path.parent):
        raise CaseError(f"there is no folder {path.parent}; make it with: mkdir {path.parent}")
    if os.path.islink(path):
        raise CaseError(
            f"{path} is a link, which is not written through; give the file that it leads to, "
            f"{os.path.realpath(path)}"
        )
    # Unlike Path.exists this does not raise where a name is too long.
    if os.path.exists(path) and not os.path.isfile(path):
        raise CaseError(f"{path} is not a file that could be replaced; give another name")


def check_new(
    path: Path, replace: bool, remedy: str = "choose another name, or replace it with --force"
) -> None:
    """Raise `CaseError` for what `check_output` refuses, or a file that must not be replaced."""
    check_output(path)
    if os.path.exists(path) and not replace:
        raise CaseError(f"{path} exists; {remedy}")


def write_file(path: Path, *parts: str | bytes | memoryview, through: Path | None = None) -> None:
    """Replace a file by `parts`, one after the other; texts are UTF-8.

    A reader finds the old file or the new one, never a part, and the new one survives a power
    failure once this returns. Its mode stays.

    Parameters
    ----------
    path : Path
        The file.
    *parts : str, bytes or memoryview
        What it will hold.
    through : Path, optional
        Folder in the same file system that has the new file, under a random name, until it is
        whole; the folder of `path` if left out.

    Raises
    ------
    CaseError
        What `check_output` raises.
    OutputError
        If it cannot be written.
    """
    check_output(path)
    fresh = (through or path.parent) / f"tribo-{token_hex(8)}.new"
    with writing(path):
        old = S_IMODE(os.stat(path).st_mode) if os.path.exists(path) else None
        opened = _open(fresh, os.O_EXCL, 0o666 if old is None else old)
        try:
            with os.fdopen(opened, "wb") as file:
                if old is not None and os.name != "nt":
                    os.chmod(file.fileno(), old)
                file.writelines(p.encode() if isinstance(p, str) else p for p in parts)
                file.flush()
                os.fsync(file.fileno())
            os.replace(fresh, path)
        except BaseException:
            with suppress(OSError):
                os.unlink(fresh)
            raise
        _sync_names(path.parent)


def make_folder(path: Path) -> None:
    """Make a folder and its missing parents; `OutputError` if it fails."""
    with writing(path):
        if not os.path.isdir(path):
            make_folder(path.parent)
            path.mkdir(exist_ok=True)
            _sync_names(path.parent)


def move(path: Path, target: Path) -> None:
    """Give a file another name in its folder, in the place of what has it."""
    check_output(target)
    with writing(path):
        os.replace(path, target)


def remove(*paths: Path) -> None:
    """Remove regular files of one folder, if they are there."""
    for path in paths:
        check_output(path)
        with writing(path), suppress(FileNotFoundError):
            os.unlink(path)
    for folder in {path.parent for path in paths}:
        with writing(folder):
            _sync_names(folder)


def remove_empty(folder: Path) -> None:
    """Remove a folder that holds nothing."""
    with writing(folder):
        os.rmdir(folder)


def open_lock(path: Path) -> IO[bytes]:
    """Open a file to lock, which is made if there is none."""
    check_output(path)
    with writing(path):
        return os.fdopen(_open(path, os.O_APPEND, 0o666), "ab")


def _open(path: Path, how: int, mode: int) -> int:
    """Open a file for writing, which is made if there is none; a link is not followed."""
    # Each is of some systems only.
    how |= getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
    return os.open(path, os.O_WRONLY | os.O_CREAT | how, mode)


def _sync_names(folder: Path) -> None:
    """Wait until the names in a folder would survive a power failure."""
    # Windows opens no folder; its file system has a journal of names. Nor can one be opened that
    # may be written but not listed.
    if os.name != "nt" and os.access(folder, os.R_OK):
        opened = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(opened)
        finally:
            os.close(opened)
