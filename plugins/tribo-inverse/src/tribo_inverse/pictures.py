"""Pictures of local wear coefficients."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from tribo import Array
from tribo.kernel_api import house_style, new_figure

from tribo_inverse.calibration.maps import LocalMap

DOUBLE = 140.0
"""Width of a picture with two panels, in mm."""
SIGNIFICANT = 3.0
"""Residual, in standard deviations, that is outlined where its sign should be seen in grey too; and
the least range of a colour scale of residuals."""
DIFFERENCES = "PuOr"
"""Colours of differences: white is none, and both ends are dark."""
Range = tuple[float | None, float | None]


def coefficient_map(found: LocalMap, level: float, title: str = "") -> Figure:
    """Draw the factor on a wear coefficient, and its standard deviation relative to the prior's.

    The factor is left blank where the data do not narrow the prior. Of one row it is drawn along y,
    with its interval at a level as a band.
    """
    part, spacing = found.deviation / found.prior, found.spacing

    def known(values: Array) -> Array:
        return np.where(found.told, values, np.nan)

    panels: dict[str, tuple[Array, Range]] = {
        "factor on k, where known": (known(found.factor), (None, None)),
        "standard deviation / prior's": (part, (0.0, 1.0)),
    }
    figure = _drawn(panels, spacing, title, "viridis")
    if len(part) == 1:
        low, high = (known(each)[0] for each in found.interval(level))
        figure.axes[0].fill_between(_places(part, spacing), low, high, color="#d0d0d0", lw=0)
    return figure


def depth_fit(found: LocalMap, title: str = "") -> Figure:
    """Draw a measured depth, and the residual of the fit."""
    off = (found.computed - found.measured) / found.uncertainty
    largest = float(np.max(np.abs(off), initial=SIGNIFICANT, where=np.isfinite(off)))
    panels: dict[str, tuple[Array, Range]] = {
        "measured depth (µm)": (1e6 * found.measured, (None, None)),
        "fit − measured (deviations)": (off, (-largest, largest)),
    }
    return _drawn(panels, found.spacing, title, "Blues", DIFFERENCES)


def _places(values: Array, spacing: tuple[float, float]) -> Array:
    """Return the positions of the cells of a row along y, in µm."""
    cells = np.arange(values.size) - 0.5 * (values.size - 1)
    return np.asarray(1e6 * spacing[1] * cells)


def _drawn(
    panels: Mapping[str, tuple[Array, Range]],
    spacing: tuple[float, float],
    title: str,
    *colours: object,
) -> Figure:
    """Draw values side by side: curves along y of one row, else maps."""
    with house_style():
        figure = new_figure(75.0, DOUBLE)
        figure.suptitle(title)
        for i, (axes, (label, (values, (low, high)))) in enumerate(
            zip(figure.subplots(1, 2), panels.items(), strict=True)
        ):
            if len(values) == 1:
                axes.plot(_places(values, spacing), values[0], color="#202020")
                axes.set(xlabel="y (µm)", ylabel=label, ylim=(low, high))
                continue
            half = [0.5e6 * n * h for n, h in zip(values.shape, spacing, strict=True)]
            image = axes.imshow(
                values.T,
                origin="lower",
                extent=(-half[0], half[0], -half[1], half[1]),
                cmap=colours[min(i, len(colours) - 1)],
                vmin=low,
                vmax=high,
            )
            axes.set(xlabel="x (µm)", ylabel="y (µm)")
            figure.colorbar(image, ax=axes, label=label, orientation="horizontal")
    return figure
