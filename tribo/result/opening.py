"""Open a result file, that of a run which goes on or was killed too."""

from __future__ import annotations

import json
import os
from io import BytesIO
from pathlib import Path

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.findings import as_json, damaged
from tribo.core.hdf5 import open_hdf5
from tribo.result.checkpoint import RunFolder
from tribo.result.checks import check_contained, interpreting
from tribo.result.hdf5 import filled_image
from tribo.result.layout import FORMAT
from tribo.result.sealed import open_sealed


def source_of(path: Path) -> Path | BytesIO:
    """Return a result file, or for a run that is not done all that it has saved so far."""
    if not is_unfinished(path):
        return path
    folder = RunFolder(path.resolve())
    with interpreting(str(path)):
        try:
            return _saved_so_far(path, folder)
        except (CaseError, OSError) as error:
            # The run may have ended since, and taken its folder with it.
            if not is_unfinished(path):
                return path
            reason = "its run goes on, and what it saved cannot be read yet; try again"
            raise CaseError(f"{path}: {reason if folder.busy() else error}") from error


def is_unfinished(path: Path) -> bool:
    """Whether a result file is that of a run that goes on, or was killed."""
    if not os.path.isfile(path):
        if RunFolder(path.resolve()).path.is_dir():
            raise CaseError(
                f"{path}: its run ended before its first save; 'tribo run --force' starts again"
            )
        raise CaseError(f"{path} is not a file; give the .h5 file that 'tribo run' wrote")
    try:
        open_sealed(path).close()
    except OSError as error:
        raise CaseError(f"{path} cannot be read: {error.strerror}") from error
    except CaseError as error:
        import h5py

        if not h5py.is_hdf5(path):
            hint = f"; if it is a case: tribo run {path}" if path.suffix == ".toml" else ""
            raise CaseError(
                f"{path} is no result of tribo, or its beginning is damaged{hint}"
            ) from error
        raise CaseError(
            f"{error}; xarray may still read the fields whose own checksums match"
        ) from error
    with interpreting(str(path)), open_hdf5(path) as file:
        written = file.attrs.get("tribo_format")
        if not np.array_equal(written, FORMAT):
            raise CaseError(
                f"{path} has format {written}, and this tribo reads format {FORMAT}: read it with "
                "the tribo that wrote it, or run its case again"
            )
        check_contained(file)
        return bool(file.attrs["status"] == "running")


def _saved_so_far(path: Path, folder: RunFolder) -> BytesIO:
    """Return the file that the run would write now, with who writes it as its status."""
    status = "running" if folder.busy() else "killed"
    empty = path.read_bytes()
    with open_hdf5(BytesIO(empty)) as file:
        case = json.loads(file.attrs["case"])
    kept, damage = folder.read_checkpoint(case)
    state = kept.state.with_findings(damaged(damage)) if damage else kept.state
    parts = folder.parts(kept.parts)
    return filled_image(
        empty,
        parts,
        kept.saves,
        kept.rows,
        status=status,
        findings=as_json(state.findings),
    )
