"""Scars seen from above."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.plotting import style
from tribo.plotting.maps import Map, new_maps
from tribo.plotting.sections import removed, scar_mask
from tribo.plotting.units import height_unit, size, time_labels
from tribo.result.read import Result


def scar_map(result: Result, name: str, save: int = -1) -> Figure:
    """Draw from above how much of a body is gone at a save: worn off and displaced.

    Of a body that passes through a resolved cycle it is the groove along the
    whole track, else what lies in the window. A long scar is drawn wider than
    it is, and the axis says how much.

    Raises
    ------
    CaseError
        If the result holds no such save, or no such body.
    """
    grid, gone = result.grid, removed(result, name)[save]
    if result.body(name).swept and result.has("track_depth"):
        gone = np.nan_to_num(result.field("track_depth", save, name))
        grid = Grid((gone.shape[0] * grid.spacing[0], grid.size[1]), gone.shape)
    deepest = float(np.max(gone))
    unit = height_unit(deepest)
    with style.house_style():
        figure, (shown,) = new_maps(scar_mask(gone), grid)
        draw_depths(shown, gone, unit, deepest / size(unit) or 1.0)
        shown.axes.set_title(f"{name}, t = {time_labels(result.times)[save]}", loc="left")
    return figure


def draw_depths(shown: Map, depths: Array, unit: str, most: float) -> None:
    """Draw depths, in m, in a unit, up to the depth `most` in it."""
    look = {"cmap": style.DEPTHS, "interpolation": "nearest", "vmin": 0.0, "vmax": most}
    shown.image(depths / size(unit), f"Depth ({unit})", **look)
