"""Pictures of several results at one time: their sections laid over each other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.plotting.difference import difference_map
from tribo.plotting.figures import write_figures
from tribo.plotting.pressure import AXIS_LABELS
from tribo.plotting.profiles import enlargement, visible
from tribo.plotting.style import (
    WIDE,
    house_style,
    legend_below,
    legend_height,
    new_figure,
    overlay_strokes,
)
from tribo.plotting.units import Unit, height_unit, length_unit, pressure_unit
from tribo.plotting.window import Limits, limits, removed, scar_mask, spread
from tribo.results.export import profile
from tribo.results.read import Result

_COLUMNS = 3
_SHAPE = 0.62

Results = Mapping[str, Result]


def pressure_overlay(results: Results, time: float) -> Figure:
    """Draw the pressure of several results along and across the sliding direction.

    The sections go through the windows' centres.

    Parameters
    ----------
    results : Mapping
        What to draw, by label.
    time : float
        Of a save of all, in s.

    Raises
    ------
    CaseError
        If one has no save then.
    """
    fields = {label: result.pressure(result.save_at(time)) for label, result in results.items()}
    windows = [
        _joined(limits(fields[label] > 0, result.grid, axis) for label, result in results.items())
        for axis in (0, 1)
    ]
    length = length_unit(max(abs(end) for window in windows for end in window))
    highest = max(float(np.max(field)) for field in fields.values())
    unit = pressure_unit(highest)
    with house_style():
        figure = new_figure(54.0 + legend_height(len(results), _COLUMNS), WIDE)
        panels = figure.subplots(1, 2, sharey=True)
        for axis, axes in enumerate(panels):
            curves = [
                stroke.draw(
                    axes,
                    length.of(_position(results[label].grid, axis)),
                    unit.of(profile(field, axis)),
                    label,
                )
                for stroke, (label, field) in zip(
                    overlay_strokes(len(fields)), fields.items(), strict=True
                )
            ]
            _label(axes, windows[axis], axis, length)
        panels[0].set_ylim(0.0, 1.05 * unit.factor * highest or 1.0)
        panels[0].set_ylabel(f"Pressure ({unit.name})")
        panels[0].set_title(f"t = {time:g} s", loc="left")
        legend_below(figure, curves, columns=_COLUMNS)
    return figure


def profile_overlay(results: Results, name: str, time: float) -> Figure:
    """Draw a body's worn surface in several results, along and across the sliding direction.

    A swept body has one section only, across.

    Parameters
    ----------
    results : Mapping
        What to draw, by label.
    name : str
        The body.
    time : float
        Of a save of all, in s.

    Raises
    ------
    CaseError
        If one has no such body, or no save then.
    """
    saves = {label: result.save_at(time) for label, result in results.items()}
    bodies = {label: result.body(name) for label, result in results.items()}
    axes_shown = (1,) if all(body.swept for body in bodies.values()) else (0, 1)
    marked = {label: scar_mask(removed(results[label], name)[i]) for label, i in saves.items()}
    windows = {
        axis: _joined(limits(marked[label], results[label].grid, axis) for label in results)
        for axis in axes_shown
    }
    lines = {
        axis: {label: profile(bodies[label].surface(i), axis) for label, i in saves.items()}
        for axis in axes_shown
    }
    low, high = spread(
        [
            visible(line, _position(results[label].grid, axis), windows[axis])
            for axis in axes_shown
            for label, line in lines[axis].items()
        ]
    )
    length = length_unit(max(abs(end) for window in windows.values() for end in window))
    unit = height_unit(max(abs(low), abs(high)))
    with house_style():
        figure = new_figure(
            56.0 + legend_height(len(results), _COLUMNS), WIDE * (0.5 + 0.5 * (len(axes_shown) > 1))
        )
        panels = figure.subplots(1, len(axes_shown), sharey=True, squeeze=False)[0]
        for axis, axes in zip(axes_shown, panels, strict=True):
            curves = [
                stroke.draw(
                    axes, length.of(_position(results[label].grid, axis)), unit.of(line), label
                )
                for stroke, (label, line) in zip(
                    overlay_strokes(len(results)), lines[axis].items(), strict=True
                )
            ]
            _label(axes, windows[axis], axis, length)
            axes.set_box_aspect(_SHAPE)
            axes.set_title(
                enlargement(windows[axis], (low, high), _SHAPE), loc="right", fontsize=7.0
            )
        panels[0].set_ylim(unit.factor * low, unit.factor * high)
        panels[0].set_ylabel(f"Height ({unit.name})")
        panels[0].set_title(f"{name}, t = {time:g} s", loc="left")
        legend_below(figure, curves, columns=_COLUMNS)
    return figure


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
        For each time T: ``pressure_Ts``, ``NAME_Ts`` of each worn body NAME, and
        ``difference_N_Ts`` of the Nth result where it is on the first one's grid
        and differs from it.

    Raises
    ------
    CaseError
        If a result has no save at one of the times.
    OutputError
        If they cannot be written.
    """
    pictures: dict[str, Callable[[], Figure]] = {}
    for time in times:
        pictures |= _pictures(results, time)
    return write_figures(pictures, folder, suffix)


def _pictures(results: Results, time: float) -> dict[str, Callable[[], Figure]]:
    first = next(iter(results.values()))
    pictures: dict[str, Callable[[], Figure]] = {
        f"pressure_{time:g}s": partial(pressure_overlay, results, time)
    }
    for name in first.body_names:
        if all(name in result.body_names for result in results.values()) and any(
            np.any(removed(result, name)[result.save_at(time)] > 0) for result in results.values()
        ):
            pictures[f"{name}_{time:g}s"] = partial(profile_overlay, results, name, time)
    pressure = first.pressure(first.save_at(time))
    for number, (label, result) in enumerate(results.items(), start=1):
        if (result.grid.size, result.grid.cells) != (first.grid.size, first.grid.cells):
            continue
        if np.any(result.pressure(result.save_at(time)) != pressure):
            pictures[f"difference_{number}_{time:g}s"] = partial(
                difference_map, results, label, time
            )
    return pictures


def _joined(windows: Iterable[Limits]) -> Limits:
    lows, highs = zip(*windows, strict=True)
    return min(lows), max(highs)


def _position(grid: Grid, axis: int) -> Array:
    return (grid.x, grid.y)[axis]


def _label(axes: Axes, window: Limits, axis: int, length: Unit) -> None:
    axes.set_xlim(*(length.factor * end for end in window))
    axes.set_xlabel(f"{AXIS_LABELS[axis]} ({length.name})")
    axes.xaxis.set_major_locator(MaxNLocator(5))
