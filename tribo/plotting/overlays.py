"""Pictures of several results, by label, at one time, over each other.

Each raises CaseError if a result holds no save at that time, in s, or no such body.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.lab.scar import removed, scar_mask
from tribo.plotting.maps import Scale
from tribo.plotting.picture import Panel, Picture
from tribo.plotting.sections import heights_row, section_row, through_centre, varying
from tribo.plotting.style import Look, save_looks
from tribo.result.read import Result

Results = Mapping[str, Result]
FIRST: Look = {"color": "#a8a8a8", "linewidth": 3.0}
"""Of the first result, which shows below a coinciding curve."""


def comparison_picture(
    results: Results, time: float, parts: Sequence[str] | None = None, ax: Any = None
) -> Figure:
    """Draw several results as one figure: sections through the windows' centres, along and across.

    `parts` are the rows: the name of a body for its surface, ``""`` for the pressure; if left out,
    the pressure and all worn bodies. All rows show the same part of the windows; there is none
    along an axis along which nothing varies. `ax` are axes to draw on, one for each panel.
    """
    looks, labels = [FIRST, *save_looks(len(results) - 1)], list(results)
    names = ["", *_worn(results, time)] if parts is None else list(parts)
    every = results.values()
    drawn = {name: [_surface(result, time, name) for result in every] for name in names}
    worn = (_field(result, time, name) for name in names for result in every)
    axes = sorted({axis for _, field, marked in worn for axis in varying([field], marked)}) or [0]
    sections = {name: through_centre(f, axes) for name, f in drawn.items()}
    windows = [[row[i].window for row in sections.values()] for i in range(len(axes))]
    shared = [(min(low for low, _ in each), max(high for _, high in each)) for each in windows]

    rows: list[list[Panel]] = []
    for name, row in sections.items():
        row = [replace(one, window=window) for one, window in zip(row, shared, strict=True)]
        title = "" if rows else f"t = {time:g} s{_grids(results)}"
        if name:
            rows.append(heights_row(row, looks, labels, title, f"Height of {name}"))
        else:
            high = max(float(np.max(line)) for one in row for line in one.in_sight())
            scale, up = Scale.of("", high), (0.0, 1.05 * high)
            rows.append(section_row(row, looks, labels, (scale.label, scale.factor), up, title))
    picture = Picture(rows, 45.0, "y")
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


def _worn(results: Results, time: float) -> list[str]:
    """Return the names of the bodies that one result at least has worn by then."""
    every = results.values()
    return [
        name
        for name in next(iter(every)).body_names
        if any(np.any(removed(result, name)[result.save_at(time)] > 0) for result in every)
    ]
