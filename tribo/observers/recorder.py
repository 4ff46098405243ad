"""Write a result as a run proceeds: parts and checkpoints, and at its end one file of them all."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

from pydantic import PrivateAttr

from tribo.core.errors import CaseError, OutputError, warn
from tribo.core.findings import as_json
from tribo.core.state import RunInfo, Snapshot, State
from tribo.core.writing import move
from tribo.observers.observer import Observer
from tribo.result.checkpoint import Checkpoint, RunFolder, fingerprint, store
from tribo.result.hdf5 import empty_image, filled_image
from tribo.result.layout import EFFECT, SAVED, Rows, Variable
from tribo.result.read import Result
from tribo.result.rows import constants, header_of, part_of, save_row, step_row, variables
from tribo.result.sealed import write_sealed


class Recorder(Observer):
    """Writes a result file, and beside it checkpoints to resume from; in memory without a path."""

    path: Path | None = None
    checkpoint_every: float = 10.0
    """Wall time between checkpoints, in s; one is also written at every save."""

    _folder: RunFolder | None = None
    _table: Mapping[str, Variable] = PrivateAttr(default_factory=dict)
    _empty: bytes = b""
    _image: BytesIO = PrivateAttr()
    _case: str = ""
    _steps: list[Rows] = PrivateAttr(default_factory=list)
    _saves: list[Rows] = PrivateAttr(default_factory=list)
    _count: int = 0
    """Parts so far."""
    _saved: int = 0
    """Saves so far."""
    _rows: int = 0
    """Steps of the history so far, the first contact counted."""
    _begun: bool = False
    _clock: float = 0.0
    _spent_before: float = 0.0
    _last_checkpoint: float = -math.inf
    _last_save: float = -1.0

    def model_post_init(self, context: Any, /) -> None:
        """Find the folder of the run."""
        if self.path is not None:
            self._folder = RunFolder(self.path.resolve())

    def resume(self, case: Mapping[str, object]) -> tuple[State, float]:
        """Return the last good state of the stopped run of a case, and the time spent, in s.

        Where the newest checkpoint is damaged, it is the state of the one before; a warning says
        so, and the run continues as if the newest had not been written. `CaseError` if another
        process is writing the file, or no good checkpoint is of this case.
        """
        folder = self._folder
        assert folder is not None
        if folder.path.is_dir():
            # The saved data of a run in progress change as they are read.
            folder.lock()
        try:
            kept, damage = folder.read_checkpoint(case)
            if damage:
                warn(
                    f"{damage}; going on from the checkpoint before, at {kept.state.time:.6g} s",
                )
                move(folder.previous, folder.checkpoint)
        except CaseError as error:
            raise CaseError(f"{self.path} cannot be resumed: {error}") from error
        finally:
            folder.unlock()
        self._count, self._saved, self._rows = kept.parts, kept.saves, kept.rows
        self._spent_before, self._last_save = kept.wall_time, kept.state.time
        return kept.state, kept.wall_time

    def on_start(self, run: RunInfo) -> None:
        """Create the file, or go on with it."""
        self._clock = time.monotonic()
        # With a map of heights in the case this takes as long as a step.
        self._case, self._table = fingerprint(run.case), variables(run)
        resumed, folder = run.resumed_from is not None, self._folder
        header, values = header_of(run), constants(run)
        with self._writing():
            if folder is None:
                self._empty = empty_image(header, self._table, values)
                return
            folder.lock()
            try:
                if resumed:
                    self._last_checkpoint = self._clock
                    with Result(folder.result, str(folder.result)) as stopped:
                        made = _gone_on_with(stopped, run)
                    header = header.model_copy(update={"provenance": made})
                else:
                    folder.clear()
                self._empty = empty_image(header, self._table, values)
                self._write(BytesIO(self._empty))
            except BaseException:
                # Of a run that was stopped its checkpoints stay.
                folder.unlock() if resumed else folder.remove()
                raise
        self._begun = True

    def on_step(self, snapshot: Snapshot) -> None:
        """Add to the history; now and then write a checkpoint."""
        self._append_step(snapshot)
        due = time.monotonic() - self._last_checkpoint >= self.checkpoint_every
        # A state that counts a save still to be written has its checkpoint with that.
        if due and snapshot.state.saves == self._saved:
            self._checkpoint(snapshot.state)

    def on_save(self, snapshot: Snapshot) -> None:
        """Write the fields and a checkpoint; when this returns, the disk has the save."""
        self._append_save(snapshot)
        self._checkpoint(snapshot.state)

    def on_finish(self, snapshot: Snapshot | None, reason: str) -> None:
        """Write the whole result; keep the checkpoint unless the run is done."""
        folder, findings = self._folder, () if snapshot is None else snapshot.state.findings
        try:
            with self._writing():
                if snapshot is not None and reason != "done":
                    self._keep_last(snapshot)
                self._image = filled_image(
                    self._empty,
                    self._parts(),
                    self._saved,
                    self._rows,
                    status=reason,
                    wall_time_s=self._spent(),
                    findings=as_json(findings),
                )
                if folder is not None:
                    self._write(self._image)
                    if reason == "done":
                        folder.remove()
        finally:
            if folder is not None:
                folder.unlock()

    @property
    def holds(self) -> Path | None:
        """The file that holds what was saved, if it was begun."""
        return self.path if self._begun else None

    def result(self) -> Result:
        """Return the recorded result, for reading."""
        folder = self._folder
        return Result(self._image, "the result") if folder is None else Result.open(folder.result)

    def _append_step(self, snapshot: Snapshot) -> None:
        self._steps.append(step_row(snapshot, self._table))
        self._rows += 1

    def _append_save(self, snapshot: Snapshot) -> None:
        self._saves.append(save_row(snapshot, self._table))
        self._saved += 1
        self._last_save = snapshot.state.time

    def _parts(self) -> Iterator[Rows]:
        """Yield all parts, and what was added since."""
        if self._folder is not None:
            yield from self._folder.parts(self._count)
        yield part_of(self._steps)
        for row in self._saves:
            yield part_of([row])

    def _checkpoint(self, state: State) -> None:
        """Write what was added, and the state after it."""
        if self._folder is None:
            return
        with self._writing():
            if part := part_of(self._steps) | part_of(self._saves):
                store(self._folder.part(self._count), part)
                self._count += 1
                self._steps, self._saves = [], []
            kept = self._case, state, self._spent(), self._count, self._saved, self._rows
            self._folder.write_checkpoint(Checkpoint(*kept))
        self._last_checkpoint = time.monotonic()

    def _keep_last(self, snapshot: Snapshot) -> None:
        """Write the moment at which the run ends before its time."""
        state = snapshot.state
        if self._rows <= state.steps:
            self._append_step(snapshot)
        # An effect that failed has left none.
        whole = snapshot.effects or not any(v.kind == EFFECT for v in self._table.values())
        if whole and self._saved < state.saves:
            self._append_save(snapshot)
        if self._saved == state.saves:
            self._checkpoint(state)
        if state.time != self._last_save:
            # For the user to see; it belongs to no checkpoint.
            self._append_save(snapshot)

    def _spent(self) -> float:
        return self._spent_before + time.monotonic() - self._clock

    def _write(self, image: BytesIO) -> None:
        assert self._folder is not None
        write_sealed(self._folder.result, image.getbuffer(), through=self._folder.path)

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except (OutputError, OSError, RuntimeError) as error:
            cause = error.__cause__ or error
            reason = getattr(cause, "strerror", None) or cause
            remedy = "" if isinstance(cause, PermissionError) else "free space or "
            raise OutputError(
                f"cannot write {self.path}: {reason}; {remedy}choose another place with "
                "-o; the last checkpoint is intact"
            ) from error


def _gone_on_with(stopped: Result, run: RunInfo) -> dict[str, Any]:
    """Return the provenance of a stopped run, with the provenance of its continuation."""
    provided = {field.name for field in run.effect_fields} | {c.name for c in run.columns}
    kept = {f.name for kind in (EFFECT, *SAVED) for f in stopped.fields_of(kind).values()}
    if kept != provided:
        raise CaseError(
            f"the models provide {', '.join(sorted(provided)) or 'nothing'}, but the result keeps "
            f"{', '.join(sorted(kept)) or 'nothing'} of them; start again with 'tribo run --force'"
        )
    made = dict(stopped.provenance)
    before = made.get("resumed_with", [])
    last = before[-1] if before else made
    if any(last.get(key) != value for key, value in run.provenance.items()):
        made["resumed_with"] = [*before, dict(run.provenance)]
    return made
