"""Sections and histories of one result, or of several over each other, as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from tribo import Array, Mask, Result
from tribo.kernel_api import (
    axis_units,
    kept_fields,
    limits,
    profile,
    removed,
    scar_mask,
    shown_in,
    size,
    time_labels,
    time_unit,
)

from tribo_report.reduced import Blocks, block_words, each_plain, plain

MOST_SAVES = 40
"""Saves in a report: six maps of so many have 32² cells within `fields.NUMBERS`."""
LONGEST = 400
"""Points of a section, and of a history."""
NUMBERS = 150_000
"""Numbers in all sections together, which keeps the file below 4 MB."""
AT_SAVES = "A mark for each save; not known between."

Results = Mapping[str, Result]
"""By label; empty for a single result."""
Curves = Mapping[str, tuple[Result, list[Array]]]
"""Fields of a result, one for each time, by the name of their curve."""
Panel = tuple[str, str, dict[str, list[Array]]]
"""Name, SI unit, and curves by what they are called: distance, time and values."""


def thinned(count: int, most: int = MOST_SAVES) -> list[int]:
    """Return the indices of at most so many of `count`, spread evenly, both ends included."""
    return [int(i) for i in np.unique(np.linspace(0, count - 1, min(count, most)).round())]


def moments(result: Result, saves: Sequence[int]) -> list[dict[str, str]]:
    """Return the time and the path of saves in words."""
    times, paths = time_labels(result.times), result.distances
    return [{"time": times[i], "distance": f"{paths[i]:.4g} m"} for i in saves]


def touched(result: Result, saves: Sequence[int]) -> Mask:
    """Return the cells in contact at one of some saves, or worn on a stationary body."""
    marked: Mask = np.any([result.field("pressure", i) > 0 for i in saves], axis=0)
    for name in result.body_names:
        if not result.body(name).swept:
            depths = removed(result, name)
            marked = marked | np.any([scar_mask(depths[i]) for i in saves], axis=0)
    return marked


def sections(results: Results, times: Sequence[float]) -> list[dict[str, Any]]:
    """Return sections through the centre, along and across: a chart each, with its curves.

    Parameters
    ----------
    results : Mapping
        One result, or several whose bodies go by the same names.
    times : sequence of float
        Of saves that all have, in s.
    """
    saves = {label: [each.save_at(t) for t in times] for label, each in results.items()}
    pressures = {
        label or "pressure": (result, [result.field("pressure", i) for i in saves[label]])
        for label, result in results.items()
    }
    shown = {"Contact pressure": ("Pa", pressures), **_depths(results, saves)}
    windows = _windows(results, saves)
    units = axis_units([max(map(abs, window)) for window in windows])
    count = 2 * len(times) * sum(len(curves) for _, curves in shown.values())
    most = min(LONGEST, NUMBERS // count)
    return [
        _section(name, axis, windows[axis], units[axis], si, curves, most)
        for axis in (0, 1)
        for name, (si, curves) in shown.items()
    ]


def _depths(results: Results, saves: Mapping[str, list[int]]) -> dict[str, tuple[str, Curves]]:
    """Return the depths at saves by chart: of one result in one, of several in one a body."""
    first = next(iter(results.values()))
    of_bodies = {
        name: {
            label: (result, list(removed(result, name)[saves[label]]))
            for label, result in results.items()
        }
        for name in first.body_names
    }
    worn = {
        name: curves
        for name, curves in of_bodies.items()
        if any(np.any(fields) for _, fields in curves.values())
    }
    if len(results) > 1 or not worn:
        return {f"Wear depth of {name}": ("m", curves) for name, curves in worn.items()}
    return {"Wear depth": ("m", {name: of_body[""] for name, of_body in worn.items()})}


def _windows(results: Results, saves: Mapping[str, list[int]]) -> list[tuple[float, float]]:
    """Return the ends of what was touched in any of the results, along and across, in m."""
    marked = {label: touched(result, saves[label]) for label, result in results.items()}
    found = []
    for axis in (0, 1):
        ends = [limits(marked[label], result.grid, axis) for label, result in results.items()]
        found.append((min(low for low, _ in ends), max(high for _, high in ends)))
    return found


def _section(
    name: str,
    axis: int,
    window: tuple[float, float],
    along: str,
    si: str,
    curves: Curves,
    most: int,
) -> dict[str, Any]:
    """Return the curves of fields, one for each time, along an axis through the centre."""
    largest, lines, sizes = 0.0, {}, []
    for label, (result, fields) in curves.items():
        x = (result.grid.x, result.grid.y)[axis]
        inside = np.flatnonzero((window[0] <= x) & (x <= window[1]))
        blocks = Blocks.of(x[inside], most)
        sizes.append(blocks)
        values = [blocks.mean(profile(field, axis)[inside], 0) for field in fields]
        largest = max([largest, *(float(np.max(np.abs(value))) for value in values)])
        lines[label] = blocks.centres, values
    unit, factor = shown_in(si, np.array([largest]))
    return {
        "name": name,
        "axis": axis,
        "unit": unit,
        "along": along,
        "down": si == "m",
        "curves": {
            label: {"x": plain(x / size(along)), "values": [plain(v / factor) for v in values]}
            for label, (x, values) in lines.items()
        },
        "note": block_words(sizes[:1]),
    }


def history(results: Results) -> dict[str, Any]:
    """Return panels of curves over the steps, against the distance, and the time."""
    tables, left_out = dict[str, dict[str, Array]](), 0
    for label, result in results.items():
        every = result.table("history")
        kept = thinned(len(every["time_s"]), LONGEST)
        tables[label] = {name: column[kept] for name, column in every.items()}
        left_out += len(every["time_s"]) - len(kept)
    note = f"{left_out} further steps are left out of the curves." if left_out else ""
    names = next(iter(results.values())).body_names
    panels = [(*p, note or "Every step is shown.") for p in _panels(tables, names)]
    panels += [(*p, AT_SAVES) for p in _of_models(results)]
    unit = time_unit(max((result.times for result in results.values()), key=lambda t: t[-1]))
    axes = []
    for across, (words, shown) in enumerate((("Sliding distance", "m"), ("Time", unit))):
        drawn = []
        for name, si, curves, note in panels:
            fit, factor = shown_in(si, np.concatenate([y for *_, y in curves.values()]))
            drawn.append(
                {
                    "name": name,
                    "unit": fit,
                    "log": si == "Pa",
                    "note": note,
                    "dotted": note == AT_SAVES,
                    "curves": [
                        {
                            "name": called,
                            "x": plain(curve[across] / size(shown)),
                            "y": each_plain(curve[-1] / factor),
                        }
                        for called, curve in curves.items()
                    ],
                }
            )
        axes.append({"name": words.lower(), "label": f"{words} ({shown})", "panels": drawn})
    return {"axes": axes}


def _panels(tables: Mapping[str, Mapping[str, Array]], bodies: Sequence[str]) -> Iterator[Panel]:
    """Yield the panels of the steps."""
    for name, si, columns in _columns(bodies):
        curves = {
            ", ".join(part for part in (label, called) if part): [
                table[each] for each in ("distance_m", "time_s", column)
            ]
            for label, table in tables.items()
            for called, column in columns.items()
            if column in table and len(table["time_s"]) > 1 and np.nansum(np.abs(table[column])) > 0
        }
        # A load that is one number for all says nothing.
        if curves and not (
            si == "N" and np.ptp(np.concatenate([y for *_, y in curves.values()])) == 0
        ):
            yield name, si, curves


def _of_models(results: Results) -> Iterator[Panel]:
    """Yield the panels of fields of effects and states of models, at the saves."""
    found: dict[tuple[str, str], dict[str, list[Array]]] = {}
    for label, result in results.items():
        for field in kept_fields(result) if len(result.times) > 1 else ():
            curves = found.setdefault((field.name.capitalize(), field.unit), {})
            shown = {"": field.values.reshape(len(result.times), -1)[:, 0]}
            if field.varies:
                means = [field.mean(result, save) for save in range(len(result.times))]
                largest = field.values.max(axis=(1, 2))
                shown = {"largest": largest, "mean in the contact": np.array(means)}
            for called, values in shown.items():
                name = ", ".join(part for part in (label, called) if part)
                curves[name or field.name] = [result.distances, result.times, values]
    for (name, unit), curves in found.items():
        yield name, unit, curves


def _columns(bodies: Sequence[str]) -> Iterator[tuple[str, str, dict[str, str]]]:
    """Yield the possible panels: name, unit, and columns by the name of a curve."""
    for name, si, column in (
        ("Volume worn", "m^3", "wear_volume_m3"),
        ("Largest wear depth", "m", "max_wear_depth_m"),
    ):
        yield name, si, {body: f"bodies.{body}.{column}" for body in bodies}
    pressures = {"largest": "max_pressure_Pa", "centre": "centre_pressure_Pa"}
    yield "Contact pressure", "Pa", pressures
    widths = {"along": "contact_half_width_x_m", "across": "contact_half_width_y_m"}
    yield "Contact half-width", "m", widths
    yield "Normal load", "N", {"load": "load_N"}
    yield "Friction force", "N", {"friction": "friction_force_N"}
    yield "Work of friction", "J", {"work": "friction_energy_J"}
