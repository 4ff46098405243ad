"""Check what is read from a result file, which anyone may have edited."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import h5py

from tribo.core.errors import CaseError
from tribo.result.layout import (
    BETWEEN,
    EFFECT,
    FIXED,
    ROUGHNESS,
    STATE,
    TRACK,
    TRACK_PLASTIC,
    TRACK_STATE,
    Variable,
)

_STATUS = ("done", "running", "killed", "interrupted", "failed")
_JSON = {"case": dict, "provenance": dict, "notices": list, "worn_through": list}
_LIKE = {STATE: "wear_depth", EFFECT: "wear_depth", TRACK_STATE: TRACK, BETWEEN: "pressure"}
"""By kind, the variable that a field of a model has the dimensions of."""


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
    table = {
        name: v
        for name, v in FIXED.items()
        if name in file or name not in (*ROUGHNESS, TRACK_PLASTIC)
    }
    if not {"track_x", TRACK} & file.keys():
        del table["track_x"], table[TRACK]
    for name, values in file.items():
        if not isinstance(values, h5py.Dataset):
            raise ValueError(f"{name!r} is no variable")
        if "kind" in values.attrs:
            kind, field, unit, meaning = (
                str(values.attrs[key]) for key in ("kind", "field", "units", "long_name")
            )
            owners = tuple(map(str, values.attrs["bodies"]))
            if name in FIXED or kind not in _LIKE or not {*owners} <= {*bodies}:
                raise ValueError(f"{name!r} is no field of a model of these bodies")
            like = FIXED[_LIKE[kind]]
            if kind == BETWEEN and values.ndim == 1:
                like = FIXED["time"]
            shaped = replace(like, unit=unit, meaning=meaning)
            table[name] = replace(shaped, kind=kind, field=field, bodies=owners)
    named = tuple(file["body"].asstr()[:].tolist())
    if named != bodies:
        raise ValueError(
            f"it holds the bodies {', '.join(named)}, but its 'case' has {', '.join(bodies)}"
        )
    sizes = {"body": 2}
    for dim in dict.fromkeys(dim for v in table.values() for dim in v.dims if dim != "body"):
        sizes[dim] = file[dim].size
    if not sizes["x"] * sizes["y"]:
        raise ValueError("it has no cells")
    for name, variable in table.items():
        shape = tuple(sizes[dim] for dim in variable.dims)
        if file[name].shape != shape or file[name].dtype.kind not in "fiu":
            kept = f"{file[name].dtype} of shape {file[name].shape}"
            raise ValueError(f"{name!r} is {kept} instead of real numbers of shape {shape}")
    return table
