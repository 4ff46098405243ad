"""Write a result as a run proceeds: parts and checkpoints, and at its end one file of them all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import closing
from pathlib import Path

import numpy as np

from tribo.core.errors import CaseError
from tribo.core.measures import Measures
from tribo.core.notices import Notice
from tribo.core.state import RunInfo, Snapshot, State
from tribo.result.checkpoint import Checkpoint, RunFolder, fingerprint
from tribo.result.hdf5 import Frame, Part, hdf5_image
from tribo.result.layout import EFFECT, save_row, step_row
from tribo.result.opening import contents_in_memory, contents_of_file
from tribo.result.read import Result
from tribo.result.sealed import write_sealed


class ResultWriter:
    """The result of a run that goes on.

    Parameters
    ----------
    path : Path or None
        Where to write; None keeps the result in memory.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = None if path is None else path.resolve()
        self._folder = None if self._path is None else RunFolder(self._path)
        self._frame: Frame
        self._kept: list[Part] = []
        self._count = 0
        self._steps: list[Part] = []
        self._saves: list[Part] = []
        self.saves = 0
        """Saves so far."""
        self.rows = 0
        """Steps of the history so far, the first contact counted."""

    def create(self, run: RunInfo) -> None:
        """Begin a new result, in the place of what is there.

        Raises
        ------
        CaseError
            If another process is writing it, or it is not a file.
        """
        self._frame = Frame.of_run(run)
        if self._path is None or self._folder is None:
            return
        if self._path.exists() and not self._path.is_file():
            raise CaseError(f"{self._path} is not a file that could be replaced; choose another")
        self._folder.lock()
        try:
            self._folder.clear()
            self._write(())
        except BaseException:
            self._folder.remove()
            raise

    def reopen(self, run: RunInfo) -> None:
        """Go on with the result of an earlier process, from its checkpoint."""
        if self._path is None or self._folder is None:
            raise CaseError("a result in memory cannot be resumed")
        self._folder.lock()
        try:
            with closing(contents_of_file(self._path)) as stopped:
                self._frame = _continued(stopped.frame(), run)
            checkpoint = self._folder.read_checkpoint()
            # What came after it must not be counted again.
            self._folder.write_checkpoint(checkpoint, sync=True)
            self._write(())
        except BaseException:
            self._folder.unlock()
            raise
        self._count, self.saves, self.rows = checkpoint.parts, checkpoint.saves, checkpoint.rows

    def append_step(self, measures: Measures) -> None:
        """Add a row to the history; it is written with the next checkpoint."""
        self._steps.append(step_row(measures))
        self.rows += 1

    def append_save(self, snapshot: Snapshot) -> None:
        """Add a save; it is written with the next checkpoint."""
        self._saves.append(save_row(snapshot, self._frame.variables))
        self.saves += 1

    def checkpoint(self, state: State, wall_time: float, *, sync: bool) -> None:
        """Write what was added, and the state that belongs to it.

        Parameters
        ----------
        state : State
            The state after all that was added.
        wall_time : float
            Time spent so far, in s.
        sync : bool
            Whether to wait until it would survive a power failure.
        """
        self._finish_part()
        if self._folder is not None:
            case = fingerprint(self._frame.header.case)
            kept = Checkpoint(case, state, wall_time, self._count, self.saves, self.rows)
            self._folder.write_checkpoint(kept, sync=sync)

    def finish(self, status: str, wall_time: float, notices: Sequence[Notice] = ()) -> None:
        """Write the whole result, and how the run ended."""
        self._finish_part()
        self._frame = self._frame.with_header(
            status=status, wall_time_s=wall_time, notices=[str(notice) for notice in notices]
        )
        self._write(self._parts())
        if self._folder is not None and status == "done":
            self._folder.remove()

    def close(self) -> None:
        """Let other processes write the result."""
        if self._folder is not None:
            self._folder.unlock()

    def result(self) -> Result:
        """Return the result."""
        if self._path is not None:
            return Result.open(self._path)
        return Result(
            contents_in_memory(self._frame, self._parts(), self.saves, self.rows, "the result")
        )

    def _finish_part(self) -> None:
        part = {**_stacked(self._steps), **_stacked(self._saves)}
        if not part:
            return
        if self._folder is None:
            self._kept.append(part)
        else:
            self._folder.write_part(self._count, part)
        self._count += 1
        self._steps, self._saves = [], []

    def _parts(self) -> Iterable[Part]:
        return self._kept if self._folder is None else self._folder.parts(self._count)

    def _write(self, parts: Iterable[Part]) -> None:
        if self._path is None or self._folder is None:
            return
        fresh = self._folder.path / "result.new"
        image = hdf5_image(self._frame, parts, self.saves, self.rows)
        write_sealed(self._path, image.getbuffer(), fresh=fresh, sync=True)


def _stacked(rows: Sequence[Part]) -> Part:
    names = rows[0] if rows else ()
    return {name: np.stack([row[name] for row in rows]) for name in names}


def _continued(frame: Frame, run: RunInfo) -> Frame:
    """Return the frame of a stopped run that goes on, with what it goes on with."""
    provided = {field.name for field in run.effect_fields}
    kept = {v.field for v in frame.variables.values() if v.kind == EFFECT}
    if kept != provided:
        raise CaseError(
            f"the effects provide {', '.join(sorted(provided)) or 'nothing'}, but the result keeps "
            f"{', '.join(sorted(kept)) or 'nothing'} of them; start again with 'tribo run --force'"
        )
    made = dict(frame.header.provenance)
    before = made.get("resumed_with", [])
    last = before[-1] if before else made
    if any(last.get(key) != value for key, value in run.provenance.items()):
        made["resumed_with"] = [*before, dict(run.provenance)]
    return frame.with_header(status="running", wall_time_s=None, provenance=made)
