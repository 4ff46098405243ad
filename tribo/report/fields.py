"""The numbers that the charts of a report draw."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tribo.core.arrays import Array, Mask
from tribo.plotting.sections import limits, number_of_saves, scar_mask
from tribo.plotting.units import fitting, height_unit, size, time_labels, time_unit
from tribo.report.reduced import Blocks, block_means, block_words, plain
from tribo.result.body import BodyResult
from tribo.result.export import profile
from tribo.result.layout import TRACK, TRACK_PLASTIC
from tribo.result.read import Result

NUMBERS = 250_000
"""Numbers in all maps together, which keeps the file below 4 MB."""
MOST_SAVES = 40
MOST_CELLS, FEWEST_CELLS = 128, 24
"""Of a map along an axis."""
LONGEST = 400
"""Points of a section, and of a history."""
ALIKE = 2.5
"""Length over width up to which a map is true to scale."""


@dataclass(frozen=True)
class Part:
    """The part of a field that is shown: a window, or the whole track of a swept body."""

    x: slice
    y: slice
    blocks: tuple[Blocks, Blocks]

    @property
    def units(self) -> tuple[str, str]:
        """Along x and y: one, if a map is true to scale."""
        ends = [float(np.max(np.abs(each.position), initial=0.0)) for each in self.blocks]
        if max(ends) <= ALIKE * min(ends):
            ends = [max(ends)] * 2
        return fitting("m", ends[0]), fitting("m", ends[1])

    def of(self, field: Array) -> Array:
        """Return the part of a field, shape (nx, ny)."""
        return field[self.x, self.y]

    def means(self, field: Array) -> Array:
        """Return the block means of what is shown of a field."""
        return block_means(self.of(field), self.blocks)

    def axes(self) -> dict[str, Any]:
        """Return positions and units as plain data."""
        x, y = (
            plain(each.centres / size(unit))
            for each, unit in zip(self.blocks, self.units, strict=True)
        )
        return {"x": x, "y": y, "units": self.units, "alike": self.units[0] == self.units[1]}


def charts(result: Result) -> dict[str, Any]:
    """Return what the charts of a result draw, as plain data.

    Raises
    ------
    CaseError
        If it holds no save yet.
    """
    saves = _saves(number_of_saves(result))
    bodies = [result.body(name) for name in result.body_names]
    pressures = [result.field("pressure", i) for i in saves]
    worn = [body for body in bodies if np.any(_depth(body)[saves] != 0)]
    count = 1 + len(worn) + sum(len(body.effects) for body in bodies)
    most = int(np.clip(np.sqrt(NUMBERS / (count * len(saves))), FEWEST_CELLS, MOST_CELLS))
    window = _window(result, pressures, worn, most)
    maps = [_map("Contact pressure", "Pa", "", pressures, window)]
    surfaces = []
    for body in worn:
        depths, part = [_depth(body)[i] for i in saves], window
        if (track := _track(result, body, saves)) is not None:
            depths, part = track, _whole_track(result, track, window, most)
        # A unit of its own, for one body may wear a thousandth of the other.
        maps.append(_map(_called(body), "m", body.name, depths, part))
        height = None if part is not window else window.means(body.height)
        surfaces.append(_surface(body.name, len(maps) - 1, height, maps[-1]["unit"]))
    for body in bodies:
        for field in body.effect_fields:
            values = [body.effects[field.name][i] for i in saves]
            name = f"{field.name}, {body.name}"
            maps.append(_map(name, field.unit, body.name, values, window))
    return {
        "saves": _labels(result, saves),
        "left_out": len(result.times) - len(saves),
        "maps": maps,
        "surfaces": surfaces,
        "sections": [_section(axis, window, pressures, worn, saves) for axis in (0, 1)],
        "history": history(result),
    }


def _saves(count: int) -> list[int]:
    if count <= MOST_SAVES:
        return list(range(count))
    return [int(i) for i in np.linspace(0, count - 1, MOST_SAVES).round()]


def _labels(result: Result, saves: Sequence[int]) -> list[dict[str, str]]:
    times, rows = time_labels(result.times), result.saves()
    return [{"time": times[i], "distance": f"{rows[i]['distance_m']:.4g} m"} for i in saves]


def _depth(body: BodyResult) -> Array:
    return np.asarray(body.wear_depth + body.plastic_depth)


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


def _window(
    result: Result, pressures: Sequence[Array], worn: Sequence[BodyResult], most: int
) -> Part:
    """Return the part of the window in which there is contact or wear."""
    grid = result.grid
    marked: Mask = np.any([pressure > 0 for pressure in pressures], axis=0)
    for body in worn:
        if not body.swept:
            marked = marked | np.any([scar_mask(depth) for depth in _depth(body)], axis=0)
    shown, blocks = [], []
    for axis, position in enumerate((grid.x, grid.y)):
        low, high = limits(marked, grid, axis)
        index = np.flatnonzero((low <= position) & (position <= high))
        shown.append(slice(int(index[0]), int(index[-1]) + 1))
        blocks.append(Blocks.of(position[shown[-1]], most))
    return Part(shown[0], shown[1], (blocks[0], blocks[1]))


def _whole_track(result: Result, depths: Sequence[Array], window: Part, most: int) -> Part:
    known = np.flatnonzero(np.isfinite(depths).all(axis=(0, 2)))
    length = depths[0].shape[0]
    x = (np.arange(length) - 0.5 * (length - 1)) * result.grid.spacing[0]
    along = slice(int(known[0]), int(known[-1]) + 1)
    return Part(along, window.y, (Blocks.of(x[along], most), window.blocks[1]))


def _map(name: str, unit: str, body: str, fields: Sequence[Array], part: Part) -> dict[str, Any]:
    """Return a map at each save, with the largest value of all its cells."""
    largest = [float(np.max(part.of(field))) for field in fields]
    shown = unit
    if unit == "m":
        shown = height_unit(float(np.nanmax(np.abs(largest))))
    elif unit == "Pa":
        shown = fitting(unit, float(np.nanmax(largest)))
    factor = size(shown) if unit in ("m", "Pa") else 1.0
    return {
        "name": name,
        "body": body,
        "unit": shown,
        **part.axes(),
        "values": [plain(part.means(field) / factor) for field in fields],
        "largest": plain(np.array(largest) / factor),
        "note": block_words(part.blocks),
    }


def _surface(name: str, map_: int, height: Array | None, unit: str) -> dict[str, Any]:
    """Return what is drawn in 3-D: heights less the depths of a map; from 0 along a track."""
    heights = None if height is None else plain((height - np.max(height)) / size(unit))
    return {"name": name, "map": map_, "height": heights}


def _section(
    axis: int,
    part: Part,
    pressures: Sequence[Array],
    worn: Sequence[BodyResult],
    saves: Sequence[int],
) -> dict[str, Any]:
    """Return pressures and depths along an axis through the window's centre at each save."""
    shown = (part.x, part.y)[axis]
    blocks, unit = Blocks.of(part.blocks[axis].position, LONGEST), part.units[axis]

    def along(fields: Sequence[Array], to: str) -> list[list[float | None]]:
        lines = [profile(field, axis)[shown] for field in fields]
        return [plain(blocks.mean(line, 0) / size(to)) for line in lines]

    depths = {body.name: [_depth(body)[i] for i in saves] for body in worn}
    deepest = max((float(np.max(np.abs(d))) for d in depths.values()), default=0.0)
    to = height_unit(deepest)
    pressure_unit = fitting("Pa", float(np.max(pressures)))
    return {
        "axis": axis,
        "unit": unit,
        "x": plain(blocks.centres / size(unit)),
        "pressure": {"unit": pressure_unit, "values": along(pressures, pressure_unit)},
        "depth": {"unit": to, "values": {name: along(d, to) for name, d in depths.items()}},
        "note": block_words([blocks]),
    }


def history(result: Result) -> dict[str, Any]:
    """Return what changes over the steps: a list of panels, each with its curves."""
    table = result.table("history")
    steps = len(table["time_s"])
    kept = np.unique(np.linspace(0, steps - 1, min(steps, LONGEST)).round().astype(int))
    unit = time_unit(result.times)
    return {
        "time": {"unit": unit, "values": plain(table["time_s"][kept] / size(unit))},
        "distance": {"unit": "m", "values": plain(table["distance_m"][kept])},
        "left_out": steps - len(kept),
        "panels": [
            {
                "name": name,
                "unit": shown,
                "log": shown.endswith("Pa"),
                "curves": {
                    label: plain(values[kept] / size(shown)) for label, values in curves.items()
                },
            }
            for name, shown, curves in _panels(result, table)
        ],
    }


def _panels(result: Result, table: dict[str, Array]) -> Iterator[tuple[str, str, dict[str, Array]]]:
    """Yield what there is to show over the steps: its name, unit and curves."""

    def of_bodies(column: str) -> dict[str, Array]:
        found = {name: table.get(f"bodies.{name}.{column}") for name in result.body_names}
        return {
            name: values for name, values in found.items() if values is not None and np.any(values)
        }

    def largest(curves: dict[str, Array]) -> float:
        return max((float(np.nanmax(np.abs(values))) for values in curves.values()), default=0.0)

    if len(table["time_s"]) < 2:
        return
    if volumes := of_bodies("wear_volume_m3"):
        yield "Volume worn", "mm³", volumes
    if depths := of_bodies("max_wear_depth_m"):
        yield "Largest wear depth", height_unit(largest(depths)), depths
    pressures = {name: table[f"{name}_pressure_Pa"] for name in ("max", "centre")}
    pressures = {"largest": pressures["max"], "centre": pressures["centre"]}
    yield "Contact pressure", fitting("Pa", largest(pressures)), pressures
    widths = {
        "along sliding": table["contact_half_width_x_m"],
        "across sliding": table["contact_half_width_y_m"],
    }
    yield "Contact half-width", fitting("m", largest(widths)), widths
    if np.ptp(table["load_N"]) > 0:
        yield "Normal load", "N", {"load": table["load_N"]}
    if rough := of_bodies("Sq_m"):
        yield "Roughness Sq in the contact", height_unit(largest(rough)), rough
