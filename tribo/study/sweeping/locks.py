"""Let one process at a time work on a file or a folder; a lock ends with its process."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from tribo.core.errors import TriboWarning
from tribo.core.locks import lock


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold the lock that the file `path` stands for; it is made, and removed at the end.

    Raises
    ------
    BusyError
        If another process, or thread, holds it.
    OSError
        If the file cannot be made.
    """
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        try:
            if not lock(handle):
                warnings.warn(
                    f"{path}: its file system has no locks, so nothing stops another sweep from "
                    "doing the same runs; see that none does",
                    TriboWarning,
                    stacklevel=3,
                )
            # Its last holder may have removed the file after it was opened here.
            if not _is_still(handle, path):
                continue
            try:
                yield
            finally:
                # Windows removes no file that is open; there one that is left over harms nobody.
                with suppress(PermissionError):
                    path.unlink(missing_ok=True)
            return
        finally:
            os.close(handle)


def _is_still(handle: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), path.stat())
    except FileNotFoundError:
        return False
