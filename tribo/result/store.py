"""Write a result file as the run proceeds.

HDF5 in its earliest format, in a sealed file that is committed at every save:
it survives the death of the process, and a flipped bit is noticed. Every
dataset has HDF5's own checksum too, for other programs. Names and units follow
the CF conventions; dimensions are (time, x, y).
"""

from __future__ import annotations

import json
import weakref
from collections.abc import Mapping, Sequence
from itertools import count
from pathlib import Path

import h5py
import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.measures import Measures
from tribo.core.notices import Notice
from tribo.core.state import RunInfo, Snapshot, State
from tribo.result.columns import BODY_COLUMNS, COLUMNS
from tribo.result.sealed_file import close_sealed
from tribo.result.sealed_writer import SealedWriter

FORMAT = 1
ROWS = 256
# HDF5 wants a name of its own for every file that is open, also for those in memory.
_NUMBERS = count()


class ResultWriter:
    """An open result file.

    Parameters
    ----------
    path : Path or None
        Where to write; None keeps the file in memory.
    """

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._rows: list[Measures] = []
        self._file: h5py.File
        self._sealed: SealedWriter | None = None

    @property
    def file(self) -> h5py.File:
        """The open HDF5 file."""
        return self._file

    def create(self, run: RunInfo) -> None:
        """Begin a new file, replacing what is there."""
        if self._path is None:
            self._file = h5py.File(
                f"tribo-result-{next(_NUMBERS)}",
                "w",
                driver="core",
                backing_store=False,
                libver="earliest",
            )
        else:
            self._open(SealedWriter.create(self._path), "w")
        f = self._file
        f.attrs["Conventions"] = "CF-1.11"
        f.attrs["title"] = "tribo wear simulation"
        f.attrs["tribo_format"] = FORMAT
        f.attrs["status"] = "running"
        f.attrs["wall_time_s"] = 0.0
        system = run.system
        f.attrs["load_N"] = system.load
        f.attrs["window_m"] = system.grid.size
        f.attrs["modulus_Pa"] = system.modulus
        if system.cap is not None:
            f.attrs["cap_Pa"] = system.cap
        if system.curvature is not None:
            f.attrs["curvature_1_m"] = system.curvature
        write_text(f, "case", json.dumps(run.case))
        write_text(f, "provenance", json.dumps(run.provenance))
        _scale(f, "x", system.grid.x, "m", "Position along the sliding direction")
        _scale(f, "y", system.grid.y, "m", "Position across the sliding direction")
        _growing_scale(f, "time", "s", "Time of the save")
        _series(f, "pressure", ("time", "x", "y"), "Pa", "Contact pressure")
        for body in run.bodies:
            group = f.create_group(f"bodies/{body.name}")
            group.attrs["swept"] = body.swept
            if body.density is not None:
                group.attrs["density_kg_m3"] = body.density
            _dataset(group, "height", body.height, "m", "Initial height, outward")
            group["height"].dims[0].attach_scale(f["x"])
            group["height"].dims[1].attach_scale(f["y"])
            own = ("time", "y") if body.swept else ("time", "x", "y")
            _series(f, f"bodies/{body.name}/wear_depth", own, "m", "Depth worn away")
            _series(
                f,
                f"bodies/{body.name}/plastic_depth",
                ("time", "x", "y"),
                "m",
                "Permanent displacement",
            )
            for field in body.state_fields:
                kept = f"bodies/{body.name}/state/{field.name}"
                _series(f, kept, own, field.unit, field.description)
            for field in run.effect_fields:
                kept = f"bodies/{body.name}/effects/{field.name}"
                _series(f, kept, ("time", "x", "y"), field.unit, field.description)
        _growing_scale(f, "history/step", "1", "Number of the step")
        for table, scale in (("saves", "time"), ("history", "history/step")):
            for column in COLUMNS:
                _series(f, f"{table}/{column.name}", (scale,), column.unit, column.description)
            for body in run.bodies:
                for part in BODY_COLUMNS:
                    name = f"{table}/bodies/{body.name}/{part.name}"
                    _series(f, name, (scale,), part.unit, part.description)

    def reopen(self, run: RunInfo, state: State) -> None:
        """Go on with the file of an earlier process, dropping what came after `state`."""
        if self._path is None:
            raise CaseError("a result that was kept in memory cannot be gone on with")
        self._open(SealedWriter(self._path), "r+")
        self._file.attrs["status"] = "running"
        _check_effects(self._file, run)
        _truncate(self._file, state.saves, state.steps + 1)
        self.note(state.notices)
        _record_change(self._file, run.provenance)

    def case(self) -> dict[str, object]:
        """Return the configuration that the file was begun with."""
        return dict(json.loads(read_text(self._file, "case")))

    def append_step(self, measures: Measures) -> None:
        """Remember a row of the history; it is written at the next flush."""
        self._rows.append(measures)

    def append_save(self, snapshot: Snapshot) -> None:
        """Write the fields of a save; they reach the disk with the next commit."""
        f, state = self._file, snapshot.state
        _append(f["time"], [state.time])
        _append(f["pressure"], [state.contact.pressure])
        for name, body in state.bodies.items():
            group = f[f"bodies/{name}"]
            worn = body.wear if group["wear_depth"].ndim == 3 else body.wear[0]
            _append(group["wear_depth"], [worn])
            _append(group["plastic_depth"], [body.plastic])
            for field, values in body.law.items():
                kept = group[f"state/{field}"]
                _append(kept, [values if kept.ndim == 3 else values[0]])
            for field, dataset in group.get("effects", {}).items():
                # An effect that has failed leaves none.
                values = snapshot.effects.get(field, {}).get(name, np.array(np.nan))
                _append(dataset, [np.broadcast_to(values, dataset.shape[1:])])
        self._append_rows("saves", [snapshot.measures])
        self.note(state.notices)

    def note(self, notices: Sequence[Notice]) -> None:
        """Write the warnings of the run so far."""
        self._file.attrs["notices"] = json.dumps([str(notice) for notice in notices])

    def commit(self, *, sync: bool = False) -> None:
        """Write the remembered rows, and put all that was written on disk, or none of it.

        Parameters
        ----------
        sync : bool, optional
            Whether to wait until it would outlive a power failure.
        """
        if self._rows:
            steps = self._file["history/step"]
            first = steps.shape[0]
            _append(steps, list(np.arange(first, first + len(self._rows), dtype=float)))
            self._append_rows("history", self._rows)
            self._rows = []
        self._file.flush()
        if self._sealed is not None:
            self._sealed.commit(sync=sync)

    def finish(self, status: str, wall_time: float) -> None:
        """Write what is left and how the run ended."""
        self._file.attrs["status"] = status
        self._file.attrs["wall_time_s"] = wall_time
        self.commit(sync=True)

    def close(self) -> None:
        """Close the file, without what was not committed."""
        self._close()

    def _open(self, sealed: SealedWriter, mode: str) -> None:
        self._file = h5py.File(sealed, mode, libver="earliest")
        self._sealed = sealed
        # HDF5 must not be left to close it when Python is gone.
        self._close = weakref.finalize(self, close_sealed, self._file, sealed)

    def _append_rows(self, table: str, rows: list[Measures]) -> None:
        for column in COLUMNS:
            _append(self._file[f"{table}/{column.name}"], [column.read(row) for row in rows])
        for body in rows[0].bodies:
            for part in BODY_COLUMNS:
                values = [part.read(row.bodies[body]) for row in rows]
                _append(self._file[f"{table}/bodies/{body}/{part.name}"], values)


def write_text(group: h5py.Group, name: str, text: str) -> None:
    """Store text as UTF-8 bytes, which unlike HDF5 strings can carry a checksum."""
    data = np.frombuffer(text.encode(), dtype=np.uint8)
    dataset = group.create_dataset(name, data=data, chunks=data.shape, fletcher32=True)
    # NetCDF's way to name a dimension that has no coordinates.
    length = group.create_dataset(
        f"{name}_bytes", data.shape, dtype="u1", chunks=data.shape, fletcher32=True
    )
    length.make_scale(f"This is a netCDF dimension but not a netCDF variable. {data.size:10d}")
    dataset.dims[0].attach_scale(length)


def read_text(group: h5py.Group, name: str) -> str:
    """Read what `write_text` stored."""
    return bytes(group[name][:]).decode()


def write_array(group: h5py.Group, name: str, values: Array) -> h5py.Dataset:
    """Store an array, compressed and with a checksum."""
    return group.create_dataset(
        name, data=values, chunks=values.shape, fletcher32=True, compression=1, shuffle=True
    )


def _dataset(group: h5py.Group, name: str, values: Array, unit: str, meaning: str) -> None:
    _describe(write_array(group, name, values), unit, meaning)


def _describe(dataset: h5py.Dataset, unit: str, meaning: str) -> None:
    dataset.attrs["units"] = unit
    dataset.attrs["long_name"] = meaning


def _scale(file: h5py.File, name: str, values: Array, unit: str, meaning: str) -> None:
    _dataset(file, name, values, unit, meaning)
    file[name].make_scale(name)


def _growing_scale(file: h5py.File, name: str, unit: str, meaning: str) -> None:
    dataset = file.create_dataset(
        name, shape=(0,), maxshape=(None,), chunks=(ROWS,), dtype="f8", fletcher32=True
    )
    _describe(dataset, unit, meaning)
    dataset.make_scale(name.rsplit("/", 1)[-1])


def _series(
    file: h5py.File, name: str, dimensions: tuple[str, ...], unit: str, meaning: str
) -> None:
    scales = [file[dimension] for dimension in dimensions]
    rest = tuple(scale.shape[0] for scale in scales[1:])
    dataset = file.create_dataset(
        name,
        shape=(0, *rest),
        maxshape=(None, *rest),
        chunks=(1, *rest) if rest else (ROWS,),
        dtype="f8",
        fletcher32=True,
        compression=1 if rest else None,
        shuffle=bool(rest),
    )
    _describe(dataset, unit, meaning)
    for dimension, scale in zip(dataset.dims, scales, strict=True):
        dimension.attach_scale(scale)


def _append(dataset: h5py.Dataset, values: Sequence[float] | Sequence[Array]) -> None:
    first = dataset.shape[0]
    dataset.resize(first + len(values), axis=0)
    dataset[first:] = np.asarray(values, dtype=np.float64)


def _record_change(file: h5py.File, now: Mapping[str, object]) -> None:
    """Add to the provenance what a resumed run is continued with, if that differs."""
    made = json.loads(read_text(file, "provenance"))
    last = made["resumed_with"][-1] if "resumed_with" in made else made
    if all(last.get(key) == value for key, value in now.items()):
        return
    made.setdefault("resumed_with", []).append(now)
    del file["provenance"], file["provenance_bytes"]
    write_text(file, "provenance", json.dumps(made))


def _check_effects(file: h5py.File, run: RunInfo) -> None:
    provided = {field.name for field in run.effect_fields}
    for body in run.bodies:
        kept = set(file[f"bodies/{body.name}"].get("effects", ()))
        if kept != provided:
            raise CaseError(
                f"the effects provide {', '.join(sorted(provided)) or 'nothing'}, but the result "
                f"keeps {', '.join(sorted(kept)) or 'nothing'} of them; start again with "
                "'tribo run --force'"
            )


def _truncate(file: h5py.File, saves: int, steps: int) -> None:
    """Shorten every growing dataset to the given number of saves or steps."""

    def shorten(name: str, item: h5py.Dataset | h5py.Group) -> None:
        if isinstance(item, h5py.Dataset) and item.maxshape[0] is None:
            length = steps if name.startswith("history/") else saves
            if item.shape[0] < length:
                raise CaseError(
                    f"the result lacks rows that its checkpoint counts ({name}: {item.shape[0]} of "
                    f"{length}); start again with 'tribo run'"
                )
            item.resize(length, axis=0)

    file.visititems(shorten)
