"""A result as a netCDF-4 file, which is HDF5: every chunk of it has a checksum."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.state import RunInfo
from tribo.result.header import LARGEST, Header
from tribo.result.layout import FIXED, Variable, field_variable, run_variables

Part = Mapping[str, Array]
"""Rows that a run has added, by variable."""

_ROWS = 256
_MOST_PACKED = 1100
"""Bytes that a byte of a file may stand for; deflate comes to 1032."""


@dataclass(frozen=True)
class Frame:
    """What of a result does not grow with the run.

    Parameters
    ----------
    header : Header
        The attributes.
    variables : Mapping[str, Variable]
        All variables, those that grow too.
    arrays : Mapping[str, ndarray]
        The values of those that do not.
    """

    header: Header
    variables: Mapping[str, Variable]
    arrays: Mapping[str, Array]

    @classmethod
    def of_run(cls, run: RunInfo) -> Frame:
        """Return the frame of a run that begins."""
        densities = [np.nan if body.density is None else body.density for body in run.bodies]
        arrays: dict[str, Array] = {
            "x": run.system.grid.x,
            "y": run.system.grid.y,
            "swept": np.array([float(body.swept) for body in run.bodies]),
            "density": np.array(densities),
            "height": np.stack([body.height for body in run.bodies]),
        }
        return cls(Header.of_run(run), run_variables(run), arrays)

    def with_header(self, **changes: Any) -> Frame:
        """Return a frame with other attributes."""
        return replace(self, header=self.header.model_copy(update=changes))


def hdf5_image(frame: Frame, parts: Iterable[Part], saves: int, steps: int) -> BytesIO:
    """Return a whole file in memory: HDF5 may crash where it meets a full disk.

    Parameters
    ----------
    frame : Frame
        What does not grow.
    parts : iterable of Mapping
        What does, in order.
    saves, steps : int
        How many rows all parts have.
    """
    bodies = list(frame.header.case["bodies"])
    nx, ny = frame.arrays["height"].shape[1:]
    sizes = {"body": len(bodies), "time": saves, "step": steps, "x": nx, "y": ny}
    arrays = {**frame.arrays, "step": np.arange(float(steps))}
    image = BytesIO()
    with h5py.File(image, "w") as file:
        file.attrs.update(frame.header.attributes())
        file["body"] = bodies
        for name, variable in frame.variables.items():
            _create(file, name, variable, [sizes[dim] for dim in variable.dims], arrays.get(name))
        # What netCDF takes for the names of the dimensions.
        for dim in sizes:
            file[dim].make_scale(dim)
        for name, variable in frame.variables.items():
            if name not in sizes:
                for axis, dim in enumerate(variable.dims):
                    file[name].dims[axis].attach_scale(file[dim])
        filled = {"time": 0, "step": 0}
        for part in parts:
            begin = dict(filled)
            filled["time"] += len(part.get("time", ()))
            filled["step"] += len(part.get("history_time", ()))
            for name, rows in part.items():
                dim = frame.variables[name].dims[0]
                file[name][begin[dim] : filled[dim]] = rows
    return image


def _create(
    file: h5py.File, name: str, variable: Variable, shape: list[int], values: Array | None
) -> None:
    chunks = [_ROWS if variable.grows else shape[0], *shape[1:]]
    if len(shape) > 2:
        # One body at one time.
        chunks[:-2] = [1] * (len(shape) - 2)
    created = file.create_dataset(
        name,
        shape,
        "f8",
        values,
        maxshape=[None if variable.grows else shape[0], *shape[1:]],
        chunks=tuple(chunks),
        fletcher32=True,
        shuffle=True,
        compression="gzip",
        compression_opts=1,
    )
    created.attrs["units"] = variable.unit
    created.attrs["long_name"] = variable.meaning
    if variable.kind:
        created.attrs["kind"] = variable.kind
        created.attrs["field"] = variable.field
        created.attrs["bodies"] = list(variable.bodies)


class Contents:
    """The contents of a result file; each number is checked as it is read.

    Parameters
    ----------
    source : Path or BytesIO
        The file.
    name : str
        What to call it in messages.

    Raises
    ------
    CaseError
        If it is damaged, which is all that any method raises.
    """

    def __init__(self, source: Path | BytesIO, name: str) -> None:
        self.source = source
        self.name = name
        size = source.stat().st_size if isinstance(source, Path) else source.getbuffer().nbytes
        with self._reading():
            self.file = h5py.File(source, "r")
        try:
            with self._reading():
                self.header = Header.read(dict(self.file.attrs))
                self.variables = _variables(self.file, size)
                bodies = self.file["body"].asstr()[:].tolist()
                if bodies != list(self.header.case["bodies"]):
                    raise ValueError(f"it holds the bodies {bodies}, but its case has others")
            self.fields = [name for name, v in self.variables.items() if v.dims[-2:] == ("x", "y")]
            scalars = self.variables.keys() - set(self.fields)
            self.scalars = {name: self.read(name) for name in scalars}
        except BaseException:
            self.file.close()
            raise

    def read(self, name: str, *index: int | slice) -> Array:
        """Return a variable, or a part of it."""
        with self._reading():
            values: Array = self.file[name][(*index, ...)]
            _check(name, self.variables[name], values)
            return values

    def check(self) -> None:
        """Read all there is, one save at a time."""
        for name in self.fields:
            for save in range(len(self.file[name])):
                self.read(name, save)

    def close(self) -> None:
        """Close the file."""
        self.file.close()

    def frame(self) -> Frame:
        """Return what does not grow with the run."""
        fixed = [name for name, variable in self.variables.items() if not variable.grows]
        return Frame(self.header, self.variables, {name: self.read(name) for name in fixed})

    def rows(self) -> Part:
        """Return what does."""
        grown = [name for name, variable in self.variables.items() if variable.grows]
        return {name: self.read(name) for name in grown}

    @contextmanager
    def _reading(self) -> Iterator[None]:
        """Name the file in whatever HDF5 raises about it."""
        try:
            yield
        except (OSError, LookupError, RuntimeError, ValueError, TypeError, AttributeError) as error:
            raise CaseError(f"{self.name} is damaged: {error}") from error


def _variables(file: h5py.File, size: int) -> dict[str, Variable]:
    """Return the variables of a file of so many bytes; ValueError if their shapes do not fit."""
    variables = dict(FIXED)
    for name, dataset in file.items():
        if "kind" in dataset.attrs:
            keys = ("field", "units", "long_name")
            name_in_model, unit, meaning = (str(dataset.attrs[key]) for key in keys)
            field = Field(name_in_model, unit, meaning)
            kind = str(dataset.attrs["kind"])
            variables[name] = field_variable(kind, field, map(str, dataset.attrs["bodies"]))
    sizes = {
        dim: file[name].shape[0]
        for dim, name in (("time", "time"), ("step", "step"), ("x", "x"), ("y", "y"))
    }
    sizes["body"] = 2
    if not sizes["x"] * sizes["y"]:
        raise ValueError("it has no cells")
    for name, variable in variables.items():
        dataset = file[name]
        if dataset.dtype.kind not in "fiu":
            raise ValueError(f"{name!r} holds no real numbers")
        needed = tuple(sizes[dim] for dim in variable.dims)
        if dataset.shape != needed:
            raise ValueError(f"the shape of {name!r} is {dataset.shape} instead of {needed}")
        if dataset.nbytes > _MOST_PACKED * size:
            raise ValueError(f"{name!r} claims {dataset.nbytes:.3g} bytes, more than the file has")
    return variables


def _check(name: str, variable: Variable, values: Array) -> None:
    """Raise ValueError if a value is not finite, or out of range."""
    sound = np.abs(values) < LARGEST
    if variable.gaps:
        sound |= np.isnan(values)
    if not sound.all():
        raise ValueError(f"{name!r} is not finite, or above {LARGEST:g}")
    if (values < variable.least).any():
        raise ValueError(f"{name!r} is below {variable.least:g}")
    if name in ("x", "y", "time", "history_time") and (np.diff(values) <= 0).any():
        raise ValueError(f"{name!r} does not grow")
