"""Pictures of the contact pressure: the full field, and sections over time.

Each raises CaseError if the result holds no such save.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator
from scipy.ndimage import gaussian_filter

from tribo.core.arrays import Array, Mask
from tribo.lab.against_hertz import HertzContact, first_hertz
from tribo.plotting import style
from tribo.plotting.maps import Map, new_maps
from tribo.plotting.sections import Curve, Limits, Section, limits, through_centre
from tribo.plotting.units import fitting, size, time_labels
from tribo.result.read import Result

HERTZ: style.Look = {"color": "#909090", "linewidth": 0.7, "zorder": 3}
_EVEN = 0.1
"""Differences, in parts of the largest pressure, below which the map has no lines."""
_ALTERED = 0.1
"""Largest share of the cells in contact that a smooth edge may put on the wrong side."""
_COLUMNS = 6
_FADED = 2.0
"""Ratio of the first pressure to the later ones above which it has a panel of its own."""
_BEYOND = 0.06
"""Shown beyond the end of a body, in parts of the window."""


def pressure_map(result: Result, save: int = -1) -> Figure:
    """Draw the pressure at a save from above.

    The scale goes from zero to the largest pressure. Thin lines are those of
    equal pressure; where nine tenths of the contact bear the same within a
    tenth there are none, and the title gives the mean pressure and how even it
    is. The thick line is the edge of the contact, drawn smoothly through the
    steps of the cells, and the dashed one Hertz's first contact where the
    surfaces state their curvature. A rough contact is shown cell by cell,
    without lines. A long one is drawn wider than it is, and the axis says how
    much.
    """
    pressure, hertz = result.field("pressure", save), _hertz(result)
    highest = float(np.max(pressure))
    unit = fitting("Pa", highest)
    values = pressure / size(unit)
    title = f"t = {time_labels(result.times)[save]}"
    with style.house_style():
        figure, (shown,) = new_maps(pressure > 0, result.grid, _reach(hertz))
        smooth = _draw_field(shown, values, unit)
        bearing = values[values > 0]
        low, high = np.percentile(bearing, (5.0, 95.0)) if bearing.size else (0.0, 0.0)
        unevenness = float(high - low) / (float(np.max(values)) or 1.0)
        if unevenness > _EVEN and smooth:
            _draw_levels(shown, values, low, high)
        elif unevenness <= _EVEN and bearing.size:
            percent = max(100 * unevenness, 1.0)
            title += f"\n{np.mean(bearing):.3g} {unit}, even within {percent:.0f} %"
        shown.axes.set_title(title, loc="left")
        if hertz is not None:
            style.legend_below(figure, [_draw_first_contact(shown, hertz)])
    return figure


def pressure_sections(result: Result) -> Figure:
    """Draw the pressure along and across the sliding direction at every save.

    The sections go through the window's centre. Where the first
    pressure dwarfs the later ones, it is cut off at the top and drawn whole in a
    narrow panel beside them, along the axis on which its contact is shorter. A hatched
    strip begins where a body in contact ends, at which the pressure may peak.
    """
    count = len(result.times)
    grid, hertz, cap = result.grid, _hertz(result), result.system.cap
    reach = _reach(hertz)
    fields = [result.field("pressure", i) for i in range(count)]
    touched = np.asarray(np.any([field > 0 for field in fields], axis=0))
    shown = [(grid, field, touched) for field in fields]
    sections = through_centre(shown, reach=reach)
    peaks = [max(np.max(section.curves[i][1]) for section in sections) for i in range(count)]
    first, later = float(peaks[0]), float(max(peaks[1:], default=0.0))
    highest = max(first, later)
    faded = first > _FADED * later > 0
    looks, labels = style.save_looks(count), time_labels(result.times)
    if hertz is not None:
        sections = [
            replace(part, curves=[*part.curves, _hertz_curve(hertz, part.axis, part.window)])
            for part in sections
        ]
        looks, labels = [*looks, HERTZ], [*labels, "Hertz, 0 s"]
    unit = fitting("Pa", highest)
    up = (0.0, 1.05 * (later if faded else highest) or size(unit))
    with style.house_style():
        figure = style.new_figure(52.0, style.WIDE)
        panels = figure.subplots(1, 3 if faded else 2, width_ratios=(1, 2, 2) if faded else (1, 1))
        main = panels[-2:]
        marks: list[Artist] = []
        for axes, section in zip(main, sections, strict=True):
            curves = section.draw(axes, unit, looks, labels, up)
            if _ends(result, touched, section.axis):
                marks = [_mark_ends(axes, 0.5 * grid.size[section.axis] / size(section.unit))]
        main[0].set_ylabel(f"Pressure ({unit})")
        main[1].tick_params(labelleft=False)
        if faded:
            windows = [limits(fields[0] > 0, grid, axis, reach[axis]) for axis in (0, 1)]
            # Across a line there is no profile to show.
            parts = np.ptp(windows, axis=1) / grid.size
            axis = int(np.argmin(np.where(parts < 1.0, np.ptp(windows, axis=1), np.inf)))
            whole = replace(sections[axis], window=windows[axis])
            _draw_whole(panels[0], whole, unit, looks, labels, [0, *range(count, len(labels))])
            main[0].set_title("enlarged", loc="left", fontsize=7.0)
        if cap is not None and highest >= 0.9 * cap:
            whole_panels = panels[:1] if faded else panels
            lines = [_mark_hardness(axes, cap / size(unit)) for axes in whole_panels]
            marks.append(lines[0])
        # A mark's name is longer than that of a save.
        style.legend_below(figure, curves, 4 if marks else _COLUMNS, marks)
    return figure


def _draw_whole(
    axes: Axes,
    section: Section,
    unit: str,
    looks: Sequence[style.Look],
    labels: Sequence[str],
    drawn: Sequence[int],
) -> None:
    """Draw the first pressure from top to bottom: of a section, the curves in `drawn`."""
    whole = replace(section, curves=[section.curves[i] for i in drawn])
    up = (0.0, 1.05 * max(float(np.max(values)) for _, values in whole.curves))
    whole.draw(axes, unit, [looks[i] for i in drawn], [labels[i] for i in drawn], up)
    axes.xaxis.set_major_locator(MaxNLocator(2))
    axes.set_xlabel(f"{'xy'[whole.axis]} ({whole.unit})")
    axes.set_ylabel(f"Pressure ({unit})")
    axes.set_title(f"{labels[0]}, whole", loc="left", fontsize=7.0)


def _ends(result: Result, touched: Mask, axis: int) -> bool:
    """Whether a body in contact ends at the window's edges along an axis."""
    edges = np.take(touched, (0, -1), axis=axis)
    return bool(result.case.get("grid", {}).get("ends_at_window", False) and np.any(edges))


def _mark_ends(axes: Axes, edge: float) -> Artist:
    """Hatch what lies beyond the end of a body, and return an entry for the legend."""
    outside = edge * (1 + 2 * _BEYOND)
    look: dict[str, Any] = {"facecolor": "#e4e4e4", "edgecolor": "#909090", "hatch": "////"}
    axes.set_xlim(-outside, outside)
    axes.axvspan(-outside, -edge, **look)
    return axes.axvspan(edge, outside, label="beyond the body's end", **look)


def _mark_hardness(axes: Axes, cap: float) -> Artist:
    """Draw the largest pressure that the softer body bears, and return an entry for the legend."""
    axes.set_ylim(0.0, 1.1 * cap)
    return axes.axhline(cap, color="black", linewidth=0.6, linestyle=":", label="hardness")


def _draw_field(shown: Map, pressure: Array, unit: str) -> bool:
    """Draw the field with the edge of the contact, and return whether that is smooth."""
    touching = pressure > 0
    inside = _smooth(touching, 3)
    # A contact of a few cells is shown cell by cell.
    smooth = bool(np.sum((inside > 0.5) != touching) < _ALTERED * np.sum(touching))
    field, edge = pressure, touching.astype(float)
    if smooth:
        # Around the contact, what the nearest of its cells bear.
        field = np.where(touching, pressure, _smooth(pressure, 3) / np.maximum(inside, 1e-9))
        edge = inside
    image = shown.image(
        field,
        f"Pressure ({unit})",
        cmap=style.PRESSURES,
        vmin=0.0,
        vmax=float(np.max(pressure)) or 1.0,
        interpolation="bilinear" if smooth else "nearest",
    )
    edge = np.pad(edge, 1, mode="edge").T
    x, y = (np.pad(part, 1, "reflect", reflect_type="odd") for part in shown.positions())
    if np.any(touching):
        (region,) = shown.axes.contourf(x, y, edge, levels=[0.5, 2.0], alpha=0.0).get_paths()
        image.set_clip_path(region, transform=shown.axes.transData)
    if not np.all(touching):
        shown.axes.contour(x, y, edge, levels=[0.5], colors="black", linewidths=0.9)
    return smooth


def _smooth(field: Array | Mask, passes: int) -> Array:
    """Return a field averaged with its neighbours, those beyond the window being alike."""
    # As a pass with the weights 1/4, 1/2 and 1/4 along each axis.
    width = np.sqrt(0.5 * passes)
    return np.asarray(
        gaussian_filter(np.asarray(field, float), width, mode="nearest", radius=passes)
    )


def _draw_levels(shown: Map, pressure: Array, low: float, high: float) -> None:
    """Draw a few labelled lines of round pressures between two, in the unit shown."""
    levels = np.asarray(style.ticks(3).tick_values(low, high))
    levels = levels[(levels > low) & (levels < high)]
    colours = ["black" if each > 0.55 * np.max(pressure) else "white" for each in levels]
    # The jumps of single cells would make the lines ragged.
    field = _smooth(pressure, 2).T
    lines = shown.axes.contour(*shown.positions(), field, levels, colors=colours, linewidths=0.5)
    shown.axes.clabel(lines, fontsize=6.0, fmt="%g", inline_spacing=2)


def _draw_first_contact(shown: Map, hertz: HertzContact) -> Line2D:
    """Draw the ellipse, or the two lines, inside which Hertz's contact lies."""
    a, b = hertz.half_width_x / size(shown.units[0]), hertz.half_width_y / size(shown.units[1])
    look: dict[str, Any] = {
        "color": "black",
        "linewidth": 0.8,
        "linestyle": (0.0, (4.0, 2.5)),
        "path_effects": [withStroke(linewidth=1.8, foreground="white")],
        "label": "Hertz, 0 s",
    }
    if not hertz.is_line:
        angle = np.linspace(0.0, 2 * np.pi, 361)
        (ellipse,) = shown.axes.plot(a * np.cos(angle), b * np.sin(angle), **look)
        return ellipse
    draw = shown.axes.axhline if np.isinf(a) else shown.axes.axvline
    lines = [draw(end, **look) for end in (-min(a, b), min(a, b))]
    return lines[0]


def _hertz(result: Result) -> HertzContact | None:
    hertz = first_hertz(result)
    return None if isinstance(hertz, str) else hertz


def _reach(hertz: HertzContact | None) -> list[float]:
    """Return Hertz's half-widths along x and y in m; 0 where it has none."""
    widths = (hertz.half_width_x, hertz.half_width_y) if hertz is not None else (0.0, 0.0)
    return [width if np.isfinite(width) else 0.0 for width in widths]


def _hertz_curve(hertz: HertzContact, axis: int, window: Limits) -> Curve:
    """Return Hertz's pressure along an axis through the centre."""
    width = _reach(hertz)[axis]
    position = np.linspace(*window, 801)
    if width == 0:
        return position, np.full_like(position, hertz.peak_pressure)
    # The ends of the ellipse belong to the curve.
    position = np.sort(np.append(position, (-width, width)))
    inside = np.maximum(1 - (position / width) ** 2, 0.0)
    return position, hertz.peak_pressure * np.sqrt(inside)
