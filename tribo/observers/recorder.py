"""Write the result file and its checkpoint."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

from pydantic import PrivateAttr

from tribo.core.errors import CaseError, OutputError
from tribo.core.state import RunInfo, Snapshot
from tribo.core.units import Quantity
from tribo.observers.observer import Observer
from tribo.result.checkpoint import remove_checkpoint, write_checkpoint
from tribo.result.guarded import GuardedFile
from tribo.result.read import Result
from tribo.result.store import ResultWriter

SYNC_EVERY = 1.0
"""Wall time between waits for the disk, in s. A power failure may lose what came in between, a
kill does not."""


class Recorder(Observer):
    """Writes a result file, and beside it a checkpoint to resume from."""

    type = "recorder"
    path: Path | None = None
    """Where to write; in memory if left out."""
    overwrite: bool = False
    """Whether an existing file may be replaced."""
    checkpoint_every: Annotated[float, Quantity("s", at_least=0)] = 10.0
    """Wall time between checkpoints; one is also written at every save."""

    _writer: ResultWriter = PrivateAttr()
    _clock: float = 0.0
    _spent_before: float = 0.0
    _last_checkpoint: float = 0.0
    _synced: float = 0.0
    _kept_synced: bool = True
    _saved: float = -1.0
    _saves: int = 0
    _case: Mapping[str, object] = PrivateAttr(default_factory=dict)

    def model_post_init(self, context: Any, /) -> None:
        """Make the writer."""
        self._writer = ResultWriter(self.path)

    def on_start(self, run: RunInfo) -> None:
        """Create the file, or go on with it."""
        self._clock = self._last_checkpoint = time.monotonic()
        self._case = run.case
        with self._writing():
            if run.resumed_from is None or self.path is None:
                self._make_room()
                self._writer.create(run)
                # Not before the file is ours: another process may be writing it.
                if self.path is not None:
                    remove_checkpoint(self.path)
            else:
                self._spent_before = run.wall_time
                self._saved = run.resumed_from.state.time
                self._saves = run.resumed_from.state.saves
                self._writer.reopen(run, run.resumed_from.state)
                # Gone on with other versions, the file keeps the case it was begun with.
                self._case = self._writer.case()

    def on_step(self, snapshot: Snapshot) -> None:
        """Add to the history; now and then write a checkpoint."""
        self._writer.append_step(snapshot.measures)
        # A state that counts a save still to be written has its checkpoint with that.
        if snapshot.state.saves > self._saves:
            return
        if time.monotonic() - self._last_checkpoint > self.checkpoint_every:
            self._checkpoint(snapshot)

    def on_save(self, snapshot: Snapshot) -> None:
        """Write the fields and a checkpoint; when this returns the save is safe."""
        with self._writing():
            self._writer.append_save(snapshot)
        self._saved, self._saves = snapshot.state.time, snapshot.state.saves
        self._checkpoint(snapshot)

    def on_finish(self, snapshot: Snapshot | None, reason: str) -> None:
        """Write what is left; keep the checkpoint unless the run is done."""
        try:
            with self._writing():
                if snapshot is not None and reason != "done":
                    self._checkpoint(snapshot)
                    if snapshot.state.time != self._saved:
                        # For the user to see; resuming drops it again.
                        self._writer.append_save(snapshot)
                    self._writer.note(snapshot.state.notices)
                self._writer.finish(reason, self._spent())
        finally:
            if self.path is not None:
                self._writer.close()
        if self.path is not None and reason == "done":
            remove_checkpoint(self.path)

    def result(self) -> Result:
        """Return what was recorded, for reading."""
        if self.path is not None:
            return Result.open(self.path)
        return Result(GuardedFile(self._writer.file, "the result"))

    def _make_room(self) -> None:
        """Refuse to replace a file unasked."""
        path = self.path
        if path is None:
            return
        if os.path.exists(path) and not self.overwrite:
            raise CaseError(f"{path} exists; choose another path, or set overwrite = true")

    def _checkpoint(self, snapshot: Snapshot) -> None:
        if self.path is None:
            return
        now = time.monotonic()
        sync = now - self._synced > SYNC_EVERY
        with self._writing():
            # The file must hold every row that the checkpoint counts.
            self._writer.commit(sync=sync)
            # The one before is one that would outlive a power failure.
            write_checkpoint(
                self.path,
                snapshot.state,
                self._spent(),
                self._case,
                sync=sync,
                keep=self._kept_synced,
            )
        self._last_checkpoint = now
        self._kept_synced = sync
        if sync:
            self._synced = now

    def _spent(self) -> float:
        return self._spent_before + time.monotonic() - self._clock

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except (OSError, RuntimeError) as error:
            reason = getattr(error, "strerror", None) or error
            remedy = "" if isinstance(error, PermissionError) else "free space or "
            raise OutputError(
                f"cannot write {self.path}: {reason}; {remedy}choose another place with "
                "-o; what was saved before is intact"
            ) from error
