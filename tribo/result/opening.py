"""Open a result file, also of a run that is in progress or was killed."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.findings import as_json, damaged
from tribo.core.hdf5 import MARK, contained, open_hdf5
from tribo.core.words import similar_file
from tribo.result.checkpoint import RunFolder
from tribo.result.hdf5 import filled_image
from tribo.result.header import FORMAT
from tribo.result.sealed import open_sealed

_RESULT = "the .h5 file that 'tribo run' wrote"
_DENSEST = 1032
"""Largest factor by which deflate, which compresses a result, makes data smaller."""


@contextmanager
def interpreting(name: str) -> Iterator[None]:
    """Turn any error that the contents of a file lead to into a CaseError of one line."""
    try:
        yield
    except (CaseError, Warning):
        raise
    except Exception as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise CaseError(f"{name} is damaged: {reason}") from error


def source_of(path: Path) -> Path | BytesIO:
    """Return a result file, or for a run that is not done all that it has saved so far."""
    if not is_unfinished(path):
        return path
    folder = RunFolder(path.resolve())
    with interpreting(str(path)):
        try:
            return _saved_so_far(path, folder)
        except (CaseError, OSError) as error:
            reason = "its run is in progress and cannot be read yet; try again"
            raise CaseError(f"{path}: {reason if folder.busy() else error}") from error


def is_unfinished(path: Path) -> bool:
    """Whether a result file belongs to a run that is in progress, or was killed."""
    if not os.path.isfile(path):
        if RunFolder(path.resolve()).path.is_dir():
            raise CaseError(
                f"{path}: its run ended before its first save; 'tribo run --force' starts again"
            )
        remedy = similar_file(path, ".h5", f"give {_RESULT}")
        raise CaseError(f"{path} is not a file; {remedy}")
    try:
        with path.open("rb") as file:
            if file.read(len(MARK)) != MARK:
                make = f"; if it is a case, make its result with: tribo run {path}"
                hint = make if path.suffix == ".toml" else f"; give {_RESULT}"
                raise CaseError(f"{path} is not a result{hint}")
        open_sealed(path).close()
    except OSError as error:
        raise CaseError(f"{path} cannot be read: {error.strerror}") from error
    with interpreting(str(path)), open_hdf5(path) as file:
        written = file.attrs.get("tribo_format")
        if not np.array_equal(written, FORMAT):
            raise CaseError(
                f"{path} has format {written}, and this tribo reads format {FORMAT}: read it with "
                "the tribo that wrote it, or run its case again"
            )
        promised = sum(values.nbytes for values in contained(file))
        if promised > _DENSEST * file.id.get_filesize():
            raise ValueError(f"it promises {promised / 1e6:.3g} MB, more than it can hold")
        return bool(file.attrs["status"] == "running")


def _saved_so_far(path: Path, folder: RunFolder) -> BytesIO:
    """Return the file that the run would write now, with its status: running or killed."""
    status = "running" if folder.busy() else "killed"
    empty = path.read_bytes()
    with open_hdf5(BytesIO(empty)) as file:
        case = json.loads(file.attrs["case"])
    kept, damage = folder.read_checkpoint(case)
    state = kept.state.with_findings(damaged(damage)) if damage else kept.state
    parts, findings = folder.parts(kept.parts), as_json(state.findings)
    return filled_image(empty, parts, kept.saves, kept.rows, status=status, findings=findings)
