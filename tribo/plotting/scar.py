"""Scars seen from above, computed and measured."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from tribo_scar.measurement import MeasuredScar

from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.words import digits_of
from tribo.lab.heights import smoothed
from tribo.plotting import style
from tribo.plotting.maps import Map, new_maps
from tribo.plotting.sections import removed, scar_mask
from tribo.plotting.units import height_unit, size, time_labels
from tribo.result.read import Result

MISSING = "#e0b080"
"""Colour of missing pixels, which no depth has."""


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
    if result.body(name).swept and "track_depth" in result.dataset:
        gone = np.nan_to_num(result.track_depth.sel(body=name).isel(time=save).values)
        grid = Grid((gone.shape[0] * grid.spacing[0], grid.size[1]), gone.shape)
    deepest = float(np.max(gone))
    unit = height_unit(deepest)
    with style.house_style():
        figure, (shown,) = new_maps(scar_mask(gone), grid)
        _draw_depths(shown, gone, unit, deepest / size(unit) or 1.0)
        shown.axes.set_title(f"{name}, t = {time_labels(result.times)[save]}", loc="left")
    return figure


def measured_scar_map(found: MeasuredScar) -> Figure:
    """Draw the depth of a measured scar, outlined as what is piled up, and missing pixels."""
    unit = height_unit(found.depth)
    with style.house_style():
        figure, (shown,) = new_maps(np.isfinite(found.depths), found.after.grid)
        most = float(np.max(smoothed(found.depths)[found.scar])) / size(unit)
        _draw_depths(shown, found.depths, unit, most)
        x, y = shown.positions()
        marks: list[Artist] = []
        for area, dashes, words in ((found.scar, "-", "scar"), (found.piled, "--", "piled up")):
            if area.any():
                look: style.Look = {"linestyles": dashes, "colors": "black", "linewidths": 0.8}
                shown.axes.contour(x, y, area.T.astype(float), [0.5], **look)
                marks.append(Line2D([], [], label=words, ls=dashes, color="black", lw=0.8))
        if np.isnan(found.depths).any():
            shown.axes.set_facecolor(MISSING)
            marks.append(Patch(color=MISSING, label="missing"))
        style.legend_below(figure, marks)
        power = math.floor(math.log10(found.volume))
        part, sure = (each / 10**power for each in (found.volume, found.volume_uncertainty))
        decimals = digits_of(part - sure, part + sure) - 1
        shown.axes.set_title(
            rf"Volume ({part:.{decimals}f} ± {sure:.{decimals}f}) $\cdot\,10^{{{power + 9}}}$ mm³",
            loc="left",
        )
    return figure


def _draw_depths(shown: Map, depths: Array, unit: str, most: float) -> None:
    look = {"cmap": style.DEPTHS, "interpolation": "nearest", "vmin": 0.0, "vmax": most}
    shown.image(depths / size(unit), f"Depth ({unit})", **look)
