"""Pictures of a rough body before and after: heights in its scar, and material ratio.

Each raises CaseError if the result holds no such body.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from tribo.lab.roughness import material_ratio
from tribo.lab.running_in import reliefs
from tribo.plotting import style
from tribo.plotting.maps import new_maps
from tribo.plotting.units import height_unit, size, time_labels
from tribo.result.read import Result

BESIDE: style.Look = {"color": "#b05a00", "linewidth": 1.2, "linestyle": (0.0, (1.2, 1.2))}


def height_map(result: Result, name: str) -> Figure:
    """Draw the heights of a body in its scar, unworn and at the last save, form removed."""
    last = len(result.times) - 1
    scar, unworn, _ = reliefs(result, result.body(name), last)
    low, high = np.nanmin([scar, unworn]), np.nanmax([scar, unworn])
    unit = height_unit(max(abs(low), abs(high)))
    moments = "unworn", f"t = {time_labels(result.times)[last]}"
    with style.house_style():
        figure, maps = new_maps(np.isfinite(scar), result.grid, count=2)
        for shown, relief, moment in zip(maps, (unworn, scar), moments, strict=True):
            limits = {"vmin": low / size(unit), "vmax": high / size(unit)}
            look = {"cmap": style.PRESSURES, "interpolation": "nearest"}
            shown.image(relief / size(unit), f"Height ({unit})", **limits, **look)
            shown.axes.set_title(f"{name}, {moment}", loc="left")
    return figure


def material_ratio_curves(result: Result, name: str) -> Figure:
    """Draw the material ratio (Abbott) curves of a body, form removed.

    That of its scar at the last save, of what was there at first, and of the surface beside.
    """
    last = len(result.times) - 1
    worn = reliefs(result, result.body(name), last)
    labels = f"scar, {time_labels(result.times)[last]}", "unworn", "beside"
    looks = style.OVER, style.UNDER, BESIDE
    unit = height_unit(max(float(np.nanmax(np.abs(part))) for part in (worn.scar, worn.unworn)))
    with style.house_style():
        figure = style.new_figure(60.0)
        axes = figure.subplots()
        curves = []
        for relief, label, look in zip(worn, labels, looks, strict=True):
            ratio, height = material_ratio(relief)
            if ratio.size:
                curves += axes.plot(100 * ratio, height / size(unit), label=label, **look)
        axes.set_xlim(0.0, 100.0)
        axes.set_xlabel("Material ratio (%)")
        axes.set_ylabel(f"Height ({unit})")
        axes.set_title(f"{name}, form removed", loc="left")
        axes.yaxis.set_major_locator(style.ticks(6))
        style.legend_below(figure, curves)
    return figure
