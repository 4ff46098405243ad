"""Pictures of worn surfaces in section, at every save."""

from __future__ import annotations

from matplotlib.figure import Figure

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.plotting.pressure import AXIS_LABELS
from tribo.plotting.style import (
    house_style,
    legend_below,
    legend_height,
    new_figure,
    save_strokes,
)
from tribo.plotting.units import height_unit, length_unit, time_labels
from tribo.plotting.window import Limits, limits, number_of_saves, removed, scar_mask, spread
from tribo.results.export import profile
from tribo.results.read import Result

SHAPE = 0.62
"""Height of the axes of a profile over their width."""
_COLUMNS = 3


def body_profiles(result: Result, name: str, axis: int) -> Figure:
    """Draw a body's surface through the window's centre at every save.

    The height points out of the body, so that material goes downwards: the
    unworn profile lies on top. Plastic displacement is part of it; elastic
    deformation is not.

    Parameters
    ----------
    result : Result
        What to draw.
    name : str
        The body.
    axis : int
        0 along the sliding direction, 1 across it.

    Returns
    -------
    Figure
        The picture, which states how much it enlarges heights.

    Raises
    ------
    CaseError
        If there is no such body or no save.
    """
    if axis not in (0, 1):
        raise CaseError(f"a profile runs along axis 0 or across, axis 1; not {axis!r}")
    return _profiles(result, name, axis, AXIS_LABELS[axis])


def groove(result: Result, name: str) -> Figure:
    """Draw the section of the groove in a swept body at every save.

    Parameters
    ----------
    result : Result
        What to draw.
    name : str
        The body.

    Returns
    -------
    Figure
        The picture, which states how much it enlarges heights.

    Raises
    ------
    CaseError
        If there is no such body, it is not swept, or there is no save.
    """
    if not result.body(name).swept:
        raise CaseError(
            f"{name} is not swept in {result.name}, so that it has no groove; draw body_profiles"
        )
    return _profiles(result, name, 1, "Across the track, y")


def _profiles(result: Result, name: str, axis: int, position: str) -> Figure:
    count = number_of_saves(result)
    grid, body = result.grid, result.body(name)
    x = (grid.x, grid.y)[axis]
    window = limits(scar_mask(removed(result, name)[-1]), grid, axis)
    lines = [profile(body.surface(i), axis) for i in range(count)]
    low, high = spread([visible(line, x, window) for line in lines])
    length = length_unit(max(abs(window[0]), abs(window[1])))
    unit = height_unit(max(abs(low), abs(high)))
    with house_style():
        figure = new_figure(62.0 + legend_height(count, _COLUMNS))
        axes = figure.add_subplot()
        curves = [
            stroke.draw(axes, length.of(x), unit.of(line), label)
            for stroke, line, label in zip(
                save_strokes(count), lines, time_labels(result), strict=True
            )
        ]
        axes.set_xlim(length.factor * window[0], length.factor * window[1])
        axes.set_ylim(unit.factor * low, unit.factor * high)
        axes.set_box_aspect(SHAPE)
        axes.set_xlabel(f"{position} ({length.name})")
        axes.set_ylabel(f"Height ({unit.name})")
        axes.set_title(name, loc="left")
        axes.set_title(enlargement(window, (low, high), SHAPE), loc="right", fontsize=7.0)
        legend_below(figure, curves, columns=_COLUMNS)
    return figure


def visible(line: Array, x: Array, window: Limits) -> Array:
    """Return the part of a profile that lies inside the limits, or all if none does."""
    inside = (x >= window[0]) & (x <= window[1])
    return line[inside] if inside.any() else line


def enlargement(across: Limits, up: Limits, shape: float) -> str:
    """Say how much larger heights are drawn than widths.

    Parameters
    ----------
    across, up : tuple of float
        Limits of the axes in m.
    shape : float
        Height of the axes over their width, on paper.
    """
    factor = shape * (across[1] - across[0]) / (up[1] - up[0])
    return f"height × {float(f'{factor:.1e}'):.7g}"
