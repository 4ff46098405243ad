"""Write a result as a run proceeds: parts and checkpoints, and at its end one file of them all."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import Any

from tribo.core.errors import CaseError
from tribo.core.measures import Measures
from tribo.core.notices import Notice, worn_through
from tribo.core.state import RunInfo, Snapshot, State
from tribo.result.checkpoint import Checkpoint, RunFolder, fingerprint
from tribo.result.hdf5 import empty_image, filled_image
from tribo.result.layout import EFFECT, Rows, part_of, save_row, step_row, variables
from tribo.result.read import Result
from tribo.result.sealed import write_sealed


class ResultWriter:
    """The result of a run that goes on, in a file; in memory if the path is None."""

    def __init__(self, path: Path | None = None) -> None:
        self._path = None if path is None else path.resolve()
        self._folder = None if self._path is None else RunFolder(self._path)
        self._run: RunInfo
        self._empty: bytes
        self._image: BytesIO
        self._kept: list[Rows] = []
        self._count = 0
        self._steps: list[Rows] = []
        self._saves: list[Rows] = []
        self.saves = 0
        """Saves so far."""
        self.rows = 0
        """Steps of the history so far, the first contact counted."""

    def create(self, run: RunInfo) -> None:
        """Begin a new result, in the place of what is there."""
        self._begin(run)
        if self._path is None or self._folder is None:
            return
        if self._path.exists() and not self._path.is_file():
            raise CaseError(f"{self._path} is not a file that could be replaced; choose another")
        self._folder.lock()
        try:
            self._folder.clear()
            self._write(BytesIO(self._empty))
        except BaseException:
            self._folder.remove()
            raise

    def reopen(self, run: RunInfo) -> None:
        """Go on with the result of an earlier process, from its checkpoint."""
        if self._path is None or self._folder is None:
            raise CaseError("a result in memory cannot be resumed")
        self._folder.lock()
        try:
            with Result(self._path, str(self._path)) as stopped:
                self._begin(run, provenance=json.dumps(_gone_on_with(stopped, run)))
                # Another version of a component may have added keys to the case of the run.
                checkpoint, _ = self._folder.read_checkpoint(stopped.case)
            self._write(BytesIO(self._empty))
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
        self._saves.append(save_row(snapshot, self._table))
        self.saves += 1

    def checkpoint(self, state: State, wall_time: float) -> None:
        """Write what was added, and the state after it with the time spent so far, in s."""
        self._finish_part()
        if self._folder is not None:
            kept = Checkpoint(self._case, state, wall_time, self._count, self.saves, self.rows)
            self._folder.write_checkpoint(kept)

    def finish(self, status: str, wall_time: float, notices: Sequence[Notice] = ()) -> None:
        """Write the whole result, and how the run ended."""
        self._finish_part()
        parts: Iterable[Rows] = (
            self._kept if self._folder is None else self._folder.parts(self._count)
        )
        image = filled_image(
            self._empty,
            parts,
            self.saves,
            self.rows,
            status=status,
            wall_time_s=wall_time,
            notices=json.dumps([str(notice) for notice in notices]),
            worn_through=json.dumps(worn_through(notices)),
        )
        if self._folder is None:
            self._image = image
        self._write(image)
        if self._folder is not None and status == "done":
            self._folder.remove()

    def close(self) -> None:
        """Let other processes write the result."""
        if self._folder is not None:
            self._folder.unlock()

    def result(self) -> Result:
        """Return the result."""
        return Result.open(self._path) if self._path else Result(self._image, "the result")

    @cached_property
    def _case(self) -> str:
        # With a map of heights in the case this takes as long as a step.
        return fingerprint(self._run.case)

    def _begin(self, run: RunInfo, **changed: Any) -> None:
        self._run, self._table = run, variables(run)
        self._empty = empty_image(run, **changed)

    def _finish_part(self) -> None:
        part = {**part_of(self._steps), **part_of(self._saves)}
        if not part:
            return
        if self._folder is None:
            self._kept.append(part)
        else:
            self._folder.write_part(self._count, part)
        self._count += 1
        self._steps, self._saves = [], []

    def _write(self, image: BytesIO) -> None:
        if self._path is not None and self._folder is not None:
            fresh = self._folder.path / "result.new"
            write_sealed(self._path, image.getbuffer(), fresh=fresh, sync=True)


def _gone_on_with(stopped: Result, run: RunInfo) -> dict[str, Any]:
    """Return the provenance of a stopped run, with what it goes on with."""
    provided = {field.name for field in run.effect_fields}
    kept = {field.name for field in stopped.fields_of(EFFECT).values()}
    if kept != provided:
        raise CaseError(
            f"the effects provide {', '.join(sorted(provided)) or 'nothing'}, but the result keeps "
            f"{', '.join(sorted(kept)) or 'nothing'} of them; start again with 'tribo run --force'"
        )
    made = dict(stopped.provenance)
    before = made.get("resumed_with", [])
    last = before[-1] if before else made
    if any(last.get(key) != value for key, value in run.provenance.items()):
        made["resumed_with"] = [*before, dict(run.provenance)]
    return made
