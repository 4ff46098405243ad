"""Write a result's history and profiles as CSV."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import OutputError
from tribo.result.columns import labelled
from tribo.result.layout import BETWEEN
from tribo.result.read import Result


def export_csv(result: Result, folder: Path) -> list[Path]:
    """Write CSV files with units in their column names.

    Parameters
    ----------
    result : Result
        What to write.
    folder : Path
        Where to; it is made if need be.

    Returns
    -------
    list of Path
        The files: history.csv, saves.csv, profiles_x.csv, profiles_y.csv.

    Raises
    ------
    OutputError
        If they cannot be written.
    """
    tables: dict[str, Mapping[str, Array]] = {
        "history": result.table("history"),
        "saves": result.table("saves"),
        "profiles_x": _profiles(result, 0),
        "profiles_y": _profiles(result, 1),
    }
    paths = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, table in tables.items():
            path = folder / f"{name}.csv"
            _write(path, list(table), zip(*table.values(), strict=True))
            paths.append(path)
    except OSError as error:
        raise OutputError(f"cannot write to {folder}: {error.strerror}") from error
    return paths


def profile(field: Array, axis: int) -> Array:
    """Return the mean of the middle one or two lines of `field` along `axis`."""
    across = 1 - axis
    n = field.shape[across]
    middle = np.take(field, range((n - 1) // 2, n // 2 + 1), axis=across)
    return np.asarray(np.mean(middle, axis=across))


def _profiles(result: Result, axis: int) -> dict[str, Array]:
    """Return columns for every save, one below the other."""
    grid = result.grid
    position = (grid.x, grid.y)[axis]
    times = result.times
    columns: dict[str, Array] = {
        "time_s": np.repeat(times, len(position)),
        f"{'xy'[axis]}_m": np.tile(position, len(times)),
        "pressure_Pa": _stacked(
            profile(result.field("pressure", i), axis) for i in range(len(times))
        ),
    }
    for key, field in result.fields_of(BETWEEN).items():
        kept = [result.field(key, i) for i in range(len(times))]
        columns[f"{BETWEEN}.{labelled(field.name, field.unit)}"] = _stacked(
            np.full(len(position), each) if each.ndim == 0 else profile(each, axis) for each in kept
        )
    for name in result.body_names:
        body = result.body(name)
        for label, fields in (
            ("wear_depth_m", body.wear_depth),
            ("plastic_depth_m", body.plastic_depth),
            *((f"state.{labelled(f.name, f.unit)}", body.state[f.name]) for f in body.state_fields),
            *(
                (f"effects.{labelled(f.name, f.unit)}", body.effects[f.name])
                for f in body.effect_fields
            ),
        ):
            columns[f"bodies.{name}.{label}"] = _stacked(profile(f, axis) for f in fields)
        columns[f"bodies.{name}.height_m"] = _stacked(
            profile(body.surface(i), axis) for i in range(len(times))
        )
    return columns


def _stacked(parts: Iterable[Array]) -> Array:
    return np.concatenate(list(parts))


def _write(path: Path, header: Sequence[str], rows: Iterable[Sequence[float]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows([repr(float(value)) for value in row] for row in rows)
