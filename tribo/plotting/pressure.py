"""Pictures of the contact pressure: the full field, and sections over time.

Each raises CaseError if the result holds no such save.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from tribo.lab.against_hertz import HertzContact, first_hertz
from tribo.lab.units import fitting, size, time_labels
from tribo.plotting import style
from tribo.plotting.maps import Scale, field_picture
from tribo.plotting.picture import NothingToDraw, Picture
from tribo.plotting.sections import Section, section_row, through_centre, varying
from tribo.result.read import Result

HERTZ: style.Look = {"color": "#909090", "linewidth": 0.7, "zorder": 3}


def pressure_map(result: Result, save: int = -1) -> Picture:
    """Draw the pressure at a save from above, or its profile where it varies along one axis.

    A long contact is drawn wider.
    """
    pressure = result.field("pressure", save)
    title = f"t = {time_labels(result.times)[save]}"
    scale = Scale.of("", float(np.max(pressure)))
    return field_picture(pressure, pressure > 0, result.grid, scale, title)


def pressure_sections(
    result: Result, saves: Sequence[int] | None = None, axis: int | None = None
) -> Picture:
    """Draw the pressure along and across the sliding direction at every save.

    The sections go through the window's centre; along an axis where the pressure never varies
    there is none, unless `axis`, 0 or 1, asks for it. The first pressure, which may dwarf the later
    ones, has a row of its own.
    """
    saves = range(len(result.times)) if saves is None else saves
    grid, hertz, labels = result.grid, first_hertz(result), time_labels(result.times)
    fields = {save: result.field("pressure", save) for save in saves}
    touched = np.any([field > 0 for field in fields.values()], axis=0)
    axes = varying(list(fields.values()), touched) if axis is None else (axis,)
    unit = fitting("Pa", max(float(np.max(field)) for field in fields.values()))
    if not axes:
        value = f"{np.max(fields[saves[-1]]) / size(unit):.4g} {unit}"
        raise NothingToDraw(f"the pressure is uniform, {value} at {labels[saves[-1]]}")
    looks = dict(zip(saves, style.save_looks(len(saves)), strict=True))
    rows, scale = [], (f"Pressure ({unit})", size(unit))
    for group in filter(None, ([s for s in saves if s == 0], [s for s in saves if s != 0])):
        shown = hertz if 0 in group else None
        marked = np.any([fields[save] > 0 for save in group], axis=0)
        kept = [(grid, fields[save], marked) for save in group]
        sections = through_centre(kept, axes)
        highest = max(float(np.max(p)) for part in sections for _, p in part.curves)
        up = (0.0, 1.05 * highest or size(unit))
        own = [looks[save] for save in group], [labels[save] for save in group]
        beside = partial(_draw_limits, shown, unit, highest, result.system.cap)
        rows.append(section_row(sections, *own, scale, up, more=[beside]))
    return Picture(rows, 48.0, "y")


def _draw_limits(
    hertz: HertzContact | None,
    unit: str,
    highest: float,
    cap: float | None,
    section: Section,
    axes: Axes,
) -> Sequence[Artist]:
    """Draw Hertz's pressure, and the hardness where pressures up to the `highest` come near it."""
    drawn: list[Artist] = []
    if hertz is not None:
        x = np.linspace(*section.window, 801)
        values = hertz.pressure(section.axis, x)
        drawn += axes.plot(x / size(section.unit), values / size(unit), label="Hertz, 0 s", **HERTZ)
        axes.set_ylim(top=1.05 * max(highest, hertz.peak_pressure) / size(unit))
    if cap is not None and highest >= 0.9 * cap:
        look: Any = {"color": "black", "linewidth": 0.6, "linestyle": ":", "label": "hardness"}
        axes.set_ylim(top=1.1 * cap / size(unit))
        drawn.append(axes.axhline(cap / size(unit), **look))
    return drawn
