"""The numbers that the charts of a report draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from tribo import Array, BodyResult, Result
from tribo.kernel_api import (
    TRACK,
    TRACK_PLASTIC,
    axis_units,
    kept_fields,
    limits,
    removed,
    shown_in,
    size,
)

from tribo_report.curves import history, moments, sections, thinned, touched
from tribo_report.reduced import Blocks, block_means, block_words, each_plain, plain

NUMBERS = 250_000
"""Numbers in all maps together, which keeps the file below 4 MB."""
MOST_CELLS = 128
"""Of a map along an axis; fifteen such maps have `NUMBERS`."""
ALIKE = 2.5
"""Length over width up to which a map is true to scale, as in the kernel's pictures."""
STRETCHED = " Along and across are drawn to different scales."


@dataclass(frozen=True)
class FieldPart:
    """The part of a field that is shown: a window, or the whole track of a swept body."""

    x: slice
    y: slice
    blocks: tuple[Blocks, Blocks]

    def of(self, field: Array) -> Array:
        """Return the part of a field, shape (nx, ny)."""
        return field[self.x, self.y]

    def means(self, field: Array) -> Array:
        """Return the block means of what is shown of a field."""
        return block_means(self.of(field), self.blocks)

    def axes(self) -> dict[str, Any]:
        """Return positions and units as plain data, and whether a map is true to scale."""
        lengths = [float(np.ptp(each.position)) for each in self.blocks]
        units = axis_units([0.5 * length for length in lengths])
        x, y = (
            plain(each.centres / size(unit)) for each, unit in zip(self.blocks, units, strict=True)
        )
        return {"x": x, "y": y, "units": units, "alike": max(lengths) <= ALIKE * min(lengths)}


def charts(result: Result) -> dict[str, Any]:
    """Return the data of the charts of a result, as plain data."""
    saves = thinned(len(result.times))
    times = [float(result.times[i]) for i in saves]
    depths_of = {name: removed(result, name)[saves] for name in result.body_names}
    pressures = [result.field("pressure", i) for i in saves]
    worn = [result.body(name) for name, depths in depths_of.items() if np.any(depths != 0)]
    kept = [field for field in kept_fields(result) if field.varies]
    count = 1 + len(worn) + len(kept)
    most = min(int(np.sqrt(NUMBERS / (count * len(saves)))), MOST_CELLS)
    window = _window(result, saves, most)
    maps = [_map("Contact pressure", "Pa", "", pressures, window)]
    surfaces = []
    for body in worn:
        depths, part = list(depths_of[body.name]), window
        if (track := _track(result, body, saves)) is not None:
            depths, part = track, _whole_track(result, track, window, most)
        # A unit of its own, for one body may wear a thousandth of the other.
        maps.append(_map(_called(body), "m", body.name, depths, part))
        height = None if part is not window else window.means(body.height)
        surfaces.append(_surface(body.name, len(maps) - 1, height, maps[-1]["unit"]))
    for field in kept:
        values = [field.values[i] for i in saves]
        maps.append(_map(field.name.capitalize(), field.unit, "models", values, window))
    return {
        "saves": moments(result, saves),
        "left_out": len(result.times) - len(saves),
        "maps": maps,
        "surfaces": surfaces,
        "sections": sections({"": result}, times),
        "history": history({"": result}),
    }


def pressure_maps(results: Mapping[str, Result], times: Sequence[float]) -> list[dict[str, Any]]:
    """Return a map of the pressure of each result, by label, at times that all have saved, in s."""
    most = int(np.sqrt(NUMBERS / (len(results) * len(times))))
    maps: list[dict[str, Any]] = []
    shown: dict[str, tuple[list[Array], FieldPart]] = {}
    for label, result in results.items():
        saves = [result.save_at(time) for time in times]
        window = _window(result, saves, min(most, MOST_CELLS))
        shown[label] = [result.field("pressure", i) for i in saves], window
    highest = max(float(np.max(field)) for fields, _ in shown.values() for field in fields)
    for label, (pressures, window) in shown.items():
        name = f"Contact pressure, {label}"
        maps.append(_map(name, "Pa", "", pressures, window, highest))
    return maps


def _called(body: BodyResult) -> str:
    if np.any(body.plastic_depth):
        return f"Depth of {body.name} below its first surface"
    return f"Wear depth of {body.name}"


def _track(result: Result, body: BodyResult, saves: Sequence[int]) -> list[Array] | None:
    """Return the depth along the whole track of a body at each save; None if it has none."""
    if not body.swept or TRACK not in dir(result):
        return None
    names = [name for name in (TRACK, TRACK_PLASTIC) if name in dir(result)]
    depths = [np.sum([result.field(name, i, body.name) for name in names], axis=0) for i in saves]
    return None if np.all(np.isnan(depths)) else depths


def _window(result: Result, saves: Sequence[int], most: int) -> FieldPart:
    """Return the part of the window in which there is contact or wear."""
    grid, marked = result.grid, touched(result, saves)
    shown, blocks = [], []
    for axis, position in enumerate((grid.x, grid.y)):
        low, high = limits(marked, grid, axis)
        index = np.flatnonzero((low <= position) & (position <= high))
        shown.append(slice(int(index[0]), int(index[-1]) + 1))
        blocks.append(Blocks.of(position[shown[-1]], most))
    return FieldPart(shown[0], shown[1], (blocks[0], blocks[1]))


def _whole_track(
    result: Result, depths: Sequence[Array], window: FieldPart, most: int
) -> FieldPart:
    known = np.flatnonzero(np.isfinite(depths).all(axis=(0, 2)))
    length = depths[0].shape[0]
    x = (np.arange(length) - 0.5 * (length - 1)) * result.grid.spacing[0]
    along = slice(int(known[0]), int(known[-1]) + 1)
    return FieldPart(along, window.y, (Blocks.of(x[along], most), window.blocks[1]))


def _map(
    name: str, unit: str, body: str, fields: Sequence[Array], part: FieldPart, highest: float = 0.0
) -> dict[str, Any]:
    """Return a map at each save, with the largest value of all its cells.

    Its unit suits a value that is the `highest` of several maps, too.
    """
    largest = [float(np.max(part.of(field))) for field in fields]
    shown, factor = shown_in(unit, np.array([*largest, highest]))
    axes = part.axes()
    return {
        "name": name,
        "body": body,
        "unit": shown,
        **axes,
        "values": [plain(part.means(field) / factor) for field in fields],
        "largest": each_plain(np.array(largest) / factor),
        "note": block_words(part.blocks) + ("" if axes["alike"] else STRETCHED),
    }


def _surface(name: str, map_: int, height: Array | None, unit: str) -> dict[str, Any]:
    """Return the surface in 3-D: heights less the depths of a map; from 0 along a track."""
    heights = None if height is None else plain((height - np.max(height)) / size(unit))
    return {"name": name, "map": map_, "height": heights}
