"""Files that are replaced whole and end in a checksum of all that they hold.

The last 40 bytes of such a file are eight that mark it and the SHA-256 of the
rest. HDF5 and zip readers ignore bytes behind their own data.
"""

from __future__ import annotations

import os
from hashlib import sha256
from pathlib import Path

from tribo.core.errors import CaseError

_MARK = b"tribo\0\0\2"
_LENGTH = len(_MARK) + 32
_BLOCK = 1 << 20


def write_sealed(
    path: Path, data: bytes | memoryview, *, fresh: Path | None = None, sync: bool
) -> None:
    """Replace a file, whole or not at all.

    Parameters
    ----------
    path : Path
        The file to replace, or to make.
    data : bytes or memoryview
        What it is to hold; the checksum is added.
    fresh : Path, optional
        Where to write in the meantime, in the same file system; beside `path`
        if left out.
    sync : bool
        Whether to wait until the new file would survive a power failure.
    """
    fresh = fresh or path.with_name(path.name + ".new")
    try:
        with fresh.open("wb") as file:
            file.write(data)
            file.write(_MARK + sha256(data).digest())
        if sync:
            wait_for_disk(fresh)
        fresh.replace(path)
        if sync:
            wait_for_disk(path.parent)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise


def wait_for_disk(path: Path) -> None:
    """Wait until a file, or the names in a folder, would survive a power failure."""
    if os.name == "nt" and path.is_dir():
        # Windows opens no folder; its file system has a journal of names.
        return
    opened = os.open(path, os.O_RDONLY if os.name != "nt" else os.O_RDWR)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def check_sealed(path: Path) -> None:
    """Compare a file with its checksum.

    Raises
    ------
    CaseError
        If a byte of it is not what was written, it was cut short, or it has no
        checksum.
    OSError
        If it cannot be read.
    """
    with path.open("rb") as file:
        size = os.fstat(file.fileno()).st_size - _LENGTH
        digest, left = sha256(), size
        while left > 0 and (block := file.read(min(left, _BLOCK))):
            digest.update(block)
            left -= len(block)
        end = file.read()
    if size < 0 or not end.startswith(_MARK):
        raise CaseError(
            f"{path} is not a whole tribo file: it was cut short, or another program has written "
            "to it"
        )
    if end != _MARK + digest.digest():
        raise CaseError(
            f"{path} is damaged: its checksum does not match. xarray can still read the fields "
            "whose own checksums match"
        )
