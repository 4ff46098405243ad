"""Write the result file and its checkpoints."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

from pydantic import PrivateAttr

from tribo.core.errors import CaseError, OutputError
from tribo.core.state import RunInfo, Snapshot
from tribo.core.units import Quantity
from tribo.observers.observer import Observer
from tribo.result.read import Result
from tribo.result.store import ResultWriter


class Recorder(Observer):
    """Writes a result file, and beside it checkpoints to resume from."""

    type = "recorder"
    path: Path | None = None
    """Where to write; in memory if left out."""
    overwrite: bool = False
    """Whether an existing file may be replaced."""
    checkpoint_every: Annotated[float, Quantity("s", at_least=0)] = 10.0
    """Wall time between checkpoints; one is also written at every save."""

    _writer: ResultWriter = PrivateAttr()
    _begun: bool = False
    _effects: bool = False
    _clock: float = 0.0
    _spent_before: float = 0.0
    _last_checkpoint: float = -math.inf
    _saved: float = -1.0

    def model_post_init(self, context: Any, /) -> None:
        """Make the writer."""
        self._writer = ResultWriter(self.path)

    def on_start(self, run: RunInfo) -> None:
        """Create the file, or go on with it."""
        self._clock = time.monotonic()
        self._effects = bool(run.effect_fields)
        with self._writing():
            if run.resumed_from is not None and self.path is not None:
                self._spent_before, self._last_checkpoint = run.wall_time, self._clock
                self._saved = run.resumed_from.state.time
                self._writer.reopen(run)
                self._begun = True
                return
            if self.path is not None and os.path.exists(self.path) and not self.overwrite:
                raise CaseError(f"{self.path} exists; choose another path, or set overwrite = true")
            self._writer.create(run)
            self._begun = True

    def on_step(self, snapshot: Snapshot) -> None:
        """Add to the history; now and then write a checkpoint."""
        self._writer.append_step(snapshot.measures)
        due = time.monotonic() - self._last_checkpoint >= self.checkpoint_every
        # A state that counts a save still to be written has its checkpoint with that.
        if due and snapshot.state.saves == self._writer.saves:
            self._checkpoint(snapshot)

    def on_save(self, snapshot: Snapshot) -> None:
        """Write the fields and a checkpoint; when this returns, the disk has the save."""
        self._writer.append_save(snapshot)
        self._saved = snapshot.state.time
        self._checkpoint(snapshot)

    def on_finish(self, snapshot: Snapshot | None, reason: str) -> None:
        """Write what is left; keep the checkpoint unless the run is done."""
        try:
            with self._writing():
                if snapshot is not None and reason != "done":
                    self._keep_last(snapshot)
                notices = () if snapshot is None else snapshot.state.notices
                self._writer.finish(reason, self._spent(), notices)
        finally:
            self._writer.close()

    @property
    def holds(self) -> Path | None:
        """The file that holds what was saved, if it was begun."""
        return self.path if self._begun else None

    def result(self) -> Result:
        """Return what was recorded, for reading."""
        return self._writer.result()

    def _keep_last(self, snapshot: Snapshot) -> None:
        """Write the moment at which the run ends before its time."""
        state, writer = snapshot.state, self._writer
        if writer.rows <= state.steps:
            writer.append_step(snapshot.measures)
        whole = bool(snapshot.effects) or not self._effects
        if whole and writer.saves < state.saves:
            writer.append_save(snapshot)
            self._saved = state.time
        if writer.saves == state.saves:
            self._checkpoint(snapshot)
        if state.time != self._saved:
            # For the user to see; it belongs to no checkpoint.
            writer.append_save(snapshot)

    def _checkpoint(self, snapshot: Snapshot) -> None:
        with self._writing():
            self._writer.checkpoint(snapshot.state, self._spent())
        self._last_checkpoint = time.monotonic()

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
                "-o; the last checkpoint is intact"
            ) from error
