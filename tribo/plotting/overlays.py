"""Pictures of several results, by label, at one time: their sections laid over each other.

Each raises CaseError if a result holds no save at that time, in s, or no such body.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.plotting.difference import difference_map
from tribo.plotting.figures import write_figures
from tribo.plotting.sections import removed, scar_mask, through_centre
from tribo.plotting.style import WIDE, house_style, legend_below, new_figure, overlay_looks
from tribo.plotting.units import fitting, height_unit
from tribo.result.read import Result

Results = Mapping[str, Result]
Saves = Sequence[tuple[Result, int]]
Fields = Sequence[tuple[Grid, Array, Mask]]
"""What is drawn of each result: its grid, a field, and which cells are to be seen."""


def comparison_picture(results: Results, time: float, parts: Sequence[str] | None = None) -> Figure:
    """Draw several results as one figure: sections through the windows' centres, along and across.

    `parts` are the rows: the name of a body for its surface, ``""`` for the pressure; if left out,
    the pressure and all worn bodies.
    """
    looks, labels = overlay_looks(len(results)), list(results)
    saves = [(result, result.save_at(time)) for result in results.values()]
    names = ["", *_worn_in_all(results, time)] if parts is None else list(parts)
    with house_style():
        figure = new_figure(16.0 + 40.0 * len(names), WIDE)
        rows = figure.subplots(len(names), 2, sharey="row", squeeze=False)
        for row, name in zip(rows, names, strict=True):
            fields = _surfaces(saves, name) if name else _pressures(saves)
            sections = through_centre(fields)
            shown = [line for section in sections for line in section.in_sight()]
            low, high = float(min(map(np.min, shown))), float(max(map(np.max, shown)))
            # A flat has a range too, so that its height reads as a round number.
            margin = 0.05 * max(high - low, abs(high), 1e-8)
            up = (low - margin if name else 0.0, high + margin)
            unit = height_unit(max(map(abs, up))) if name else fitting("Pa", high)
            for axes, section in zip(row, sections, strict=True):
                curves = section.draw(axes, unit, looks, labels, up)
            row[0].set_ylabel(f"Height of {name} ({unit})" if name else f"Pressure ({unit})")
        rows[0, 0].set_title(f"t = {time:g} s", loc="left")
        legend_below(figure, curves)
    return figure


def _pressures(saves: Saves) -> Fields:
    fields = [(result.grid, result.field("pressure", i)) for result, i in saves]
    return [(grid, field, field > 0) for grid, field in fields]


def _surfaces(saves: Saves, name: str) -> Fields:
    return [
        (result.grid, result.body(name).surface(i), scar_mask(removed(result, name)[i]))
        for result, i in saves
    ]


def save_overlays(
    results: Results, times: Sequence[float], folder: Path, suffix: str = "png"
) -> list[Path]:
    """Write every overlay that makes sense for several results.

    Parameters
    ----------
    results : Mapping
        The results by label; the first is what the others are compared with.
    times : sequence of float
        Of saves of all, in s.
    folder : Path
        Where to; it is made if need be.
    suffix : str, optional
        The format.

    Returns
    -------
    list of Path
        For each time T: ``comparison_Ts``, and ``difference_N_Ts`` of the Nth result where it is
        on the first one's grid and differs from it.

    Raises
    ------
    CaseError
        If a result has no save at one of the times.
    OutputError
        If they cannot be written.
    """
    first = next(iter(results.values()))
    pictures: dict[str, Callable[[], Figure]] = {}
    for time in times:
        pictures[f"comparison_{time:g}s"] = partial(comparison_picture, results, time)
        pressure = first.field("pressure", first.save_at(time))
        for number, (label, result) in enumerate(results.items(), start=1):
            if (result.grid.size, result.grid.cells) != (first.grid.size, first.grid.cells):
                continue
            if np.any(result.field("pressure", result.save_at(time)) != pressure):
                drawn = partial(difference_map, results, label, time)
                pictures[f"difference_{number}_{time:g}s"] = drawn
    return write_figures(pictures, folder, suffix)


def _worn_in_all(results: Results, time: float) -> list[str]:
    """Return the names of bodies that all results have and one at least has worn by then."""
    first = next(iter(results.values()))
    return [
        name
        for name in first.body_names
        if all(name in result.body_names for result in results.values())
        and any(
            np.any(removed(result, name)[result.save_at(time)] > 0) for result in results.values()
        )
    ]
