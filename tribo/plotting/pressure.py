"""Pictures of the contact pressure: the full field, and sections over time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from tribo.analysis.first_contact import HertzContact, hertz_contact
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.plotting.style import (
    WIDE,
    Stroke,
    house_style,
    legend_below,
    legend_height,
    new_figure,
    pressure_colours,
    save_strokes,
)
from tribo.plotting.units import Unit, length_unit, pressure_unit, time_labels
from tribo.plotting.window import Limits, checked_save, limits, number_of_saves
from tribo.results.export import profile
from tribo.results.read import Result

HERTZ = Stroke("#909090", width=0.7)
AXIS_LABELS = ("Along sliding, x", "Across sliding, y")
_PLATEAU = 0.5
"""Where nearly all pressures exceed this part of the largest, the scale leaves out the rest."""
_NARROWEST = 0.8
"""The scale begins no higher than this part of the largest pressure, lest it show noise."""
_COLUMNS = 6
_FADED = 3.0
"""A first pressure so many times the later ones gets the later ones a panel of their own."""


def pressure_map(result: Result, save: int = -1) -> Figure:
    """Draw the pressure at a save from above.

    Thin lines are those of equal pressure, at the ticks of the scale; the thick
    one is the edge of the contact, the dashed one Hertz's first contact where the surfaces
    state their curvature.

    Parameters
    ----------
    result : Result
        What to draw.
    save : int, optional
        Number of the save; the last one if left out.

    Returns
    -------
    Figure
        The picture.

    Raises
    ------
    CaseError
        If there is no such save.
    """
    save = checked_save(result, save)
    grid, hertz = result.grid, hertz_contact(result.system)
    pressure = result.pressure(save)
    window = [limits(pressure > 0, grid, axis, _hertz_width(hertz, axis)) for axis in (0, 1)]
    length = length_unit(max(abs(end) for ends in window for end in ends))
    unit = pressure_unit(float(np.max(pressure)))
    shape = (window[1][1] - window[1][0]) / (window[0][1] - window[0][0])
    true_to_scale = 0.25 <= shape <= 4.0
    with house_style():
        figure = new_figure(58.0 * min(max(shape, 0.6), 1.5) + 14.0)
        axes = figure.add_subplot()
        axes.spines[:].set_visible(True)
        _draw_field(axes, grid, pressure, length, unit)
        _draw_edge(axes, grid, pressure, length)
        axes.set_aspect("equal" if true_to_scale else "auto")
        axes.set_xlim(*(length.factor * end for end in window[0]))
        axes.set_ylim(*(length.factor * end for end in window[1]))
        note = "" if true_to_scale else ", not to scale"
        axes.set_xlabel(f"{AXIS_LABELS[0]} ({length.name}{note})")
        axes.set_ylabel(f"{AXIS_LABELS[1]} ({length.name}{note})")
        axes.set_title(f"t = {time_labels(result)[save]}", loc="left")
        if hertz is not None:
            _draw_first_contact(axes, hertz, length)
            axes.set_title("dashed: Hertz, 0 s", loc="right", fontsize=7.0)
    return figure


def pressure_sections(result: Result) -> Figure:
    """Draw the pressure along and across the sliding direction at every save.

    The sections go through the window's centre. Where later pressures are
    dwarfed by the first, a second row shows the same curves enlarged.

    Parameters
    ----------
    result : Result
        What to draw.

    Returns
    -------
    Figure
        The picture.

    Raises
    ------
    CaseError
        If there is no save.
    """
    count = number_of_saves(result)
    grid, hertz = result.grid, hertz_contact(result.system)
    fields = [result.pressure(i) for i in range(count)]
    touched = np.asarray(np.any([field > 0 for field in fields], axis=0))
    windows = [limits(touched, grid, axis, _hertz_width(hertz, axis)) for axis in (0, 1)]
    sections = [[profile(field, axis) for field in fields] for axis in (0, 1)]
    first = max(float(np.max(lines[0])) for lines in sections)
    later = max((float(np.max(line)) for lines in sections for line in lines[1:]), default=0.0)
    length = length_unit(max(abs(end) for window in windows for end in window))
    unit = pressure_unit(max(first, later))
    rows = 2 if first > _FADED * later > 0 else 1
    labels, strokes = time_labels(result), save_strokes(count)
    with house_style():
        figure = new_figure(48.0 * rows + legend_height(count + 1, _COLUMNS), WIDE)
        panels = figure.subplots(rows, 2, sharex="col", sharey="row", squeeze=False)
        for axis, window in enumerate(windows):
            position = length.of((grid.x, grid.y)[axis])
            for axes in panels[:, axis]:
                curves = [
                    stroke.draw(axes, position, unit.of(section), label)
                    for stroke, section, label in zip(strokes, sections[axis], labels, strict=True)
                ]
                if hertz is not None:
                    curves.append(_draw_hertz(axes, hertz, window, axis, length, unit))
            axes.set_xlim(*(length.factor * end for end in window))
            axes.set_xlabel(f"{AXIS_LABELS[axis]} ({length.name})")
            axes.xaxis.set_major_locator(MaxNLocator(6))
        for axes in panels[:, 0]:
            axes.set_ylabel(f"Pressure ({unit.name})")
        panels[-1, 0].set_ylim(0.0, 1.05 * unit.factor * (later if rows == 2 else first))
        panels[0, 0].set_ylim(0.0, 1.05 * unit.factor * max(first, later))
        if rows == 2:
            panels[1, 0].set_title("the same, enlarged", loc="left", fontsize=7.0)
        _mark_hardness(panels[0], result.system.cap, max(first, later), unit)
        legend_below(figure, curves, columns=_COLUMNS)
    return figure


def _mark_hardness(row: Iterable[Axes], cap: float | None, highest: float, unit: Unit) -> None:
    """Draw the largest pressure the softer body bears, where the contact comes near it."""
    if cap is None or highest < 0.9 * cap:
        return
    for axes in row:
        axes.axhline(unit.factor * cap, color="black", linewidth=0.6, linestyle=":")
        axes.set_ylim(0.0, 1.1 * unit.factor * cap)
        axes.set_title("dotted: hardness", loc="right", fontsize=7.0)


def _draw_field(axes: Axes, grid: Grid, pressure: Array, length: Unit, unit: Unit) -> None:
    """Draw the field with its scale, and lines of equal pressure on both."""
    half_x, half_y = (0.5 * length.factor * size for size in grid.size)
    shown = np.ma.masked_less_equal(unit.of(pressure).T, 0.0)
    highest = float(np.max(shown))
    # Where most of the contact bears nearly the same, a scale from zero would hide the rest.
    low = min(float(np.percentile(shown.compressed(), 5.0)), _NARROWEST * highest)
    cut = low > _PLATEAU * highest
    levels = np.asarray(MaxNLocator(6).tick_values(low if cut else 0.0, highest))
    levels = levels[levels <= highest]
    image = axes.imshow(
        shown,
        cmap=pressure_colours(),
        vmin=float(levels[0]),
        vmax=highest,
        origin="lower",
        extent=(-half_x, half_x, -half_y, half_y),
        interpolation="nearest",
    )
    axes.figure.colorbar(
        image,
        ax=axes,
        label=f"Pressure ({unit.name})",
        pad=0.02,
        extend="min" if cut else "neither",
        ticks=levels,
    )
    inner = [level for level in levels if low < level < highest]
    if inner:
        x, y = length.of(grid.x), length.of(grid.y)
        axes.contour(x, y, shown, levels=inner, colors="black", linewidths=0.5)


def _draw_edge(axes: Axes, grid: Grid, pressure: Array, length: Unit) -> None:
    touching = (pressure > 0).astype(float).T
    if 0.0 < np.mean(touching) < 1.0:
        x, y = length.of(grid.x), length.of(grid.y)
        axes.contour(x, y, touching, levels=[0.5], colors="black", linewidths=0.9)


def _draw_first_contact(axes: Axes, hertz: HertzContact, length: Unit) -> None:
    """Draw the ellipse, or the two lines, inside which Hertz's contact lies."""
    a, b = length.factor * hertz.half_width_x, length.factor * hertz.half_width_y
    look: dict[str, Any] = {
        "color": "black",
        "linewidth": 0.8,
        "linestyle": (0.0, (4.0, 2.5)),
        "path_effects": [withStroke(linewidth=1.8, foreground="white")],
    }
    if np.isfinite(a) and np.isfinite(b):
        axes.add_patch(Ellipse((0.0, 0.0), 2 * a, 2 * b, fill=False, **look))
        return
    draw = axes.axhline if np.isinf(a) else axes.axvline
    for end in (-min(a, b), min(a, b)):
        draw(end, **look)


def _hertz_width(hertz: HertzContact | None, axis: int) -> float:
    """Return Hertz's half-width along an axis in m; 0 where it has none."""
    if hertz is None:
        return 0.0
    width = (hertz.half_width_x, hertz.half_width_y)[axis]
    return width if np.isfinite(width) else 0.0


def _draw_hertz(
    axes: Axes, hertz: HertzContact, window: Limits, axis: int, length: Unit, unit: Unit
) -> Line2D:
    """Draw Hertz's pressure along an axis through the centre."""
    width = _hertz_width(hertz, axis)
    position = np.linspace(*window, 801)
    if width > 0:
        # The ends of the ellipse belong to the curve.
        position = np.sort(np.append(position, (-width, width)))
        pressure = hertz.peak_pressure * np.sqrt(np.maximum(1 - (position / width) ** 2, 0.0))
    else:
        pressure = np.full_like(position, hertz.peak_pressure)
    return HERTZ.draw(axes, length.of(position), unit.of(pressure), "Hertz, 0 s", zorder=3)
