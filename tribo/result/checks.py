"""Check what is read from a result file, which anyone may have edited."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import h5py

from tribo.core.errors import CaseError
from tribo.result.layout import BETWEEN, DIMS, FIXED, ROUGHNESS, TRACK, TRACK_PLASTIC, Variable

_STATUS = ("done", "running", "killed", "interrupted", "failed")
_JSON = {"case": dict, "provenance": dict, "notices": list, "worn_through": list}


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


def read_attributes(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes of a file with their JSON read; ValueError if one is wrong."""
    read = dict(attributes)
    for name, kind in _JSON.items():
        read[name] = json.loads(read[name])
        if not isinstance(read[name], kind):
            raise ValueError(f"{name!r} is not what tribo writes there")
    bodies = read["case"].get("bodies")
    if not isinstance(bodies, dict) or len(bodies) != 2:
        raise ValueError(f"'case' has {bodies!r:.80} instead of two bodies")
    if read["status"] not in _STATUS:
        raise ValueError(f"'status' is {read['status']!r} instead of {', '.join(_STATUS)}")
    return read


def read_variables(file: h5py.File, bodies: tuple[str, ...]) -> dict[str, Variable]:
    """Return the variables of a file, none of them read; ValueError if they do not fit."""
    lacking = {*ROUGHNESS, TRACK_PLASTIC} - file.keys()
    if not {"track_x", TRACK} & file.keys():
        lacking |= {"track_x", TRACK}
    table = {name: variable for name, variable in FIXED.items() if name not in lacking}
    # Each is looked up in the file once, as that takes long.
    kept = dict(file.items())
    for name, values in kept.items():
        if not isinstance(values, h5py.Dataset):
            raise ValueError(f"{name!r} is no variable")
        if "kind" in values.attrs:
            table[name] = _field_of_model(name, values, bodies)
    named = tuple(kept["body"].asstr()[:].tolist())
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


def _field_of_model(name: str, values: h5py.Dataset, bodies: tuple[str, ...]) -> Variable:
    """Return the variable that a dataset with a kind is, which its attributes describe."""
    kind, field, unit, meaning = (
        str(values.attrs[key]) for key in ("kind", "field", "units", "long_name")
    )
    owners = tuple(map(str, values.attrs["bodies"]))
    if name in FIXED or kind not in DIMS or not {*owners} <= {*bodies}:
        raise ValueError(f"{name!r} is no field of a model of these bodies")
    dims = ("time",) if kind == BETWEEN and values.ndim == 1 else DIMS[kind]
    return Variable(dims, unit, meaning, None, kind, field, owners)
