"""The files of a run that is not done: its parts and its last two checkpoints.

Beside `my.h5` a folder `my.h5.run` holds them. A part has the rows that the
run added since the one before, and never changes. A checkpoint has the whole
state and says how many parts belong to it. Both wait for the disk. The
checkpoint before the newest is kept for the case that the newest is damaged.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import fields
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import IO, Any

import numpy as np
from pydantic import ConfigDict, ValidationError
from pydantic.dataclasses import dataclass

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, TriboError, warn
from tribo.core.locks import lock
from tribo.core.state import State
from tribo.core.writing import make_folder, move, open_lock, remove, remove_empty, writing
from tribo.result.layout import Rows
from tribo.result.sealed import open_sealed, write_sealed

_ARRAY = "array number"
_OWN = re.compile(r"lock|checkpoint(\.previous)?|\d{6,}\.part|tribo-[0-9a-f]{16}\.new")
"""Names of the files that a run makes."""
_WHOLE = ConfigDict(arbitrary_types_allowed=True, extra="forbid", defer_build=True)
"""A state is read as its classes have it, arrays as they are, and nothing else."""


@dataclass(frozen=True, config=_WHOLE)
class Checkpoint:
    """A state from which a run can continue, with the `fingerprint` of its case.

    `wall_time` is the time spent until then, in s; `parts` is the number of its parts, with their
    numbers of `saves` and of `rows` of the history.
    """

    case: str
    state: State
    wall_time: float
    parts: int
    saves: int
    rows: int


class RunFolder:
    """The folder of a run that is not done, beside its result file, which is not a link."""

    def __init__(self, result: Path) -> None:
        self.path = result.with_name(result.name + ".run")
        self.checkpoint = self.path / "checkpoint"
        self.previous = self.path / "checkpoint.previous"
        self.result = result
        self._lock: IO[bytes] | None = None

    def lock(self) -> None:
        """Make the folder, and keep other processes from writing.

        `CaseError` if one is, or the folder was not made by a run.
        """
        if not os.path.lexists(self.path):
            make_folder(self.path)
        place = self.path / "lock"
        with writing(self.path):
            own = self.path.is_dir() and (not any(self.path.iterdir()) or place.is_file())
        if not own or self.path.is_symlink() or place.is_symlink():
            raise CaseError(
                f"{self.path} was not made by tribo, which needs the name while it runs; rename "
                "it, or choose another place for the result with -o"
            )
        try:
            self._lock = hold(place)
        except BlockingIOError:
            raise CaseError(f"{self.result} is in use: another process is writing it") from None
        # What a process was writing that was killed.
        remove(*(path for path in self.path.glob("*.new") if _OWN.fullmatch(path.name)))

    def unlock(self) -> None:
        """Let other processes write the result."""
        if self._lock is not None:
            self._lock.close()

    def busy(self) -> bool:
        """Whether a process is writing the result, as far as can be told."""
        place = self.path / "lock"
        if not place.is_file():
            # A pipe would keep who opens it waiting.
            return False
        try:
            with place.open("rb") as file:
                return not lock(file.fileno())
        except FileNotFoundError:
            return False
        except OSError:
            return True

    def clear(self) -> None:
        """Remove the checkpoints and the parts."""
        own = (path for path in self.path.iterdir() if _OWN.fullmatch(path.name))
        remove(*(path for path in sorted(own) if path.name != "lock"))

    def remove(self) -> None:
        """Remove the folder of a run that is done, and end the lock."""
        with suppress(TriboError):
            self.clear()
        try:
            self._remove_lock()
        except TriboError:
            # An open file cannot be removed everywhere.
            self.unlock()
            with suppress(TriboError):
                self._remove_lock()
        self.unlock()

    def _remove_lock(self) -> None:
        remove(self.path / "lock")
        remove_empty(self.path)

    def parts(self, count: int) -> Iterator[Rows]:
        """Read the first parts, one after the other."""
        return (_load(self.part(number)) for number in range(count))

    def part(self, number: int) -> Path:
        """Return the file of a part."""
        return self.path / f"{number:06}.part"

    def write_checkpoint(self, checkpoint: Checkpoint) -> None:
        """Write a checkpoint, after its parts are written, and keep the one before."""
        if self.checkpoint.exists():
            move(self.checkpoint, self.previous)
        store(self.checkpoint, checkpoint)

    def read_checkpoint(self, case: Mapping[str, object]) -> tuple[Checkpoint, str]:
        """Return the newest sound checkpoint of a case, and the damage of a newer one.

        It and all its parts are whole. `CaseError` if there is none of this case; it names the fix
        where no process is writing the result.
        """
        if not self.path.is_dir():
            raise CaseError(
                f"its run saves in the folder {self.path.name}, which is not beside it; put that "
                "folder there, or take the result once its run is done"
            )
        if not (self.checkpoint.exists() or self.previous.exists()):
            raise CaseError("its run ended before its first save; 'tribo run --force' starts again")
        damage = []
        for path in (self.checkpoint, self.previous):
            try:
                checkpoint = self._sound(path, case)
            except (OSError, CaseError) as error:
                damage.append(str(error))
                continue
            if checkpoint is not None:
                return checkpoint, "; ".join(damage)
        raise CaseError("; ".join([*dict.fromkeys(damage), "start again with 'tribo run -o'"]))

    def _sound(self, path: Path, case: Mapping[str, object]) -> Checkpoint | None:
        """Return a checkpoint after reading all that belongs to it; None if there is no file."""
        try:
            checkpoint = Checkpoint(**_load(path))
        except FileNotFoundError:
            return None
        except ValidationError as error:
            field = ".".join(map(str, error.errors()[0]["loc"]))
            raise CaseError(f"its checkpoint is of another version of tribo: {field}") from error
        if checkpoint.case != fingerprint(case):
            raise CaseError("it belongs to another case")
        for number in range(checkpoint.parts):
            open_sealed(self.part(number)).close()
        return checkpoint


def hold(path: Path) -> IO[bytes]:
    """Lock a file, made if there is none, until it is closed or the process ends.

    `BlockingIOError` if another process or thread holds it, or has just removed it.
    """
    file = open_lock(path)
    try:
        if not lock(file.fileno()):
            warn(
                f"{path}: its file system has no locks, so nothing stops another process from "
                "writing the same results; see that none does",
            )
        if not os.path.samestat(os.fstat(file.fileno()), path.stat()):
            raise BlockingIOError
    except (BlockingIOError, FileNotFoundError):
        file.close()
        raise BlockingIOError from None
    return file


def fingerprint(case: Mapping[str, object]) -> str:
    """Return the hash of a case."""
    return sha256(json.dumps(case, sort_keys=True).encode()).hexdigest()


def store(path: Path, data: object) -> None:
    """Write plain data, dataclasses and arrays, so that `_load` returns the same bits."""
    arrays: list[Array] = []

    def plain(value: Any) -> object:
        if isinstance(value, np.ndarray):
            arrays.append(value)
            return {_ARRAY: len(arrays) - 1}
        if isinstance(value, np.generic):
            return value.item()
        if isinstance(value, Mapping):
            return dict(value)
        return {field.name: getattr(value, field.name) for field in fields(value)}

    # json writes floats so that they read back to the same bits.
    text = json.dumps(data, default=plain)
    image = BytesIO()
    np.savez(image, np.frombuffer(text.encode(), np.uint8), *arrays)
    write_sealed(path, image.getbuffer())


def _load(path: Path) -> dict[str, Any]:
    with open_sealed(path) as file, np.load(file) as data:

        def whole(table: dict[str, Any]) -> object:
            return data[f"arr_{table[_ARRAY] + 1}"] if _ARRAY in table else table

        loaded: dict[str, Any] = json.loads(data["arr_0"].tobytes(), object_hook=whole)
        return loaded
