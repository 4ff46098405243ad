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

from tribo.lab.against_hertz import HertzContact, first_hertz
from tribo.plotting import style
from tribo.plotting.maps import Map, new_maps
from tribo.plotting.sections import Curve, Limits, Section, limits, through_centre
from tribo.plotting.units import fitting, size, time_labels
from tribo.result.read import Result

HERTZ: style.Look = {"color": "#909090", "linewidth": 0.7, "zorder": 3}
_FADED = 2.0
"""Ratio of the first pressure to the later ones above which it has a panel of its own."""


def pressure_map(result: Result, save: int = -1) -> Figure:
    """Draw the pressure at a save from above.

    The scale goes from zero to the largest pressure. The solid line is the edge of the contact,
    the dashed one Hertz's first contact where the surfaces state their curvature. A long contact
    is drawn wider than it is, and the axis says how much.
    """
    pressure, hertz = result.field("pressure", save), _hertz(result)
    touching, highest = pressure > 0, float(np.max(pressure))
    unit = fitting("Pa", highest)
    look = {"cmap": style.PRESSURES, "vmin": 0.0, "vmax": highest / size(unit) or 1.0}
    with style.house_style():
        figure, (shown,) = new_maps(touching, result.grid, _reach(hertz))
        values = np.where(touching, pressure / size(unit), np.nan)
        shown.image(values, f"Pressure ({unit})", interpolation="nearest", **look)
        if touching.any() and not touching.all():
            edge = touching.T.astype(float)
            x, y = shown.positions()
            shown.axes.contour(x, y, edge, levels=[0.5], colors="black", linewidths=0.9)
        shown.axes.set_title(f"t = {time_labels(result.times)[save]}", loc="left")
        if hertz is not None:
            style.legend_below(figure, [_draw_first_contact(shown, hertz)])
    return figure


def pressure_sections(result: Result) -> Figure:
    """Draw the pressure along and across the sliding direction at every save.

    The sections go through the window's centre. Where the first
    pressure dwarfs the later ones, it is cut off at the top and drawn whole in a
    narrow panel beside them, along the axis where its contact fills less of the window.
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
        main[0].set_ylabel(f"Pressure ({unit})")
        main[1].tick_params(labelleft=False)
        if faded:
            windows = [limits(fields[0] > 0, grid, axis, reach[axis]) for axis in (0, 1)]
            axis = int(np.argmin(np.ptp(windows, axis=1) / grid.size))
            whole = replace(sections[axis], window=windows[axis])
            _draw_whole(panels[0], whole, unit, looks, labels, [0, *range(count, len(labels))])
            main[0].set_title("enlarged", loc="left", fontsize=7.0)
        if cap is not None and highest >= 0.9 * cap:
            look = {"color": "black", "linewidth": 0.6, "linestyle": ":", "label": "hardness"}
            for axes in panels[:1] if faded else panels:
                axes.set_ylim(0.0, 1.1 * cap / size(unit))
                marks = [axes.axhline(cap / size(unit), **look)]
        style.legend_below(figure, curves, 6, marks)
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
