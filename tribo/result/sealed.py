"""Files that are replaced whole and end in a checksum of all that they hold.

The last 40 bytes of such a file are eight that mark it and the SHA-256 of the
rest. HDF5 and zip readers ignore bytes behind their own data.
"""

from __future__ import annotations

import io
import os
from hashlib import sha256
from pathlib import Path
from typing import BinaryIO

from tribo.core.errors import CaseError
from tribo.core.writing import write_file

_MARK = b"tribo\0\0\2"
_LENGTH = len(_MARK) + sha256().digest_size


def write_sealed(path: Path, data: bytes | memoryview, through: Path | None = None) -> None:
    """Replace a file by `data` and a checksum; see `tribo.core.writing.write_file`."""
    write_file(path, data, _MARK + sha256(data).digest(), through=through)


def open_sealed(path: Path) -> BinaryIO:
    """Open a file that `write_sealed` wrote, and compare it with its checksum.

    `CaseError` if a byte of it is not what was written, it was cut short, or it has no checksum.
    """
    file = path.open("rb")
    try:
        left, digest = os.fstat(file.fileno()).st_size - _LENGTH, sha256()
        while left > 0 and (block := file.read(min(left, io.DEFAULT_BUFFER_SIZE))):
            digest.update(block)
            left -= len(block)
        if file.read() != _MARK + digest.digest():
            raise CaseError(
                f"{path} is damaged, or tribo did not write it: its checksum does not match; copy "
                "the file again, or run its case again"
            )
        file.seek(0)
    except BaseException:
        file.close()
        raise
    return file
