"""A seal at the end of a file: a checksum of every page before it.

HDF5 takes no notice of what stands behind its own data. The seal holds the
SHA-256 of each page, then which file and which commit of it this is, how many
bytes are sealed, and the SHA-256 of the seal itself. A flipped bit, a page in
another's place, a byte more or less: nothing fits any more.
"""

from __future__ import annotations

import io
import os
import struct
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

PAGE = 4096
_MAGIC = b"tribo s1"
_END = struct.Struct("<8s16sQQ")
_DIGEST = 32
_TAIL = _END.size + _DIGEST


class NotSealedError(OSError):
    """A file has no seal, or one that does not fit it."""


@dataclass(frozen=True)
class Seal:
    """What a file is sealed with.

    Parameters
    ----------
    identity : bytes
        Which file it is: 16 bytes, drawn when it was begun.
    commit : int
        How often it has been committed.
    size : int
        Bytes that are sealed.
    digests : tuple of bytes
        Of each page; the last page may be shorter.
    """

    identity: bytes
    commit: int
    size: int
    digests: tuple[bytes, ...]

    def encode(self) -> bytes:
        """Return the bytes that stand behind what is sealed."""
        end = _END.pack(_MAGIC, self.identity, self.commit, self.size)
        body = b"".join(self.digests) + end
        return body + sha256(body).digest()


def page_count(size: int) -> int:
    """Return how many pages `size` bytes take."""
    return -(-size // PAGE)


def digest(page: bytes | bytearray | memoryview) -> bytes:
    """Return the checksum of a page."""
    return sha256(page).digest()


def read_seal(file: io.FileIO) -> Seal:
    """Return the seal of an open file.

    Raises
    ------
    NotSealedError
        If there is none that fits.
    """
    length = file.seek(0, os.SEEK_END)
    if length < _TAIL:
        raise NotSealedError("it is too short")
    file.seek(length - _TAIL)
    magic, _, _, size = _END.unpack(file.read(_END.size))
    if magic != _MAGIC or size + page_count(size) * _DIGEST + _TAIL != length:
        raise NotSealedError("no seal stands at its end")
    file.seek(size)
    return decode(file.read())


def decode(encoded: bytes) -> Seal:
    """Return the seal that `Seal.encode` wrote; NotSealedError if it is damaged."""
    body, check = encoded[:-_DIGEST], encoded[-_DIGEST:]
    if len(encoded) < _TAIL or sha256(body).digest() != check:
        raise NotSealedError("its seal is broken")
    magic, identity, commit, size = _END.unpack(body[-_END.size :])
    table = page_count(size) * _DIGEST
    if magic != _MAGIC or len(body) != table + _END.size:
        raise NotSealedError("its seal is broken")
    digests = tuple(body[i : i + _DIGEST] for i in range(0, table, _DIGEST))
    return Seal(identity, commit, size, digests)


def write_sealed(path: Path, data: bytes | bytearray, *, identity: bytes, sync: bool) -> Seal:
    """Put a sealed file in the place of `path`, whole or not at all, and return its seal.

    Parameters
    ----------
    path : Path
        The file.
    data : bytes
        What it is to hold.
    identity : bytes
        Which file it is.
    sync : bool
        Whether to wait until it would outlive a power failure.
    """
    view = memoryview(data)
    pages = (digest(view[i : i + PAGE]) for i in range(0, len(data), PAGE))
    seal = Seal(identity, 1, len(data), tuple(pages))
    put(path, (data, seal.encode()), sync=sync)
    return seal


def put(path: Path, parts: tuple[bytes | bytearray, ...], *, sync: bool) -> None:
    """Write a file under another name, then rename it to `path`."""
    fresh = path.with_name(path.name + ".new")
    try:
        with fresh.open("wb") as file:
            file.writelines(parts)
            if sync:
                file.flush()
                os.fsync(file.fileno())
        fresh.replace(path)
        if sync:
            _sync_folder(path.parent)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise


def _sync_folder(folder: Path) -> None:
    """Wait until the names in a folder would outlive a power failure."""
    if os.name == "nt":
        # Windows opens no folder, and keeps a journal of names.
        return
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)
