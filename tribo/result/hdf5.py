"""A result as a netCDF-4 file, which is HDF5: every chunk of it has a checksum."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.hdf5 import open_hdf5
from tribo.result.header import Header
from tribo.result.layout import BETWEEN, DIMS, FIXED, Rows, Variable

if TYPE_CHECKING:
    import h5py

_ROWS = 256
"""Saves or steps of a chunk, 2 KiB of a number; most runs fit in one."""
_MOST = 2**31 - 1
"""Largest number of saves or steps of a file. Without a limit, h5netcdf and so xarray take four
times as long to open it."""


def empty_image(
    header: Header, table: Mapping[str, Variable], constants: Mapping[str, Array]
) -> bytes:
    """Return the file of a run that has not yet made a step."""
    bodies = list(header.case["bodies"])
    sizes = {"body": len(bodies), "time": 0, "step": 0}
    sizes |= {name: len(each) for name, each in constants.items() if table[name].dims == (name,)}
    image = BytesIO(_without_values(tuple(table.items()), tuple(sizes.items())))
    with open_hdf5(image, "r+") as file:
        file.attrs.update(header.attributes())
        file["body"][...] = bodies
        for name, values in constants.items():
            file[name][...] = values
    return image.getvalue()


@lru_cache(maxsize=8)
def _without_values(
    table: tuple[tuple[str, Variable], ...], sizes_of: tuple[tuple[str, int], ...]
) -> bytes:
    """Return a file with no values, cached: making it takes as long as a short run."""
    image, sizes = BytesIO(), dict(sizes_of)
    with open_hdf5(image, "w") as file:
        file["body"] = [""] * sizes["body"]
        # Looked up once: that takes as long as writing.
        datasets = {"body": file["body"]} | {
            name: _create(file, name, variable, [sizes[dim] for dim in variable.dims])
            for name, variable in table
        }
        # netCDF takes the dimensions from these.
        for dim in sizes:
            datasets[dim].make_scale(dim)
        for name, variable in table:
            if name not in sizes:
                for axis, dim in enumerate(variable.dims):
                    datasets[name].dims[axis].attach_scale(datasets[dim])
    return image.getvalue()


def filled_image(
    empty: bytes, parts: Iterable[Rows], saves: int, steps: int, **changed: Any
) -> BytesIO:
    """Return a whole file in memory: HDF5 may crash where it meets a full disk.

    The parts of the run, made by `tribo.result.rows.part_of`, are written in order into the file
    that `empty_image` returned, with these numbers of saves and steps; attributes change.
    """
    image = BytesIO(empty)
    with open_hdf5(image, "r+") as file:
        file.attrs.update(changed)
        datasets = dict(file.items())
        for dataset in datasets.values():
            if dataset.maxshape[0] == _MOST:
                scale = dataset if dataset.is_scale else dataset.dims[0][0]
                dataset.resize(saves if scale == datasets["time"] else steps, axis=0)
        datasets["step"][...] = np.arange(steps)
        scalars: dict[str, list[Any]] = {}
        saved = 0
        for part in parts:
            for name, rows in part.items():
                if isinstance(rows, np.ndarray):
                    datasets[name][saved : saved + len(rows)] = rows
                else:
                    scalars.setdefault(name, []).extend(rows)
            saved += len(part.get("time", ()))
        for name, values in scalars.items():
            datasets[name][...] = values
    return image


def read_variables(datasets: Mapping[str, h5py.Dataset]) -> dict[str, Variable]:
    """Return the variables of a file, none of them read; ValueError if a name is none."""
    table = {name: variable for name, variable in FIXED.items() if name in datasets}
    for name, values in datasets.items():
        if "kind" not in values.attrs:
            continue
        kind, field, unit, meaning = (
            str(values.attrs[key]) for key in ("kind", "field", "units", "long_name")
        )
        # Files are called after them.
        if not (name.isidentifier() and field.isidentifier()):
            raise ValueError(f"{name!r} is no field of a model")
        dims = ("time",) if kind == BETWEEN and values.ndim == 1 else DIMS[kind]
        bodies = tuple(map(str, values.attrs["bodies"]))
        table[name] = Variable(dims, unit, meaning, kind, field, bodies)
    return table


def _create(file: h5py.File, name: str, variable: Variable, shape: list[int]) -> h5py.Dataset:
    grows = variable.dims[0] in ("time", "step")
    chunks = [_ROWS if grows else shape[0], *shape[1:]]
    if len(shape) > 2:
        # One body at one time.
        chunks[:-2] = [1] * (len(shape) - 2)
    created = file.create_dataset(
        name,
        shape,
        "f8",
        maxshape=[_MOST if grows else shape[0], *shape[1:]],
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
    return created
