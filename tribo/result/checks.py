"""Check what is read from a result file, which anyone may have edited."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import h5py
import numpy as np

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
# Name, shape, lower bound, whether every result has it.
_NUMBERS: tuple[tuple[str, tuple[int, ...], float, bool], ...] = (
    ("load_N", (), 0.0, True),
    ("modulus_Pa", (), 0.0, True),
    ("window_m", (2,), 0.0, True),
    ("cap_Pa", (), 0.0, False),
    ("curvature_1_m", (2,), -np.inf, False),
    ("wall_time_s", (), -np.inf, False),
)
_TEXTS = dict.fromkeys(("type", "class", "distribution", "version", "code"), str)
_ORIGIN = {**_TEXTS, "editable": bool, "config": dict, "facts": dict}
_PLUGIN = dict.fromkeys(("distribution", "version", "status", "reason"), str)
_MADE = {"python": str, "packages": dict, "components": {...: _ORIGIN}, "plugins": [_PLUGIN]}
_NOTHING = {"result": "", "sha256": ""}
# A type, the needed keys of a table, what each entry (...) of a table is, or each item of a list.
_PASSED = {"body": str, "layer": int, "distance_m": float, "time_s": float}
_JSON: dict[str, object] = {
    "case": {"bodies": {...: dict}},
    "provenance": _MADE,
    "notices": [str],
    "worn_through": [_PASSED],
}
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
    for name, pattern in _JSON.items():
        try:
            read[name] = json.loads(read[name])
        except (LookupError, TypeError, ValueError, RecursionError):
            read[name] = None
        if not _fits(read[name], pattern):
            raise ValueError(f"{name!r} is missing or is not what tribo writes there")
    case, made = read["case"], read["provenance"]
    if len(case["bodies"]) != 2:
        raise ValueError(f"'case' has {len(case['bodies'])} bodies instead of 2")
    if not all(isinstance(case.get(table, {}), dict) for table in ("contact", "grid")):
        raise ValueError("'contact' or 'grid' of its 'case' is no table")
    if not _fits(made.get("begun_with", _NOTHING), dict.fromkeys(_NOTHING, str)):
        raise ValueError("'begun_with' of its 'provenance' is not what tribo writes there")
    if not _fits(made.get("resumed_with", []), [_MADE]):
        raise ValueError("'resumed_with' of its 'provenance' is not what tribo writes there")
    if read.get("status") not in _STATUS:
        raise ValueError(f"'status' is {read.get('status')!r} instead of {', '.join(_STATUS)}")
    for name, shape, above, needed in _NUMBERS:
        values = np.asarray(read.get(name))
        if (needed or name in read) and not (
            values.shape == shape
            and values.dtype.kind in "fiu"
            and np.all((values > above) & np.isfinite(values))
        ):
            raise ValueError(f"{name!r} is {read.get(name)!r}")
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


def _fits(data: object, pattern: Any) -> bool:
    if isinstance(pattern, list):
        return isinstance(data, list) and all(_fits(item, pattern[0]) for item in data)
    if not isinstance(pattern, dict):
        return isinstance(data, pattern)
    if not isinstance(data, dict):
        return False
    if ... in pattern:
        return all(_fits(entry, pattern[...]) for entry in data.values())
    return all(key in data and _fits(data[key], part) for key, part in pattern.items())
