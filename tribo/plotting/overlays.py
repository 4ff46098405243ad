"""Pictures of several results, by label, at one time: over each other, and their differences.

Each raises CaseError if a result holds no save at that time, in s, or no such body.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.lab.scar import removed, scar_mask
from tribo.lab.units import fitting, height_unit, size
from tribo.plotting.figures import write_figures
from tribo.plotting.maps import Scale, field_picture
from tribo.plotting.picture import NothingToDraw, Picture, below_each_other
from tribo.plotting.sections import MOST_CELLS, bodies_end, through_centre, varying
from tribo.plotting.style import DIFFERENCES, SINGLE_COLUMN, WIDE, overlay_looks
from tribo.result.read import Result

Results = Mapping[str, Result]


def comparison_picture(
    results: Results, time: float, parts: Sequence[str] | None = None, ax: Any = None
) -> Figure:
    """Draw several results as one figure: sections through the windows' centres, along and across.

    `parts` are the rows: the name of a body for its surface, ``""`` for the pressure; if left out,
    the pressure and all worn bodies. All rows show the same part of the windows; there is none
    along an axis along which nothing varies. `ax` are axes to draw on, one for each panel.
    """
    looks, labels = overlay_looks(len(results)), list(results)
    names = ["", *_worn(results, time)] if parts is None else list(parts)
    every = results.values()
    drawn = {name: [_surface(result, time, name) for result in every] for name in names}
    worn = (_field(result, time, name) for name in names for result in every)
    axes = sorted({axis for _, field, marked in worn for axis in varying([field], marked)}) or [0]
    ends = any(map(bodies_end, every))
    sections = {name: through_centre(f, axes, ends=ends) for name, f in drawn.items()}
    windows = [[row[i].window for row in sections.values()] for i in range(len(axes))]
    shared = [(min(low for low, _ in each), max(high for _, high in each)) for each in windows]

    def panel(name: str, column: int, panel_axes: Axes) -> Sequence[Artist]:
        section = replace(sections[name][column], window=shared[column])
        shown = [line for part in sections[name] for line in part.in_sight()]
        low, high = float(min(map(np.min, shown))), float(max(map(np.max, shown)))
        # A flat has a range too, so that its height reads as a round number.
        margin = 0.05 * max(high - low, abs(high), 1e-8)
        up = (low - margin if name else 0.0, high + margin)
        unit = height_unit(max(map(abs, up))) if name else fitting("Pa", high)
        panel_axes.set_ylabel(f"Height of {name} ({unit})" if name else f"Pressure ({unit})")
        if name == names[0] and column == 0:
            panel_axes.set_title(f"t = {time:g} s{_grids(results)}", loc="left")
        return section.draw(panel_axes, size(unit), looks, labels, up)

    rows = [[partial(panel, name, column) for column in range(len(axes))] for name in names]
    picture = Picture(rows, 45.0, WIDE if len(axes) > 1 else SINGLE_COLUMN, "y")
    return picture.figure() if ax is None else np.ravel(picture.draw(ax))[0].figure


def _grids(results: Results) -> str:
    cells = dict.fromkeys(" × ".join(map(str, result.grid.cells)) for result in results.values())
    return f"; grids differ: {', '.join(cells)} cells" if len(cells) > 1 else ""


def _field(result: Result, time: float, name: str) -> tuple[Grid, Array, Mask]:
    """Return the depth of a body's surface below its first, or for "" the pressure."""
    save = result.save_at(time)
    field = removed(result, name)[save] if name else result.field("pressure", save)
    return result.grid, field, scar_mask(field)


def _surface(result: Result, time: float, name: str) -> tuple[Grid, Array, Mask]:
    """Return a body's surface, or for "" the pressure."""
    grid, field, marked = _field(result, time, name)
    return grid, result.body(name).surface(result.save_at(time)) if name else field, marked


def difference_map(results: Results, label: str, time: float) -> Picture:
    """Draw the difference of a result from the first: pressure, and depth of stationary bodies.

    `results` are by label; `label` is the result to draw, `time` a saved time of both, in s. Fields
    that vary along one axis only are left out: `comparison_picture` shows them. CaseError if the
    two have different grids, or `NothingToDraw` if they differ along one axis at most.
    """
    first_label, first = next(iter(results.items()))
    result, grid = results[label], first.grid
    if (grid.size, grid.cells) != (result.grid.size, result.grid.cells):
        raise CaseError(
            f"{label} and {first_label} have different grids, so that there is no map of their "
            "difference"
        )
    bodies = [name for name in result.body_names if not result.body(name).swept]
    pictures: list[Picture] = []
    for name in ("", *bodies):
        (_, other, below), (_, field, above) = (
            _field(each, time, name) for each in (first, result)
        )
        apart, marked = np.asarray(field - other), above | below
        if len(vary := varying([apart], marked)) < 2:
            continue
        most = float(np.percentile(np.abs(apart[marked]), MOST_CELLS))
        scale = Scale.of(name, most)._replace(colours=DIFFERENCES, least=-most, most=most)
        scale = scale._replace(what=f"{scale.what}, difference")
        title = "" if pictures else f"{label} less {first_label}, t = {time:g} s"
        pictures.append(field_picture(apart, marked, grid, scale, title, vary=vary))
    if not pictures:
        raise NothingToDraw(f"{label} and {first_label} differ along one axis at most")
    return below_each_other(pictures)


def save_overlays(
    results: Results, times: Sequence[float], folder: Path, suffix: str = "png"
) -> list[Path]:
    """Write the overlays of several results by label at `times` of all, in s; see `save_figures`.

    The files are for each time T ``comparison_Ts``, and ``difference_N_Ts`` of the Nth result where
    it is on the first one's grid and differs from it along both axes.
    """
    pictures: dict[str, Callable[[], Figure]] = {}
    for time in times:
        pictures[f"comparison_{time:g}s"] = partial(comparison_picture, results, time)
        for number, label in enumerate(results, start=1):
            with suppress(CaseError):
                drawn = difference_map(results, label, time)
                pictures[f"difference_{number}_{time:g}s"] = drawn.figure
    return write_figures(pictures, folder, suffix)


def _worn(results: Results, time: float) -> list[str]:
    """Return the names of the bodies that one result at least has worn by then."""
    every = results.values()
    return [
        name
        for name in next(iter(every)).body_names
        if any(np.any(removed(result, name)[result.save_at(time)] > 0) for result in every)
    ]
