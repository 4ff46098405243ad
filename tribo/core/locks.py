"""Lock an open file until its process ends."""

from __future__ import annotations

import os
import sys

if sys.platform == "win32":
    import msvcrt
else:
    try:
        import fcntl
    except ImportError:
        fcntl = None  # type: ignore[assignment]

_BYTE = 2**31 - 1
"""Byte that is locked on Windows: the last possible one, so that the file stays readable."""


def lock(handle: int) -> bool:
    """Lock an open file; False if the system has no locks, `BlockingIOError` if it is locked."""
    try:
        if sys.platform == "win32":
            os.lseek(handle, _BYTE, os.SEEK_SET)
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        elif fcntl is None:
            return False
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        raise BlockingIOError from None
    except OSError:
        # Some network file systems have no locks.
        return False
    return True
