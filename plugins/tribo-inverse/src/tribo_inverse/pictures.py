"""A picture of a local wear coefficient."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from tribo import Array
from tribo.kernel_api import house_style, new_figure

from tribo_inverse.calibration.maps import FittedMap

DOUBLE = 140.0
"""Width of a picture with two panels, in mm."""


def coefficient_map(found: FittedMap, level: float, title: str = "") -> Figure:
    """Draw the factor on a wear coefficient, and its standard deviation relative to the prior's.

    The factor is left blank where the data do not narrow the prior. Of one row both are curves
    along y, the factor with its interval at a level as a band.
    """

    def known(values: Array) -> Array:
        return np.where(found.told, values, np.nan)

    panels: tuple[tuple[str, Array, tuple[float | None, float | None]], ...] = (
        ("factor on k, where known", known(found.factor), (None, None)),
        ("standard deviation / prior's", found.deviation / found.prior, (0.0, 1.0)),
    )
    half = [0.5e6 * n * h for n, h in zip(found.logs.shape, found.spacing, strict=True)]
    with house_style():
        figure = new_figure(75.0, DOUBLE)
        figure.suptitle(title)
        for axes, (label, values, (low, high)) in zip(figure.subplots(1, 2), panels, strict=True):
            if len(values) == 1:
                axes.plot(_places(found), values[0], color="#202020")
                axes.set(xlabel="y (µm)", ylabel=label, ylim=(low, high))
                continue
            image = axes.imshow(
                values.T,
                origin="lower",
                extent=(-half[0], half[0], -half[1], half[1]),
                cmap="viridis",
                vmin=low,
                vmax=high,
            )
            axes.set(xlabel="x (µm)", ylabel="y (µm)")
            figure.colorbar(image, ax=axes, label=label, orientation="horizontal")
    if len(found.logs) == 1:
        band = (known(each)[0] for each in found.interval(level))
        figure.axes[0].fill_between(_places(found), *band, color="#d0d0d0", lw=0)
        figure.axes[0].autoscale(axis="y")
    return figure


def _places(found: FittedMap) -> Array:
    """Return the positions of the cells of a row along y, in µm."""
    cells = np.arange(found.logs.size) - 0.5 * (found.logs.size - 1)
    return np.asarray(1e6 * found.spacing[1] * cells)
