"""Picture of a measured scar."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from tribo.lab.heights import smoothed
from tribo.lab.measured_scar import MeasuredScar
from tribo.plotting import style
from tribo.plotting.maps import new_maps
from tribo.plotting.units import height_unit, size


def scar_map(found: MeasuredScar) -> Figure:
    """Draw the depth of a measured scar, missing pixels left white, and its outline."""
    unit = height_unit(found.depth)
    with style.house_style():
        figure, (shown,) = new_maps(np.isfinite(found.depths), found.after.grid)
        look = {"cmap": style.DEPTHS, "interpolation": "nearest", "vmin": 0.0}
        most = float(np.max(smoothed(found.depths)[found.scar])) / size(unit)
        shown.image(found.depths / size(unit), f"Depth ({unit})", vmax=most, **look)
        x, y = shown.positions()
        outline = found.scar.T.astype(float)
        shown.axes.contour(x, y, outline, [0.5], colors="black", linewidths=0.8)
        volume, sure = 1e9 * found.volume, 1e9 * found.volume_uncertainty
        shown.axes.set_title(f"{volume:.4g} ± {sure:.1g} mm³", loc="left")
    return figure
