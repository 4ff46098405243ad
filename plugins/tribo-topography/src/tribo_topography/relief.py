"""Pictures of the relief of a rough body: before and after the test."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tribo import Result
from tribo.kernel_api import (
    Look,
    Picture,
    Scale,
    below_each_other,
    field_picture,
    height_unit,
    size,
    style,
    ticks,
    time_labels,
)

from tribo_topography.roughness import material_ratio
from tribo_topography.running_in import reliefs

MOST_CELLS = 99.0
"""Percentile of the heights at which the scale of colours ends, as in the kernel's pictures."""
BESIDE: Look = {"color": "#b05a00", "linewidth": 1.2, "linestyle": (0.0, (1.2, 1.2))}


def height_map(result: Result, name: str, save: int = -1) -> Figure:
    """Draw the heights of a body in its scar, unworn and at a save, form removed."""
    scar, unworn, _ = reliefs(result, result.body(name), save % len(result.times))
    known = np.isfinite(scar)
    low, high = np.percentile(unworn[np.isfinite(unworn)], (100.0 - MOST_CELLS, MOST_CELLS))
    unit = height_unit(max(abs(low), abs(high)))
    scale = Scale("Height", unit, size(unit), style.PRESSURES, low, high)
    moments = {"unworn": unworn, f"t = {time_labels(result.times)[save]}": scar}
    pictures = [
        field_picture(relief, known, result.grid, scale, f"{name}, {moment}", vary=(0, 1))
        for moment, relief in moments.items()
    ]
    return below_each_other(pictures).figure()


def material_ratio_curves(result: Result, name: str, save: int = -1) -> Figure:
    """Draw the material ratio (Abbott) curves of a body, form removed.

    The curves are for its scar at a save, the first surface there, and the surface beside.
    """
    worn = reliefs(result, result.body(name), save % len(result.times))
    labels = f"scar, {time_labels(result.times)[save]}", "unworn", "beside"
    looks = style.OVER, style.UNDER, BESIDE
    unit = height_unit(max(float(np.nanmax(np.abs(part))) for part in (worn.scar, worn.unworn)))

    def panel(axes: Axes) -> Sequence[Artist]:
        curves: list[Artist] = []
        for relief, label, look in zip(worn, labels, looks, strict=True):
            ratio, height = material_ratio(relief)
            if ratio.size:
                curves += axes.plot(100 * ratio, height / size(unit), label=label, **look)
        axes.set_xlim(0.0, 100.0)
        axes.set_xlabel("Material ratio (%)")
        axes.set_ylabel(f"Height ({unit})")
        axes.set_title(f"{name}, form removed", loc="left")
        axes.yaxis.set_major_locator(ticks(6))
        return curves

    return Picture([[panel]], 60.0).figure()
