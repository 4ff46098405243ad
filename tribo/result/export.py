"""Write a result's history and profiles as CSV."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from tribo.core.arrays import Array
from tribo.core.files import writing
from tribo.result.columns import labelled
from tribo.result.layout import BETWEEN, EFFECT, STATE
from tribo.result.read import Result


def export_csv(result: Result, folder: Path) -> list[Path]:
    """Write history, saves and profiles as CSV files, with units in their column names."""
    tables: dict[str, Mapping[str, Array]] = {
        "history": result.table("history"),
        "saves": result.table("saves"),
        "profiles_x": _profiles(result, 0),
        "profiles_y": _profiles(result, 1),
    }
    paths = [folder / f"{name}.csv" for name in tables]
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
        for path, table in zip(paths, tables.values(), strict=True):
            # Slow to import, and needed here only.
            import pandas as pd

            pd.DataFrame(table, dtype=float).to_csv(
                path, index=False, na_rep="nan", lineterminator="\r\n"
            )
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
    saves = range(len(times))
    fields: dict[str, Iterable[Array]] = {
        "pressure_Pa": [result.field("pressure", i) for i in saves]
    }
    for key, field in result.fields_of(BETWEEN).items():
        kept = [result.field(key, i) for i in saves]
        fields[f"{BETWEEN}.{labelled(field.name, field.unit)}"] = [
            np.broadcast_to(each, grid.cells) for each in kept
        ]
    for name in result.body_names:
        body, of = result.body(name), f"bodies.{name}"
        fields[f"{of}.wear_depth_m"] = body.wear_depth
        fields[f"{of}.plastic_depth_m"] = body.plastic_depth
        for f in result.fields_of(STATE, name).values():
            fields[f"{of}.state.{labelled(f.name, f.unit)}"] = body.state[f.name]
        for f in result.fields_of(EFFECT, name).values():
            fields[f"{of}.effects.{labelled(f.name, f.unit)}"] = body.effects[f.name]
        fields[f"{of}.height_m"] = [body.surface(i) for i in saves]
    return {
        "time_s": np.repeat(times, len(position)),
        f"{'xy'[axis]}_m": np.tile(position, len(times)),
        **{
            label: np.concatenate([profile(each, axis) for each in of_saves])
            for label, of_saves in fields.items()
        },
    }
