"""Open a result file, that of a run which goes on or was killed too."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from tribo.core.errors import CaseError
from tribo.result.checkpoint import RunFolder, fingerprint
from tribo.result.hdf5 import Contents, Frame, Part, hdf5_image
from tribo.result.sealed import check_sealed


def contents_of(path: Path) -> Contents:
    """Return the contents of a result file, or of all that its run has saved so far.

    Raises
    ------
    CaseError
        If there is no such file, it is not a tribo result, or it is damaged.
    """
    contents = contents_of_file(path)
    if contents.header.status != "running":
        return contents
    folder = RunFolder(path.resolve())
    try:
        checkpoint = folder.read_checkpoint()
        if checkpoint.case != fingerprint(contents.header.case):
            return contents
        notices = [str(notice) for notice in checkpoint.state.notices]
        frame = contents.frame().with_header(notices=notices)
        so_far = contents_in_memory(
            frame, folder.parts(checkpoint.parts), checkpoint.saves, checkpoint.rows, str(path)
        )
    except (CaseError, OSError) as error:
        contents.close()
        # The run may have ended since, and taken its folder with it.
        contents = contents_of_file(path)
        if contents.header.status == "running" and folder.has_checkpoint:
            raise CaseError(
                f"{path}: what its run has saved cannot be read: {error}; start again with "
                "'tribo run --force'"
            ) from error
        return contents
    contents.close()
    return so_far


def contents_of_file(path: Path) -> Contents:
    """Return the contents of a file, without what its run has saved beside it."""
    if not os.path.isfile(path):
        raise CaseError(f"{path} is not a file; give the .h5 file that 'tribo run' wrote")
    try:
        check_sealed(path)
    except OSError as error:
        raise CaseError(f"{path} cannot be read: {error.strerror}") from error
    except CaseError as error:
        if _is_text(path):
            raise CaseError(
                f"{path} is not a whole tribo file but text; if it is a case: tribo run {path}"
            ) from error
        raise
    return Contents(path, str(path))


def contents_in_memory(
    frame: Frame, parts: Iterable[Part], saves: int, steps: int, name: str
) -> Contents:
    """Return the contents of a result that is in memory."""
    return Contents(hdf5_image(frame, parts, saves, steps), name)


def _is_text(path: Path) -> bool:
    """Whether a file is text, which has no zeros, as an HDF5 file has from its first bytes on."""
    with path.open("rb") as file:
        head = file.read(1000)
    return bool(head) and b"\0" not in head
