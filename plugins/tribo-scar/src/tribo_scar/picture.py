"""A measured scar seen from above."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch
from tribo.kernel_api import (
    Layout,
    Scale,
    digits_of,
    field_picture,
    height_unit,
    size,
    style,
)

from tribo_scar.measurement import MOST_DIGITS, MeasuredScar
from tribo_scar.smoothing import smoothed

MISSING = "#e0b080"
"""Colour of missing pixels, which no depth has."""


def measured_scar_map(found: MeasuredScar) -> Figure:
    """Draw the depth of a measured scar, outlined as what is piled up, and missing pixels.

    Examples
    --------
    >>> from tribo_scar import measured_scar, measured_scar_map
    >>> x, y = tribo.Grid("0.2 mm", 100).mesh
    >>> worn = np.maximum(1e-6 * (1 - (x**2 + y**2) / 40e-6**2), 0)
    >>> scar = measured_scar(tribo.Flat(), tribo.Heights(-worn, pitch=(2e-6, 2e-6)))
    >>> measured_scar_map(scar).axes[0].get_xlabel()
    'Along sliding, x (µm)'
    """
    unit, factor = height_unit(found.depth), size(height_unit(found.depth))
    known = np.isfinite(found.depths)
    most = float(np.max(smoothed(found.depths)[found.scar]))
    power = math.floor(math.log10(found.volume))
    part, sure = (each / 10**power for each in (found.volume, found.volume_uncertainty))
    decimals = min(digits_of(part - sure, part + sure), MOST_DIGITS) - 1
    title = rf"Volume ({part:.{decimals}f} ± {sure:.{decimals}f}) $\cdot\,10^{{{power + 9}}}$ mm³"

    def marks(axes: Axes, shown: Layout) -> list[Artist]:
        x, y = shown.positions()
        drawn: list[Artist] = []
        outlines = (found.scar, ":", "taken for the volume"), (found.piled, "--", "piled up")
        for area, dashes, words in outlines:
            if area.any():
                look: style.Look = {"linestyles": dashes, "colors": "black", "linewidths": 0.8}
                axes.contour(x, y, area.T.astype(float), [0.5], **look)
                drawn.append(Line2D([], [], label=words, ls=dashes, color="black", lw=0.8))
        drawn += _widths(axes, shown, found)
        if not known.all():
            axes.set_facecolor(MISSING)
            drawn.append(Patch(color=MISSING, label="missing"))
        return drawn

    scale = Scale("Depth", unit, factor, style.DEPTHS, most=most)
    grid = found.after.grid
    return field_picture(found.depths, known, grid, scale, title, more=marks, vary=(0, 1)).figure()


def _widths(axes: Axes, shown: Layout, found: MeasuredScar) -> list[Artist]:
    """Draw the widths that are printed around the middle of the scar; a track has two edges."""
    if found.along is None or found.across is None:
        return []
    deep = np.where(found.scar, np.nan_to_num(found.depths), 0.0)
    x, y = shown.positions()
    middle = np.average(x, weights=deep.sum(axis=1)), np.average(y, weights=deep.sum(axis=0))
    sizes = [
        w / size(unit) for w, unit in zip((found.along, found.across), shown.units, strict=True)
    ]
    words = " × ".join(
        f"{w:.3g} {u}" for w, u in zip(sizes, shown.units, strict=True) if w < math.inf
    )
    if not found.is_track:
        ring = Ellipse(middle, *sizes, fill=False, color="black", lw=0.8, label=words)
        return [axes.add_patch(ring)]
    axis = sizes.index(min(sizes))
    draw, half = (axes.axhline if axis else axes.axvline), 0.5 * sizes[axis]
    edges = [draw(middle[axis] + side * half, color="black", lw=0.8) for side in (-1, 1)]
    edges[0].set_label(f"{words} wide")
    return [edges[0]]
