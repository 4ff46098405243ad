"""Pictures of a rough body before and after: heights in its scar, and material ratio.

Each raises CaseError if the result holds no such body.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from tribo.lab.roughness import material_ratio
from tribo.lab.running_in import reliefs
from tribo.lab.units import height_unit, size, time_labels
from tribo.plotting import style
from tribo.plotting.maps import Scale, field_picture
from tribo.plotting.picture import Picture, below_each_other
from tribo.plotting.sections import MOST_CELLS
from tribo.result.read import Result

BESIDE: style.Look = {"color": "#b05a00", "linewidth": 1.2, "linestyle": (0.0, (1.2, 1.2))}


def height_map(result: Result, name: str, saves: Sequence[int] = (-1,)) -> Picture:
    """Draw the heights of a body in its scar, unworn and at a save, form removed."""
    scar, unworn, _ = reliefs(result, result.body(name), saves[-1] % len(result.times))
    known = np.isfinite(scar)
    low, high = np.percentile(unworn[np.isfinite(unworn)], (100.0 - MOST_CELLS, MOST_CELLS))
    unit = height_unit(max(abs(low), abs(high)))
    scale = Scale("Height", unit, size(unit), style.PRESSURES, low, high)
    moments = {"unworn": unworn, f"t = {time_labels(result.times)[saves[-1]]}": scar}
    pictures = [
        field_picture(relief, known, result.grid, scale, f"{name}, {moment}", vary=(0, 1))
        for moment, relief in moments.items()
    ]
    return below_each_other(pictures)


def material_ratio_curves(result: Result, name: str, saves: Sequence[int] = (-1,)) -> Picture:
    """Draw the material ratio (Abbott) curves of a body, form removed.

    That of its scar at a save, of what was there at first, and of the surface beside.
    """
    worn = reliefs(result, result.body(name), saves[-1] % len(result.times))
    labels = f"scar, {time_labels(result.times)[saves[-1]]}", "unworn", "beside"
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
        axes.yaxis.set_major_locator(style.ticks(6))
        return curves

    return Picture([[panel]], 60.0)
