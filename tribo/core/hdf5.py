"""HDF5 files from unknown sources: only the data inside the file is read."""

from __future__ import annotations

import atexit
from collections.abc import Iterator
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import h5py

MARK = b"\x89HDF\r\n\x1a\n"
"""First bytes of such a file."""


def open_hdf5(file: Path | BytesIO, mode: str = "r") -> h5py.File:
    """Open a file, to read it or in another mode of h5py."""
    # Slow to import: a case that is only read or checked needs no file.
    import h5py

    _close_at_exit()
    return h5py.File(file, mode)


@cache
def _close_at_exit() -> None:
    """Let what is in memory be closed while Python is there: HDF5 would do so later, and crash."""
    import h5py

    def close() -> None:
        for each in map(h5py.File, h5py.h5f.get_obj_ids(types=h5py.h5f.OBJ_FILE)):
            if each.driver == "fileobj":
                each.close()

    atexit.register(close)


def contained(file: h5py.File) -> Iterator[h5py.Dataset]:
    """Yield the datasets of a file, each once; ValueError where it refers to another file.

    No value is read, and no soft link followed.
    """
    import h5py

    groups: list[h5py.Group] = [file]
    known = set()
    while groups:
        group = groups.pop()
        for name in group:
            link = group.get(name, getlink=True)
            if isinstance(link, h5py.SoftLink):
                continue
            if not isinstance(link, h5py.HardLink):
                raise ValueError(f"{name!r} is a link to another file")
            item = group[name]
            place = h5py.h5o.get_info(item.id).addr
            if place in known:
                continue
            known.add(place)
            if isinstance(item, h5py.Group):
                groups.append(item)
            elif isinstance(item, h5py.Dataset):
                if item.is_virtual or item.external:
                    raise ValueError(f"{name!r} has its values in another file")
                chunks = item.chunks
                if chunks is not None and (len(chunks) != item.ndim or 0 in chunks):
                    # HDF5 would divide by zero (CVE-2026-19025).
                    raise ValueError(f"{name!r} of shape {item.shape} has chunks of {chunks}")
                yield item
