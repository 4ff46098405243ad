"""An HDF5 file of which nothing is read that is damaged, or larger than the file could hold."""

from __future__ import annotations

import os
import weakref
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Self

import h5py
import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.result.damage import unreadable
from tribo.result.seal import NotSealedError
from tribo.result.sealed_file import SealedFile, close_sealed

MOST_PACKED = 1100
"""Bytes that a byte of a file may stand for; deflate comes to 1032."""

LARGEST = 1e100
"""No quantity comes near it; its square and cube are still finite."""


class GuardedFile:
    """An open HDF5 file whose every error is a `CaseError` that names what cannot be read.

    Parameters
    ----------
    file : h5py.File
        The open file; one on a disk is opened by `open`.
    name : str
        What to call it in messages.
    sealed : SealedFile, optional
        What the file is read through; closed with it.
    """

    def __init__(self, file: h5py.File, name: str, sealed: SealedFile | None = None) -> None:
        self.file = file
        self.name = name
        self._sealed = sealed
        if sealed is not None:
            # HDF5 must not be left to close it when Python is gone.
            self._close = weakref.finalize(self, close_sealed, file, sealed)

    @classmethod
    def open(cls, path: Path) -> Self:
        """Open a sealed file.

        Raises
        ------
        CaseError
            If there is no such file, it is not sealed, or it is damaged at its
            root.
        """
        if not os.path.isfile(path):
            raise CaseError(f"{path} is not a file; give the .h5 file that 'tribo run' wrote")
        try:
            sealed = SealedFile(path)
        except NotSealedError as error:
            if _is_text(path):
                raise CaseError(
                    f"{path} is not a whole tribo file but text; if it is a case: tribo run {path}"
                ) from error
            raise CaseError(
                f"{path} is not a whole tribo file ({error}): it was cut short, or another "
                "program has written to it"
            ) from error
        except OSError as error:
            raise CaseError(f"{path} cannot be read: {error.strerror}") from error
        if sealed.size == 0:
            sealed.close()
            raise CaseError(f"{path} holds nothing yet: its run was stopped as it began")
        try:
            file = h5py.File(sealed, "r")
        except OSError as error:
            sealed.close()
            raise CaseError(f"{path} is damaged at its root: {error}") from error
        return cls(file, str(path), sealed)

    def close(self) -> None:
        """Close the file."""
        if self._sealed is None:
            self.file.close()
        else:
            self._close()

    def check(self) -> None:
        """Hold the whole file against its checksums.

        Raises
        ------
        CaseError
            If it is damaged, with what of it cannot be read.
        """
        if self._sealed is None or not self._sealed.bad_pages():
            return
        lost = unreadable(self.file)
        raise CaseError(
            f"{self.name} is damaged: "
            + (f"{', '.join(lost)} cannot be read" if lost else "nothing in use is lost")
        )

    def array(
        self,
        name: str,
        index: int | slice = slice(None),
        *,
        shapes: Collection[tuple[int, ...]] = (),
        finite: bool = False,
    ) -> Array:
        """Return a dataset, or one save of it.

        Parameters
        ----------
        name : str
            The dataset.
        index : int or slice, optional
            The save; all if left out.
        shapes : collection of tuple, optional
            What the dataset may have as its shape; any if left out.
        finite : bool, optional
            Whether a number that is not is refused; floats come back.
        """
        save = f" of save {index}" if isinstance(index, int) else ""
        with self.reading(f"{name!r}{save}"):
            dataset = self.file[name]
            if not isinstance(dataset, h5py.Dataset) or dataset.dtype.kind not in "fiu":
                raise ValueError("it is no array of real numbers")
            if self._sealed is not None and dataset.nbytes > MOST_PACKED * self._sealed.size:
                raise ValueError(f"it claims {dataset.nbytes:.3g} bytes, more than the file holds")
            if shapes and dataset.shape not in shapes:
                needed = " or ".join(map(str, shapes))
                raise ValueError(f"its shape is {dataset.shape} instead of {needed}")
            values = np.asarray(dataset[index], np.float64 if finite else None)
            if finite and not (np.abs(values) < LARGEST).all():
                raise ValueError("it is not finite, or above 1e100")
            return values

    def text(self, name: str) -> str:
        """Return text that `tribo.result.store.write_text` stored."""
        data = self.array(name)
        with self.reading(repr(name)):
            return data.tobytes().decode()

    def numbers(
        self, name: str, count: int = 1, *, above: float = -np.inf, of: str = "/"
    ) -> tuple[float, ...]:
        """Return an attribute of the file, or of a group of it, that is so many finite numbers."""
        with self.reading(repr(name)):
            values = np.asarray(self.file[of].attrs[name])
            if values.size != count or values.dtype.kind not in "fiu":
                raise ValueError(f"it is {values.tolist()!r:.60}, not {count} of numbers")
            if not ((np.abs(values) < LARGEST) & (values > above)).all():
                raise ValueError(f"it is {values.tolist()}, not finite and above {above:g}")
            return tuple(float(value) for value in values.ravel())

    def attribute(self, name: str, *default: object) -> Any:
        """Return an attribute of the file."""
        with self.reading(repr(name)):
            attributes = self.file.attrs
            return attributes.get(name, *default) if default else attributes[name]

    @contextmanager
    def reading(self, what: str) -> Iterator[None]:
        """Say what of the file is damaged, whatever HDF5 raises of it."""
        try:
            yield
        except (OSError, LookupError, RuntimeError, ValueError, TypeError, AttributeError) as error:
            raise CaseError(f"{self.name} is damaged: {what} cannot be read ({error})") from error


def _is_text(path: Path) -> bool:
    """Whether a file is text, which has no zeros, as an HDF5 file has from its first bytes on."""
    with path.open("rb") as file:
        head = file.read(1000)
    return bool(head) and b"\0" not in head
