"""Pictures of worn surfaces in section, at every save."""

from __future__ import annotations

from matplotlib.figure import Figure

from tribo.core.errors import CaseError
from tribo.plotting.sections import Section, draw_profiles
from tribo.plotting.style import save_strokes
from tribo.plotting.units import time_labels
from tribo.plotting.window import number_of_saves, positions, removed, scar_mask, section_limits
from tribo.result.export import profile
from tribo.result.read import Result


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
    count = number_of_saves(result)
    grid, body = result.grid, result.body(name)
    x = positions(grid, axis)
    section = Section(
        axis,
        section_limits(scar_mask(removed(result, name)[-1]), grid, axis),
        [(x, profile(body.surface(i), axis)) for i in range(count)],
    )
    return draw_profiles([section], save_strokes(count), time_labels(result), name)


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
    return body_profiles(result, name, 1)
