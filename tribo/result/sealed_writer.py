"""A sealed file as HDF5 writes it: all that was written since the last commit, or none of it."""

from __future__ import annotations

import io
import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

from tribo.core.errors import CaseError, TriboWarning
from tribo.core.locks import BusyError, lock
from tribo.result.journal import journal_path, write_journal
from tribo.result.seal import PAGE, Seal, digest, page_count, write_sealed
from tribo.result.sealed_file import SealedFile

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer


class SealedWriter(SealedFile):
    """A sealed file, open for writing. What is written stays in memory until `commit`.

    A commit writes a journal, and one that waits for the disk then the file.
    It counts from the moment the journal is complete, so the process may be
    killed at any moment, or the disk be full. After a power failure the file
    holds the last commit that waited, or a later one.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    CaseError
        If another process is writing it.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        # Of a commit that was cut short there is still something to do.
        self._dirty = {index: bytearray(page) for index, page in self._journal.items()}
        self._floor = self._size
        self._commits = self._seal.commit
        self._changed = False

    @classmethod
    def create(cls, path: Path) -> SealedWriter:
        """Begin a new file, in the place of what is there."""
        path = path.resolve()
        if path.exists():
            if not path.is_file():
                raise CaseError(f"{path} is not a file that could be replaced; choose another")
            with path.open("rb") as there:
                _lock(there, path)
        journal_path(path).unlink(missing_ok=True)
        write_sealed(path, b"", identity=uuid4().bytes, sync=False)
        return cls(path)

    def commit(self, *, sync: bool) -> None:
        """Make what was written so far what the file holds.

        Parameters
        ----------
        sync : bool
            Whether to wait until it would outlive a power failure.
        """
        if not self._changed and not (sync and self._dirty):
            return
        count = page_count(self._size)
        if self._size != self._seal.size or self._floor < self._size:
            for index in range(self._floor // PAGE, count):
                self._own(index)
        pages = {index: bytes(self._dirty[index]) for index in sorted(self._dirty)}
        digests = list(self._seal.digests[:count])
        digests += [b""] * (count - len(digests))
        for index, page in pages.items():
            digests[index] = digest(page[: self._size - index * PAGE])
        seal = Seal(self._seal.identity, self._commits + 1, self._size, tuple(digests))
        write_journal(self.path, pages, seal, sync=sync)
        self._commits, self._changed = seal.commit, False
        if sync:
            self._carry_out(pages, seal)

    def _carry_out(self, pages: dict[int, bytes], seal: Seal) -> None:
        encoded = seal.encode()
        for index, page in pages.items():
            _write_all(self._file, page, index * PAGE)
        _write_all(self._file, encoded, seal.size)
        self._file.truncate(seal.size + len(encoded))
        os.fsync(self._file.fileno())
        journal_path(self.path).unlink()
        self._seal, self._journal, self._floor = seal, {}, seal.size
        self._dirty.clear()
        self._kept.clear()

    def _open(self, path: Path) -> io.FileIO:
        file = io.FileIO(path, "r+")
        try:
            if not _lock(file, path):
                warnings.warn(
                    f"{path}: its file system has no locks, so nothing stops another run from "
                    "writing the same file; see that none does, or choose another place with -o",
                    TriboWarning,
                    stacklevel=2,
                )
        except BaseException:
            file.close()
            raise
        return file

    def _page(self, index: int) -> bytes | bytearray:
        if index in self._dirty or (index + 1) * PAGE > self._floor:
            return self._own(index)
        return self._sealed_page(index)

    def _own(self, index: int) -> bytearray:
        """Return a page as it is to be written."""
        page = self._dirty.get(index)
        if page is None:
            page = bytearray(PAGE)
            kept = min(PAGE, self._floor - index * PAGE)
            if kept > 0:
                page[:kept] = self._sealed_page(index)[:kept]
            self._dirty[index] = page
        return page

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, data: ReadableBuffer) -> int:
        """Write at the current position; nothing reaches the disk yet."""
        view = memoryview(data).cast("B")
        done = 0
        while done < len(view):
            index, offset = divmod(self._position, PAGE)
            length = min(PAGE - offset, len(view) - done)
            self._own(index)[offset : offset + length] = view[done : done + length]
            done += length
            self._position += length
        self._changed = True
        self._size = max(self._size, self._position)
        return done

    def truncate(self, size: int | None = None) -> int:
        """Let the file end at `size`; what it gains is zero."""
        size = self._position if size is None else size
        self._changed = self._changed or size != self._size
        if size < self._size:
            last, kept = divmod(size, PAGE)
            if last in self._dirty:
                self._dirty[last][kept:] = bytes(PAGE - kept)
            for index in [index for index in self._dirty if index >= page_count(size)]:
                del self._dirty[index]
            self._floor = min(self._floor, size)
        self._size = size
        return size


def _write_all(file: io.FileIO, data: bytes, position: int) -> None:
    view = memoryview(data)
    file.seek(position)
    while view:
        view = view[file.write(view) :]


def _lock(file: io.IOBase, path: Path) -> bool:
    """Keep other processes from writing a file; return False where there are no locks."""
    try:
        return lock(file.fileno())
    except BusyError as error:
        raise CaseError(f"{path} is in use: another process has it open") from error
