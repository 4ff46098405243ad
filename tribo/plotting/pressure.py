"""Pictures of the contact pressure: the full field, and sections over time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
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
_EVEN = 0.1
"""Pressures that differ by less, in parts of the largest, get no lines on the map."""
_PANEL = (52.0, 64.0)
"""Most width and height of a map, in mm."""
_WIDEST, _TALLEST = 1 / 3, 2.0
"""Height over width between which a map's window is kept."""
_THINNEST = 8.0
"""Thinner contacts are not shown true to scale."""
_ALTERED = 0.1
"""Most cells, in parts of the contact, that a smooth edge may leave on its wrong side."""
_COLUMNS = 6
_FADED = 2.0
"""A first pressure so many times the later ones is drawn whole in a panel of its own."""


def pressure_map(result: Result, save: int = -1) -> Figure:
    """Draw the pressure at a save from above.

    The scale goes from zero to the largest pressure. Thin lines are those of
    equal pressure; where nine tenths of the contact bear the same within a
    tenth there are none, and the title says how even the pressure is. The thick
    line is the edge of the contact, drawn smoothly through the steps of the
    cells, and the dashed one Hertz's first contact where the surfaces state
    their curvature.

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
    true_to_scale = 1 / _THINNEST <= shape <= _THINNEST
    shown = min(max(shape, _WIDEST), _TALLEST)
    if true_to_scale:
        window = [_widened(window[0], shape / shown), _widened(window[1], shown / shape)]
    notes = [f"t = {time_labels(result)[save]}"]
    with house_style():
        width = min(_PANEL[0], _PANEL[1] / shown)
        figure = new_figure(max(width * shown, 34.0) + 22.0)
        axes = figure.add_subplot()
        axes.spines[:].set_visible(True)
        image = _draw_field(axes, grid, pressure, length, unit)
        levels, unevenness = _levels(pressure)
        if len(levels):
            _draw_levels(axes, grid, pressure, unit.of(levels), length, unit)
        else:
            notes.append(f"even within {max(100 * unevenness, 1.0):.0f} %")
        axes.set_box_aspect(shown)
        axes.set_xlim(*(length.factor * end for end in window[0]))
        axes.set_ylim(*(length.factor * end for end in window[1]))
        axes.xaxis.set_major_locator(MaxNLocator(max(3, round(width / 9.0))))
        axes.yaxis.set_major_locator(MaxNLocator(max(3, round(width * shown / 7.0))))
        axes.set_xlabel(f"{AXIS_LABELS[0]} ({length.name})")
        axes.set_ylabel(f"{AXIS_LABELS[1]} ({length.name})")
        if not true_to_scale:
            notes.append("not to scale")
        axes.set_title(", ".join(notes), loc="left")
        # Inside the axes it is as high as they are, whatever their shape.
        scale = axes.inset_axes((1.0 + 2.0 / width, 0.0, 3.0 / width, 1.0))
        figure.colorbar(
            image,
            cax=scale,
            label=f"Pressure ({unit.name})",
            ticks=MaxNLocator(max(3, round(width * shown / 9.0))),
        )
        if hertz is not None:
            legend_below(figure, [_draw_first_contact(axes, hertz, length)])
    return figure


def pressure_sections(result: Result) -> Figure:
    """Draw the pressure along and across the sliding direction at every save.

    The sections go through the window's centre. Where later pressures are
    dwarfed by the first, that one leaves the top and stands whole in a narrow
    panel beside, along the axis on which its contact is shorter.

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
    faded = first > _FADED * later > 0
    labels, strokes = time_labels(result), save_strokes(count)
    with house_style():
        figure = new_figure(52.0 + legend_height(count + 1, _COLUMNS), WIDE)
        panels = figure.subplots(1, 3 if faded else 2, width_ratios=(1, 2, 2) if faded else (1, 1))
        main = panels[-2:]
        for axis, (axes, window) in enumerate(zip(main, windows, strict=True)):
            position = length.of((grid.x, grid.y)[axis])
            curves = [
                stroke.draw(axes, position, unit.of(section), label)
                for stroke, section, label in zip(strokes, sections[axis], labels, strict=True)
            ]
            if hertz is not None:
                curves.append(_draw_hertz(axes, hertz, window, axis, length, unit))
            _label_section(axes, window, axis, length)
        main[0].set_ylabel(f"Pressure ({unit.name})")
        main[1].tick_params(labelleft=False)
        for axes in main:
            axes.set_ylim(0.0, 1.05 * unit.factor * (later if faded else max(first, later)))
        if faded:
            ends = [limits(fields[0] > 0, grid, i, _hertz_width(hertz, i)) for i in (0, 1)]
            axis = 0 if np.ptp(ends[0]) <= np.ptp(ends[1]) else 1
            whole = panels[0]
            position, section = length.of((grid.x, grid.y)[axis]), sections[axis][0]
            strokes[0].draw(whole, position, unit.of(section), labels[0])
            if hertz is not None:
                _draw_hertz(whole, hertz, ends[axis], axis, length, unit)
            _label_section(whole, ends[axis], axis, length, ticks=3)
            whole.set_xlabel(f"{'xy'[axis]} ({length.name})")
            whole.set_ylabel(f"Pressure ({unit.name})")
            highest = max(float(np.max(section)), hertz.peak_pressure if hertz else 0.0)
            whole.set_ylim(0.0, 1.05 * unit.factor * highest)
            whole.set_title(f"{labels[0]}, whole", loc="left", fontsize=7.0)
            main[0].set_title("enlarged", loc="left", fontsize=7.0)
        _mark_hardness(panels[: 1 if faded else 2], result.system.cap, max(first, later), unit)
        legend_below(figure, curves, columns=_COLUMNS)
    return figure


def _label_section(axes: Axes, window: Limits, axis: int, length: Unit, ticks: int = 5) -> None:
    axes.set_xlim(*(length.factor * end for end in window))
    axes.set_xlabel(f"{AXIS_LABELS[axis]} ({length.name})")
    axes.xaxis.set_major_locator(MaxNLocator(ticks))


def _mark_hardness(row: Iterable[Axes], cap: float | None, highest: float, unit: Unit) -> None:
    """Draw the largest pressure the softer body bears, where the contact comes near it."""
    if cap is None or highest < 0.9 * cap:
        return
    for axes in row:
        axes.axhline(unit.factor * cap, color="black", linewidth=0.6, linestyle=":")
        axes.set_ylim(0.0, 1.1 * unit.factor * cap)
        # A narrow panel has no room for it beside another title.
        titles = (axes.get_title(loc="left"), "dotted: hardness")
        axes.set_title("\n".join(filter(None, titles)), loc="left", fontsize=7.0)


def _widened(ends: Limits, factor: float) -> Limits:
    """Return limits `factor` times as far apart, if that is more, about the same middle."""
    middle, half = 0.5 * (ends[0] + ends[1]), 0.5 * max(factor, 1.0) * (ends[1] - ends[0])
    return middle - half, middle + half


def _draw_field(axes: Axes, grid: Grid, pressure: Array, length: Unit, unit: Unit) -> AxesImage:
    """Draw the field with the edge of the contact, and white outside of that."""
    half_x, half_y = (0.5 * length.factor * size for size in grid.size)
    touching = pressure > 0
    inside = _smooth(touching.astype(float))
    kept = (inside > 0.5) == touching
    # What is only a few cells small is shown cell by cell.
    smooth = bool(np.sum(~kept) < _ALTERED * np.sum(touching))
    image = axes.imshow(
        unit.of(_continued(pressure)).T if smooth else unit.of(pressure).T,
        cmap=pressure_colours(),
        vmin=0.0,
        vmax=unit.factor * float(np.max(pressure)) or 1.0,
        origin="lower",
        extent=(-half_x, half_x, -half_y, half_y),
        interpolation="bilinear" if smooth else "nearest",
    )
    edge = np.pad(inside if smooth else touching.astype(float), 1, mode="edge").T
    x, y = (length.of(_padded(position)) for position in (grid.x, grid.y))
    if np.any(touching):
        (region,) = axes.contourf(x, y, edge, levels=[0.5, 2.0], alpha=0.0).get_paths()
        image.set_clip_path(region, transform=axes.transData)
    if not np.all(touching):
        axes.contour(x, y, edge, levels=[0.5], colors="black", linewidths=0.9)
    return image


def _padded(position: Array) -> Array:
    """Return positions with one more at either end."""
    return np.concatenate(
        ([2 * position[0] - position[1]], position, [2 * position[-1] - position[-2]])
    )


def _smooth(field: Array, times: int = 3) -> Array:
    """Return a field averaged with its neighbours, those beyond the window being alike."""
    for _ in range(times):
        for axis in (0, 1):
            wide = np.pad(field, [(1, 1) if i == axis else (0, 0) for i in (0, 1)], mode="edge")
            low, middle, high = (
                np.take(wide, range(start, start + field.shape[axis]), axis=axis)
                for start in range(3)
            )
            field = np.asarray(0.25 * low + 0.5 * middle + 0.25 * high)
    return field


def _continued(pressure: Array) -> Array:
    """Return the pressure, and around the contact what the nearest of its cells bear."""
    touching = pressure > 0
    weight = _smooth(touching.astype(float))
    nearby = np.divide(_smooth(pressure), weight, out=np.zeros_like(pressure), where=weight > 0)
    return np.where(touching, pressure, nearby)


def _levels(pressure: Array) -> tuple[Array, float]:
    """Return pressures to draw lines at, few or none, and how uneven the pressure is.

    That is the span of nine tenths of the contact in parts of the largest.
    """
    bearing = pressure[pressure > 0]
    if bearing.size == 0:
        return np.array([]), 0.0
    low, high = (float(end) for end in np.percentile(bearing, (5.0, 95.0)))
    unevenness = (high - low) / float(np.max(bearing))
    if unevenness < _EVEN:
        return np.array([]), unevenness
    levels = np.asarray(MaxNLocator(3, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high))
    return levels[(levels > low) & (levels < high)], unevenness


def _draw_levels(
    axes: Axes, grid: Grid, pressure: Array, levels: Array, length: Unit, unit: Unit
) -> None:
    """Draw labelled lines of equal pressure."""
    touching = pressure > 0
    weight = _smooth(touching.astype(float), 2)
    # The jumps of single cells would make the lines ragged, and those at the rim into crumbs.
    shown = np.ma.masked_where(weight < 0.99, unit.of(_smooth(pressure, 2))).T
    bright = levels > 0.55 * unit.factor * float(np.max(pressure))
    lines = axes.contour(
        length.of(grid.x),
        length.of(grid.y),
        shown,
        levels=levels,
        colors=["black" if light else "white" for light in bright],
        linewidths=0.5,
    )
    axes.clabel(lines, fontsize=6.0, fmt="%g", inline_spacing=2)


def _draw_first_contact(axes: Axes, hertz: HertzContact, length: Unit) -> Line2D:
    """Draw the ellipse, or the two lines, inside which Hertz's contact lies.

    Return an entry for the legend.
    """
    a, b = length.factor * hertz.half_width_x, length.factor * hertz.half_width_y
    look: dict[str, Any] = {
        "color": "black",
        "linewidth": 0.8,
        "linestyle": (0.0, (4.0, 2.5)),
        "path_effects": [withStroke(linewidth=1.8, foreground="white")],
    }
    if np.isfinite(a) and np.isfinite(b):
        axes.add_patch(Ellipse((0.0, 0.0), 2 * a, 2 * b, fill=False, **look))
    else:
        draw = axes.axhline if np.isinf(a) else axes.axvline
        for end in (-min(a, b), min(a, b)):
            draw(end, **look)
    del look["path_effects"]
    return Line2D([], [], label="Hertz, 0 s", **look)


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
