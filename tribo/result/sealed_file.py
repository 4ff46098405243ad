"""A sealed file as HDF5 reads it: no byte of it is handed out unless it is what was sealed."""

from __future__ import annotations

import io
import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import h5py

from tribo.core.errors import TriboWarning
from tribo.result.journal import read_journal
from tribo.result.seal import PAGE, NotSealedError, Seal, digest, page_count, read_seal

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

_KEPT = 256
"""Pages kept in memory, for HDF5 reads the same ones again and again."""


class DamagedError(OSError):
    """A page is not what was sealed."""


class SealedFile(io.RawIOBase):
    """A sealed file, open for reading.

    Where a commit was cut short its journal is read in the place of the pages
    that it was about to write.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    NotSealedError
        If it has no seal that fits.
    OSError
        If it cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        super().__init__()
        # The journal lies beside the file itself, by whatever link it was found.
        self.path = path.resolve()
        self._file = self._open(path)
        self._position = 0
        self._kept: dict[int, bytes] = {}
        try:
            self._seal, self._journal = self._committed()
        except BaseException:
            self._file.close()
            raise
        self._size = self._seal.size

    def _open(self, path: Path) -> io.FileIO:
        return io.FileIO(path)

    def _committed(self) -> tuple[Seal, Mapping[int, bytes]]:
        """Return the last seal, and the pages that do not stand in the file yet."""
        try:
            journal = read_journal(self.path)
        except NotSealedError as error:
            warnings.warn(
                f"{self.path}: {error}; what it held is lost, and the commit before it is read",
                TriboWarning,
                stacklevel=2,
            )
            journal = None
        try:
            seal = read_seal(self._file)
        except NotSealedError:
            # A writer may have begun to carry one out since it was looked for.
            journal = journal or read_journal(self.path)
            if journal is None:
                raise
            return journal[1], journal[0]
        if journal is None:
            return seal, {}
        pages, later = journal
        of_this_file = later.identity == seal.identity and later.commit >= seal.commit
        return (later, pages) if of_this_file else (seal, {})

    @property
    def size(self) -> int:
        """Bytes that HDF5 sees of it."""
        return self._size

    def bad_pages(self) -> list[int]:
        """Read all of the file and return the numbers of the pages that are damaged."""
        bad = []
        for index in range(page_count(self._seal.size)):
            try:
                self._sealed_page(index)
            except DamagedError:
                bad.append(index)
        return bad

    def _sealed_page(self, index: int) -> bytes:
        """Return a page as it was committed."""
        page = self._kept.get(index)
        if page is not None:
            return page
        page = self._journal.get(index)
        if page is None:
            self._file.seek(index * PAGE)
            page = self._file.read(PAGE)
        page = page[: self._seal.size - index * PAGE]
        if digest(page) != self._seal.digests[index]:
            raise DamagedError(f"bytes {index * PAGE} to {(index + 1) * PAGE} {self._reason()}")
        if len(self._kept) >= _KEPT:
            self._kept.clear()
        self._kept[index] = page
        return page

    def _reason(self) -> str:
        try:
            commit = self._committed()[0].commit
        except OSError:
            commit = self._seal.commit
        if commit != self._seal.commit:
            return "were written anew since the file was opened; open it again"
        return "do not have their checksum"

    def _page(self, index: int) -> bytes | bytearray:
        return self._sealed_page(index)

    def close(self) -> None:
        """Close the file."""
        self._file.close()
        super().close()

    def readable(self) -> bool:
        """Return True."""
        return True

    def seekable(self) -> bool:
        """Return True."""
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """Go to a position; the file ends where its seal begins."""
        start = {os.SEEK_SET: 0, os.SEEK_CUR: self._position, os.SEEK_END: self._size}[whence]
        self._position = start + offset
        return self._position

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Fill `buffer` as far as the file reaches, and return how far that is."""
        view = memoryview(buffer).cast("B")
        total = max(0, min(len(view), self._size - self._position))
        done = 0
        while done < total:
            index, offset = divmod(self._position, PAGE)
            length = min(PAGE - offset, total - done)
            view[done : done + length] = memoryview(self._page(index))[offset : offset + length]
            done += length
            self._position += length
        return done


def close_sealed(file: h5py.File, sealed: SealedFile) -> None:
    """Close HDF5's view of a sealed file, then the file."""
    file.close()
    sealed.close()
