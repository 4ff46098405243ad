"""Check what is read from a result file, which anyone may have edited."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.hdf5 import contained
from tribo.result.layout import BETWEEN, DIMS, FIXED, ROUGHNESS, TRACK, TRACK_PLASTIC, Variable

if TYPE_CHECKING:
    import h5py

_FILTERS = {1, 2, 3}
"""HDF5's numbers of deflate, shuffle and Fletcher32."""
_DENSEST = 1032
"""Largest factor by which deflate, which compresses a result, makes data smaller."""
_FRICTION = {
    prefix + name for prefix in ("", "history_") for name in ("friction_force", "friction_energy")
}
_MAY_BE_NAN = {"density", TRACK, TRACK_PLASTIC, *ROUGHNESS} | _FRICTION
_AT_LEAST_0 = {"time", "history_time", "pressure", "wear_depth", "plastic_depth", "density"}
_AT_LEAST_0 |= _FRICTION


@contextmanager
def interpreting(name: str) -> Iterator[None]:
    """Turn any error that the contents of a file lead to into a CaseError of one line."""
    try:
        yield
    except (CaseError, Warning):
        raise
    except Exception as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise CaseError(f"{name} is damaged: {reason}") from error


def check_contained(file: h5py.File) -> None:
    """Raise ValueError where a file refers to another, or stores what tribo does not write."""
    variables = {values.name: values for values in contained(file)}
    if other := {f"/{name}" for name in file} ^ variables.keys():
        raise ValueError(f"{min(other)!r} is no variable")
    for name, values in variables.items():
        made = values.id.get_create_plist()
        if not {made.get_filter(i)[0] for i in range(made.get_nfilters())} <= _FILTERS:
            raise ValueError(f"{name!r} is stored as tribo does not store it")
    promised = sum(values.nbytes for values in variables.values())
    if promised > _DENSEST * file.id.get_filesize():
        raise ValueError(f"it promises {promised / 1e6:.3g} MB, more than it can hold")


def read_variables(
    kept: Mapping[str, h5py.Dataset], bodies: tuple[str, ...]
) -> dict[str, Variable]:
    """Return the variables of a file, none of them read; ValueError if they do not fit."""
    lacking = {*ROUGHNESS, TRACK_PLASTIC} - kept.keys()
    if not {"track_x", TRACK} & kept.keys():
        lacking |= {"track_x", TRACK}
    table = {name: variable for name, variable in FIXED.items() if name not in lacking}
    for name, values in kept.items():
        if "kind" in values.attrs:
            table[name] = _field_of_model(name, values, bodies)
    named = tuple(np.atleast_1d(kept["body"].asstr()[()]).tolist())
    if named != bodies:
        raise ValueError(
            f"it holds the bodies {', '.join(named)}, but its 'case' has {', '.join(bodies)}"
        )
    dims = {dim for variable in table.values() for dim in variable.dims}
    sizes = {dim: kept[dim].size for dim in dims}
    if not sizes["x"] * sizes["y"]:
        raise ValueError("it has no cells")
    for name, variable in table.items():
        shape = tuple(sizes[dim] for dim in variable.dims)
        has = kept[name].shape, kept[name].dtype
        if has[0] != shape or has[1].kind not in "fiu":
            raise ValueError(
                f"{name!r} is {has[1]} of shape {has[0]} instead of real numbers of shape {shape}"
            )
    return table


def checked(name: str, values: Array) -> Array:
    """Return the values of a variable; ValueError if they are none that a run writes.

    What models keep may be NaN.
    """
    wrong = np.isinf(values) if name in _MAY_BE_NAN else ~np.isfinite(values)
    if name in FIXED and wrong.any():
        raise ValueError(f"{name!r} has values that are not finite")
    if name in ("time", "history_time") and np.any(np.diff(values) < 0):
        raise ValueError(f"{name!r} goes back")
    if name in _AT_LEAST_0 and np.any(values < 0):
        raise ValueError(f"{name!r} has values below 0")
    return values


def _field_of_model(name: str, values: h5py.Dataset, bodies: tuple[str, ...]) -> Variable:
    """Return the variable that a dataset with a kind is, which its attributes describe."""
    kind, field, unit, meaning = (
        str(values.attrs[key]) for key in ("kind", "field", "units", "long_name")
    )
    owners = tuple(map(str, values.attrs["bodies"]))
    if (
        name in FIXED
        or kind not in DIMS
        or not {*owners} <= {*bodies}
        or not (name.isidentifier() and field.isidentifier())
    ):
        raise ValueError(f"{name!r} is no field of a model of these bodies")
    dims = ("time",) if kind == BETWEEN and values.ndim == 1 else DIMS[kind]
    return Variable(dims, unit, meaning, None, kind, field, owners)
