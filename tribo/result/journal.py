"""The journal of a commit: the pages that are about to be written over.

It is complete before the first of them is, so that a process may be killed at
any moment: what the journal holds is then what the file holds.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

from tribo.result.seal import PAGE, NotSealedError, Seal, decode, put

_HEAD = struct.Struct("<8sQ")
_INDEX = struct.Struct("<Q")
_MAGIC = b"tribo j1"
_DIGEST = 32


def journal_path(path: Path) -> Path:
    """Return where the journal of a file is kept."""
    return path.with_name(path.name + ".journal")


def write_journal(path: Path, pages: Mapping[int, bytes], seal: Seal, *, sync: bool) -> None:
    """Write the journal of the file at `path`: whole pages, and the seal to come."""
    parts = [_HEAD.pack(_MAGIC, len(pages))]
    for index, page in pages.items():
        parts += [_INDEX.pack(index), page]
    parts.append(seal.encode())
    body = b"".join(parts)
    put(journal_path(path), (body, sha256(body).digest()), sync=sync)


def read_journal(path: Path) -> tuple[Mapping[int, bytes], Seal] | None:
    """Return what `write_journal` wrote for the file at `path`; None if there is no journal.

    Raises
    ------
    NotSealedError
        If it is damaged: it took its place whole.
    """
    try:
        data = journal_path(path).read_bytes()
    except FileNotFoundError:
        return None
    body, check = data[:-_DIGEST], data[-_DIGEST:]
    if len(body) < _HEAD.size or sha256(body).digest() != check:
        raise NotSealedError("its journal is damaged")
    magic, count = _HEAD.unpack_from(body)
    step = _INDEX.size + PAGE
    if magic != _MAGIC or _HEAD.size + count * step > len(body):
        raise NotSealedError("its journal is not one of tribo's")
    pages = {}
    for at in range(_HEAD.size, _HEAD.size + count * step, step):
        (index,) = _INDEX.unpack_from(body, at)
        pages[index] = body[at + _INDEX.size : at + step]
    return pages, decode(body[_HEAD.size + count * step :])
