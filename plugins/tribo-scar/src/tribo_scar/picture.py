"""A measured scar seen from above."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from tribo.kernel_api import (
    digits_of,
    draw_depths,
    height_unit,
    new_maps,
    size,
    smoothed,
    style,
)

from tribo_scar.measurement import MeasuredScar

MISSING = "#e0b080"
"""Colour of missing pixels, which no depth has."""


def measured_scar_map(found: MeasuredScar) -> Figure:
    """Draw the depth of a measured scar, outlined as what is piled up, and missing pixels."""
    unit = height_unit(found.depth)
    with style.house_style():
        figure, (shown,) = new_maps(np.isfinite(found.depths), found.after.grid)
        most = float(np.max(smoothed(found.depths)[found.scar])) / size(unit)
        draw_depths(shown, found.depths, unit, most)
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
