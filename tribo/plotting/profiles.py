"""Pictures of worn surfaces: from above, in section, and both bodies together.

Each raises CaseError if the result holds no such body.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.lab.kept import kept_fields
from tribo.lab.scar import removed, scar_mask
from tribo.lab.units import height_unit, shown_in, size, time_labels
from tribo.plotting.maps import Scale, field_picture
from tribo.plotting.picture import NothingToDraw, Picture
from tribo.plotting.sections import Section, heights_row, through_centre, varying
from tribo.plotting.style import Look, save_looks
from tribo.result.layout import TRACK
from tribo.result.read import Result

WORN: Look = {"color": "black", "linewidth": 1.0}
UNWORN: tuple[Look, Look] = (
    {"color": "#202020", "linewidth": 1.0, "linestyle": (0.0, (1.2, 1.2))},
    {"color": "#404040", "linewidth": 0.8, "linestyle": (0.0, (5.0, 1.6))},
)
"""Of the upper and of the lower body."""
UPPER, LOWER = "#e4e4e4", "#b4b4b4"


def scar_map(result: Result, name: str, save: int = -1) -> Picture:
    """Draw from above the depth of a body at a save: worn off and displaced.

    For a body that passes through a resolved cycle it is the groove along the whole track. What
    varies along one axis only is drawn as its profile.
    """
    grid, gone = _gone(result, name, [save])
    scale = Scale.of(name, float(np.max(gone)))._replace(what="Depth")
    title = f"{name}, t = {time_labels(result.times)[save]}"
    return field_picture(gone[0], scar_mask(gone[0]), grid, scale, title)


def body_profiles(
    result: Result, name: str, saves: Sequence[int] | None = None, axis: int | None = None
) -> Picture:
    """Draw a body's surface through the window's centre at every save.

    It runs along axis 0, the sliding direction, or across it, along axis 1; without one, along
    those along which the body wears unevenly. For a body that passes through a resolved cycle it is
    the change of its height along the whole track.

    Heights point out of the body, so that the unworn profile lies on top. They have plastic
    displacement and no elastic deformation.
    """
    if axis not in (None, 0, 1):
        raise CaseError(f"a profile runs along axis 0 or across, axis 1; not {axis!r}")
    every = range(len(result.times)) if saves is None else saves
    grid, gone = _gone(result, name, every)
    scar = scar_mask(gone[-1])
    axes = varying(gone, scar) if axis is None else (axis,)
    if not axes:
        raise NothingToDraw(f"{name} is worn evenly, {_deep(gone[-1])}")
    body, what = result.body(name), "Height"
    heights = [body.surface(save) for save in every]
    if TRACK in dir(result) and body.swept:
        heights, what = [-depth for depth in gone], "Change of height"
    sections = through_centre([(grid, z, scar) for z in heights], axes)
    labels = time_labels(result.times)
    named = [labels[save] for save in every]
    row = heights_row(sections, save_looks(len(every)), named, name, what)
    return Picture([row], 60.0, "y")


def _gone(result: Result, name: str, saves: Sequence[int]) -> tuple[Grid, list[Array]]:
    """Return the depth of a body at saves, along the whole track where it is known."""
    grid = result.grid
    if not (result.body(name).swept and TRACK in dir(result)):
        return grid, list(removed(result, name)[list(saves)])
    gone = [np.nan_to_num(result.field(TRACK, save, name)) for save in saves]
    return Grid((len(gone[0]) * grid.spacing[0], grid.size[1]), gone[0].shape), gone


def worn_section(result: Result, save: int = -1, axis: int | None = None) -> Picture:
    """Draw both bodies in section at a save, along the axes along which one wears unevenly.

    They touch at their closest point, without load; a moving body lies below. The unworn surface of
    each worn body is drawn where its points were. The picture states how deep the scars are.
    """
    upper, lower = sorted(map(result.body, result.body_names), key=lambda body: body.swept)
    gone = [removed(result, body.name)[save] for body in (upper, lower)]
    depths = [float(np.max(depth)) for depth in gone]
    marked = np.zeros(result.grid.cells, dtype=bool)
    for body, depth in zip((upper, lower), gone, strict=True):
        if not body.swept:
            marked |= scar_mask(depth)
    if not marked.any():
        marked = result.field("pressure", save) > 0
    words = [_scar(body.name, depth) for body, depth in zip((upper, lower), gone, strict=True)]
    shown = varying(gone, marked) if axis is None else (axis,)
    if not shown:
        raise NothingToDraw(f"no body is worn unevenly: {', '.join(words)}")
    top, bottom = upper.surface(save), lower.surface(save)
    lift = float(np.max(top + bottom))
    surfaces, looks, labels = [lift - top, bottom], [WORN, WORN], ["worn", ""]
    unworn = lift - upper.height, lower.height
    for body, surface, depth, look in zip((upper, lower), unworn, depths, UNWORN, strict=True):
        if depth > 0:
            surfaces.append(surface)
            looks.append(look)
            labels.append(f"{body.name} unworn")
    fields = [(result.grid, surface, marked) for surface in surfaces]
    sections = through_centre(fields, shown)
    title = f"t = {time_labels(result.times)[save]}, unloaded"
    fill = partial(_fill, words)
    row = heights_row(sections, looks, labels, title, room=(0.2, 0.1), more=[fill])
    return Picture([row], 64.0, "y")


def _fill(words: Sequence[str], section: Section, axes: Axes) -> Sequence[Artist]:
    """Fill both bodies, and write their names and depths into them."""
    low, high = axes.get_ylim()
    places = (high, UPPER, 0.97, "top"), (low, LOWER, 0.04, "bottom")
    for line, (end, colour, at, side), text in zip(axes.lines, places, words, strict=False):
        x, z = line.get_data()
        axes.fill_between(x, z, end, color=colour, linewidth=0.0)
        axes.text(0.5, at, text, transform=axes.transAxes, ha="center", va=side)
    return ()


def _scar(name: str, gone: Array) -> str:
    return f"{name}: {_deep(gone)} deep" if np.any(gone > 0) else name


def _deep(gone: Array) -> str:
    deepest = float(np.max(gone))
    unit = height_unit(deepest)
    return f"{deepest / size(unit):.3g} {unit}"


def field_map(result: Result, name: str, save: int = -1) -> Picture:
    """Draw a field of the models from above at a save, or along the axis that it varies along."""
    kept = next(each for each in kept_fields(result) if each.key == name)
    values = kept.values[save]
    scale = Scale(kept.name.capitalize(), *shown_in(kept.unit, values), least=None)
    title = f"t = {time_labels(result.times)[save]}"
    return field_picture(values, result.field("pressure", save) > 0, result.grid, scale, title)
