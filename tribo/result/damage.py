"""What of a damaged file cannot be read."""

from __future__ import annotations

import h5py

_LISTED = 6
_DEEPEST = 5
"""Groups in each other; a result has four, and in another file they may go round in a circle."""


def unreadable(file: h5py.File) -> list[str]:
    """Return what of a result cannot be read, at most six of it by name.

    A field is named with the saves that are lost of it.
    """
    lost: list[str] = []
    _visit(file, "", lost)
    if len(lost) > _LISTED:
        lost = [*lost[:_LISTED], f"{len(lost) - _LISTED} more"]
    return lost


def _visit(group: h5py.Group, path: str, lost: list[str]) -> None:
    if path.count("/") >= _DEEPEST:
        return
    try:
        dict(group.attrs)
        names = list(group)
    except Exception:
        # HDF5 raises what it will.
        lost.append(repr(path) if path else "the list of its parts")
        return
    for name in names:
        inner = f"{path}/{name}".lstrip("/")
        try:
            item = group[name]
            dict(item.attrs)
        except Exception:
            lost.append(repr(inner))
            continue
        if isinstance(item, h5py.Group):
            _visit(item, inner, lost)
        else:
            lost += _of_dataset(item, inner)


def _of_dataset(dataset: h5py.Dataset, path: str) -> list[str]:
    if dataset.ndim == 1 or dataset.maxshape[0] is not None:
        return [] if _readable(dataset, slice(None)) else [repr(path)]
    saves = [str(save) for save in range(len(dataset)) if not _readable(dataset, save)]
    if not saves:
        return []
    return [f"{path!r} of save{'s' if len(saves) > 1 else ''} {', '.join(saves)}"]


def _readable(dataset: h5py.Dataset, index: int | slice) -> bool:
    try:
        dataset[index]
    except Exception:
        return False
    return True
