"""Pictures of the contact pressure: the full field, and sections over time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.lab.first_contact import HertzContact, hertz_contact
from tribo.plotting.maps import Frame, draw_image, draw_lines, frame, new_maps
from tribo.plotting.sections import Section
from tribo.plotting.style import (
    WIDE,
    Stroke,
    house_style,
    legend_below,
    legend_height,
    new_figure,
    pressure_colours,
    save_strokes,
    ticks,
)
from tribo.plotting.units import Unit, pressure_unit, time_labels
from tribo.plotting.window import checked_save, limits, number_of_saves, positions, section_limits
from tribo.result.export import profile
from tribo.result.read import Result

HERTZ = Stroke("#909090", width=0.7)
_EVEN = 0.1
"""Pressures that differ by less, in parts of the largest, get no lines on the map."""
_ALTERED = 0.1
"""Most cells, in parts of the contact, that a smooth edge may leave on its wrong side."""
_COLUMNS = 6
_FADED = 2.0
"""A first pressure so many times the later ones is drawn whole in a panel of its own."""


def pressure_map(result: Result, save: int = -1) -> Figure:
    """Draw the pressure at a save from above.

    The scale goes from zero to the largest pressure. Thin lines are those of
    equal pressure, where they are whole and have room; where nine tenths of
    the contact bear the same within a tenth there are none, and the title
    gives the mean pressure and how even it is. The thick line is the edge of
    the contact, drawn smoothly through the steps of the cells, and the dashed
    one Hertz's first contact where the surfaces state their curvature. A long
    contact is drawn wider than it is, and the axis says how much.

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
    shown = frame(pressure > 0, grid, [_hertz_width(hertz, axis) for axis in (0, 1)])
    unit = pressure_unit(float(np.max(pressure)))
    title = [f"t = {time_labels(result)[save]}"]
    with house_style():
        figure, (axes,) = new_maps(shown, below=0.0 if hertz is None else legend_height(1))
        _draw_field(axes, grid, shown, pressure, unit)
        bearing = pressure[pressure > 0]
        low, high = np.percentile(bearing, (5.0, 95.0)) if bearing.size else (0.0, 0.0)
        unevenness = float(high - low) / (float(np.max(pressure)) or 1.0)
        if unevenness > _EVEN:
            _draw_levels(axes, grid, shown, pressure, unit, _levels(unit, low, high))
        elif bearing.size:
            mean = unit.factor * float(np.mean(bearing))
            title.append(f"{mean:.3g} {unit.name}, even within {max(100 * unevenness, 1.0):.0f} %")
        axes.set_title("\n".join(title), loc="left")
        if hertz is not None:
            legend_below(figure, [_draw_first_contact(axes, hertz, shown)])
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
    reach = [_hertz_width(hertz, axis) for axis in (0, 1)]
    sections = [
        Section(
            axis,
            section_limits(touched, grid, axis, reach[axis]),
            [(positions(grid, axis), profile(field, axis)) for field in fields],
        )
        for axis in (0, 1)
    ]
    first, *rest = (
        max(float(np.max(section.curves[i][1])) for section in sections) for i in range(count)
    )
    later = max(rest, default=0.0)
    unit = pressure_unit(max(first, later))
    faded = first > _FADED * later > 0
    labels, strokes = time_labels(result), save_strokes(count)
    with house_style():
        figure = new_figure(52.0 + legend_height(count + 1, _COLUMNS), WIDE)
        panels = figure.subplots(1, 3 if faded else 2, width_ratios=(1, 2, 2) if faded else (1, 1))
        main = panels[-2:]
        for axes, section in zip(main, sections, strict=True):
            curves = section.draw(axes, unit, strokes, labels)
            if hertz is not None:
                curves.append(_draw_hertz(axes, hertz, section, unit))
            axes.yaxis.set_major_locator(ticks(7))
            axes.set_ylim(0.0, 1.05 * unit.factor * (later if faded else max(first, later)) or 1.0)
        main[0].set_ylabel(f"Pressure ({unit.name})")
        main[1].tick_params(labelleft=False)
        if faded:
            ends = [limits(fields[0] > 0, grid, i, reach[i]) for i in (0, 1)]
            axis = 0 if np.ptp(ends[0]) <= np.ptp(ends[1]) else 1
            _draw_whole(
                panels[0],
                Section(axis, ends[axis], sections[axis].curves[:1]),
                hertz,
                unit,
                strokes,
                labels,
            )
            main[0].set_title("enlarged", loc="left", fontsize=7.0)
        _mark_hardness(panels[: 1 if faded else 2], result.system.cap, max(first, later), unit)
        legend_below(figure, curves, columns=_COLUMNS)
    return figure


def _draw_whole(
    axes: Axes,
    section: Section,
    hertz: HertzContact | None,
    unit: Unit,
    strokes: Sequence[Stroke],
    labels: Sequence[str],
) -> None:
    """Draw the first pressure whole in a narrow panel."""
    section.draw(axes, unit, strokes[:1], labels[:1])
    if hertz is not None:
        _draw_hertz(axes, hertz, section, unit)
    axes.xaxis.set_major_locator(MaxNLocator(2))
    axes.set_xlabel(f"{'xy'[section.axis]} ({section.unit.name})")
    axes.set_ylabel(f"Pressure ({unit.name})")
    axes.yaxis.set_major_locator(ticks(7))
    highest = max(float(np.max(section.curves[0][1])), hertz.peak_pressure if hertz else 0.0)
    axes.set_ylim(0.0, 1.05 * unit.factor * highest)
    axes.set_title(f"{labels[0]}, whole", loc="left", fontsize=7.0)


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


def _draw_field(axes: Axes, grid: Grid, shown: Frame, pressure: Array, unit: Unit) -> None:
    """Draw the field with the edge of the contact, and white outside of that."""
    touching = pressure > 0
    inside = _smooth(touching.astype(float))
    kept = (inside > 0.5) == touching
    # What is only a few cells small is shown cell by cell.
    smooth = bool(np.sum(~kept) < _ALTERED * np.sum(touching))
    image = draw_image(
        axes,
        grid,
        shown,
        unit.of(_continued(pressure) if smooth else pressure),
        f"Pressure ({unit.name})",
        cmap=pressure_colours(),
        vmin=0.0,
        vmax=unit.factor * float(np.max(pressure)) or 1.0,
        interpolation="bilinear" if smooth else "nearest",
    )
    edge = np.pad(inside if smooth else touching.astype(float), 1, mode="edge").T
    x, y = (_padded(position) for position in shown.positions(grid))
    if np.any(touching):
        (region,) = axes.contourf(x, y, edge, levels=[0.5, 2.0], alpha=0.0).get_paths()
        image.set_clip_path(region, transform=axes.transData)
    if not np.all(touching):
        axes.contour(x, y, edge, levels=[0.5], colors="black", linewidths=0.9)


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


def _levels(unit: Unit, low: float, high: float) -> Array:
    """Return a few round pressures between two, in the unit shown."""
    low, high = unit.factor * low, unit.factor * high
    levels = np.asarray(ticks(3).tick_values(low, high))
    return levels[(levels > low) & (levels < high)]


def _draw_levels(
    axes: Axes, grid: Grid, shown: Frame, pressure: Array, unit: Unit, levels: Array
) -> None:
    """Draw labelled lines of equal pressure, but for those in fragments or without room."""
    weight = _smooth((pressure > 0).astype(float), 2)
    # The jumps of single cells would make the lines ragged, and those at the rim into crumbs.
    field = np.ma.masked_where(weight < 0.99, unit.of(_smooth(pressure, 2)))
    bright = levels > 0.55 * unit.factor * float(np.max(pressure))
    looks = [{"colors": "black" if light else "white"} for light in bright]
    for line in draw_lines(axes, grid, shown, field, levels, looks):
        axes.clabel(line, fontsize=6.0, fmt="%g", inline_spacing=2)


def _draw_first_contact(axes: Axes, hertz: HertzContact, shown: Frame) -> Line2D:
    """Draw the ellipse, or the two lines, inside which Hertz's contact lies.

    Return an entry for the legend.
    """
    a = shown.units[0].factor * hertz.half_width_x
    b = shown.units[1].factor * hertz.half_width_y
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


def _draw_hertz(axes: Axes, hertz: HertzContact, section: Section, unit: Unit) -> Line2D:
    """Draw Hertz's pressure along an axis through the centre."""
    width = _hertz_width(hertz, section.axis)
    position = np.linspace(*section.window, 801)
    if width > 0:
        # The ends of the ellipse belong to the curve.
        position = np.sort(np.append(position, (-width, width)))
        pressure = hertz.peak_pressure * np.sqrt(np.maximum(1 - (position / width) ** 2, 0.0))
    else:
        pressure = np.full_like(position, hertz.peak_pressure)
    return HERTZ.draw(axes, section.unit.of(position), unit.of(pressure), "Hertz, 0 s", zorder=3)
