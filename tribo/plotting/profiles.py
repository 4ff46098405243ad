"""Pictures of worn surfaces in section: of one body at every save, and of both together.

Each raises CaseError if the result holds no such body.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.plotting.sections import (
    draw_profiles,
    layer_ends,
    removed,
    scar_mask,
    through_centre,
)
from tribo.plotting.style import Look, house_style, save_looks
from tribo.plotting.units import height_unit, size, time_labels
from tribo.result.read import Result

WORN: Look = {"color": "black", "linewidth": 1.0}
UNWORN: tuple[Look, Look] = (
    {"color": "#202020", "linewidth": 1.0, "linestyle": (0.0, (1.2, 1.2))},
    {"color": "#404040", "linewidth": 0.8, "linestyle": (0.0, (5.0, 1.6))},
)
"""Of the upper and of the lower body."""
LAYER: Look = {"color": "black", "linewidth": 0.6, "linestyle": (0.0, (6.0, 1.5, 1.0, 1.5))}
UPPER, LOWER = "#e4e4e4", "#b4b4b4"


def body_profiles(result: Result, name: str, axis: int | None = None) -> Figure:
    """Draw a body's surface through the window's centre at every save.

    It runs along axis 0, the sliding direction, or across it, along axis 1; without one, both are
    drawn side by side, on one scale of heights, and of a swept body the section of its groove.

    The height points out of the body, so that material goes downwards: the
    unworn profile lies on top. Plastic displacement is part of it; elastic
    deformation is not. The picture states how much it enlarges heights.
    """
    if axis not in (None, 0, 1):
        raise CaseError(f"a profile runs along axis 0 or across, axis 1; not {axis!r}")
    count = len(result.times)
    body = result.body(name)
    scar = scar_mask(removed(result, name)[-1])
    fields = [(result.grid, body.surface(i), scar) for i in range(count)]
    axes = ((1,) if body.swept else (0, 1)) if axis is None else (axis,)
    sections = through_centre(fields, axes)
    return draw_profiles(sections, save_looks(count), time_labels(result.times), name)


def along_track(result: Result, name: str) -> Figure:
    """Draw the groove along the whole track of a body that passes through a resolved cycle.

    It is by how much its height has changed: what it was at first is left out.
    """
    if not result.has("track_depth"):
        raise CaseError(f"the cycle is not resolved in {result.name}; draw its profiles instead")
    count = len(result.times)
    depths = [np.nan_to_num(result.field("track_depth", save, name)) for save in range(count)]
    rows, columns = depths[0].shape
    (dx, _), (_, breadth) = result.grid.spacing, result.grid.size
    grid = Grid((rows * dx, breadth), (rows, columns))
    scar = scar_mask(depths[-1])
    sections = through_centre([(grid, -depth, scar) for depth in depths], (0,))
    labels = time_labels(result.times)
    return draw_profiles(sections, save_looks(count), labels, name, what="Change of height")


def worn_section(result: Result) -> Figure:
    """Draw both bodies in section at the last save, along and across sliding.

    They are set down on each other without load, so that they touch at their
    closest point and the scars are seen to conform. A swept body lies below.
    The unworn surface of each worn body is drawn where its points were: that
    of the upper one, dotted, runs inside the lower body. A thin line marks where a layer ends
    that has been worn through or by half at least. The picture states how much it enlarges heights
    and how deep the scars are.
    """
    last = len(result.times) - 1
    upper, lower = sorted(map(result.body, result.body_names), key=lambda body: body.swept)
    gone = [removed(result, body.name)[last] for body in (upper, lower)]
    depths = [float(np.max(depth)) for depth in gone]
    marked = np.zeros(result.grid.cells, dtype=bool)
    for body, depth in zip((upper, lower), gone, strict=True):
        if not body.swept:
            marked |= scar_mask(depth)
    if not marked.any():
        marked = result.field("pressure", last) > 0
    top, bottom = upper.surface(last), lower.surface(last)
    lift = float(np.max(top + bottom))
    surfaces, looks, labels = [lift - top, bottom], [WORN, WORN], ["worn", ""]
    unworn = lift - upper.height, lower.height
    for body, surface, depth, look in zip((upper, lower), unworn, depths, UNWORN, strict=True):
        if depth > 0:
            surfaces.append(surface)
            looks.append(look)
            labels.append(f"{body.name} unworn")
        # Into the body: upwards in the upper one.
        inwards = 1.0 if body is upper else -1.0
        for label, end in layer_ends(result, body.name, depth).items():
            surfaces.append(surface + inwards * end)
            looks.append(LAYER)
            labels.append(label)
    fields = [(result.grid, surface, marked) for surface in surfaces]
    figure = draw_profiles(
        through_centre(fields),
        looks,
        labels,
        f"t = {time_labels(result.times)[last]}, unloaded",
        shape=0.8,
        room=(0.27, 0.18),
    )
    along, across = figure.axes
    with house_style():
        for axes in (along, across):
            low, high = axes.get_ylim()
            for line, end, colour in zip(axes.lines, (high, low), (UPPER, LOWER), strict=False):
                x, z = line.get_data()
                axes.fill_between(x, z, end, color=colour, linewidth=0.0)
        places = (0.97, "top"), (0.04, "bottom")
        for body, depth, (at, side) in zip((upper, lower), depths, places, strict=True):
            look = {"ha": "center", "va": side}
            along.text(0.5, at, body.name, transform=along.transAxes, **look)
            across.text(0.5, at, _scar(body.name, depth), transform=across.transAxes, **look)
    return figure


def _scar(name: str, depth: float) -> str:
    """Return a body's name and how deep its scar is."""
    if depth <= 0:
        return name
    unit = height_unit(depth)
    return f"{name}: {depth / size(unit):.3g} {unit} deep"
