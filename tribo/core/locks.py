"""The lock of an open file; it ends with its process."""

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
"""What is locked on Windows, where nobody else could read it: the last byte it can lock."""


class BusyError(Exception):
    """Another process, or thread, holds the lock."""


def lock(handle: int) -> bool:
    """Lock an open file; return False where there are no locks.

    Raises
    ------
    BusyError
        If it is locked.
    """
    try:
        if sys.platform == "win32":
            os.lseek(handle, _BYTE, os.SEEK_SET)
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        elif fcntl is None:
            return False
        else:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        raise BusyError from None
    except OSError:
        # Some network file systems have none.
        return False
    return True
