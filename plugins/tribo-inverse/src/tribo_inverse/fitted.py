"""A picture of computed over measured values of a calibration."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tribo.kernel_api import (
    DIFFERENCES,
    SIGNIFICANT,
    SINGLE_COLUMN,
    house_style,
    legend_below,
    new_figure,
    ticks,
)

from tribo_inverse.calibration.quantities import row_name

FIT = 4.0
"""Height of a measured value in the picture of a fit, in mm."""
NAME, PROFILE, MAP = 1.25, 42.0, 62.0
"""Width of a letter of its name, and heights of a profile and of a map, in mm."""


def fit_picture(data: pd.DataFrame, points: pd.DataFrame | None = None) -> Figure:
    """Draw the computed over the measured values of a calibration, with standard deviations.

    Parameters
    ----------
    data : DataFrame
        A row for each measured value, as `brief` of a calibration: ``body``,
        ``quantity``, ``measured``, ``sigma`` and ``computed``; ``test``,
        ``time_s`` and ``position_m`` where it has them.
    points : DataFrame, optional
        A row for each point, as its `data`; its profiles and maps are drawn, each in a panel.

    Returns
    -------
    Figure
        The values in its first axes, a panel below for each profile and map.

    Examples
    --------
    >>> import pandas as pd
    >>> from tribo_inverse import fit_picture
    >>> row = {"body": "ball", "quantity": "mass", "measured": 2e-9, "sigma": 1e-10}
    >>> fit_picture(pd.DataFrame([row | {"computed": 1.9e-9}])).axes[0].get_xlabel()
    'Relative to the measured value'
    """
    fields = [] if points is None else _fields(points)
    measured, computed = data["measured"].to_numpy(float), data["computed"].to_numpy(float)
    rows = np.arange(len(data))[::-1]
    names = list(map(row_name, data.itertuples()))
    with house_style():
        # Long names make the picture wider, not its axes narrower.
        room = NAME * max(map(len, names), default=0)
        heights = [18.0 + FIT * max(len(data), 3), *(size for _, size, _ in fields)]
        figure = new_figure(sum(heights), max(SINGLE_COLUMN, 45.0 + room))
        axes, *panels = figure.subplots(len(heights), height_ratios=heights, squeeze=False)[:, 0]
        axes.axvline(1.0, color="black", linewidth=0.5)
        axes.errorbar(
            np.ones(len(data)),
            rows,
            xerr=data["sigma"] / np.abs(measured),
            label="measured, ± its standard deviation",
            fmt="none",
            ecolor="#56b4e9",
            elinewidth=2.4,
        )
        axes.plot(computed / measured, rows, "s", color="#202020", markersize=3.0, label="fitted")
        axes.set_yticks(rows, names)
        axes.set_ylim(-0.7, len(data) - 0.3)
        axes.set_xlabel("Relative to the measured value")
        axes.xaxis.set_major_locator(ticks(5))
        for panel, (draw, _, rows) in zip(panels, fields, strict=True):
            draw(panel, rows)
        legend_below(figure, axes.get_legend_handles_labels()[0], columns=2)
    return figure


def _fields(points: pd.DataFrame) -> list[tuple[Callable[..., None], float, pd.DataFrame]]:
    """Return the drawing function, height in mm, and rows of each profile and map."""
    found: list[tuple[Callable[..., None], float, pd.DataFrame]] = []
    places = points.assign(position_m=points["position_m"].fillna(points.get("y_m", np.nan)))
    for _, rows in places[places["position_m"].notna()].groupby("place"):
        if rows.get("x_m", pd.Series(np.nan)).nunique() > 1:
            found.append((_residuals, MAP, rows))
        else:
            found.append((_profile, PROFILE, rows.sort_values("position_m")))
    return found


def _residuals(axes: Axes, rows: pd.DataFrame) -> None:
    """Draw the residuals of a map over the surface."""
    most = max(SIGNIFICANT, float(np.max(np.abs(rows["residual"]))))
    look: dict[str, Any] = {"cmap": DIFFERENCES, "vmin": -most, "vmax": most}
    look |= {"s": 9.0, "edgecolors": "#808080", "linewidths": 0.2}
    # In grey both ends are dark.
    for mark, part in (("s", rows[rows["residual"] > 0]), ("o", rows[rows["residual"] <= 0])):
        places = 1e3 * part["x_m"], 1e3 * part["y_m"]
        marks = axes.scatter(*places, c=part["residual"], marker=mark, **look)
    axes.set_aspect("equal")
    axes.set(xlabel="x (mm)", ylabel="y (mm)", title=row_name(rows.iloc[0].drop("position_m")))
    axes.figure.colorbar(marks, ax=axes, label="fit − measured (deviations),\nsquares above 0")


def _profile(axes: Axes, rows: pd.DataFrame) -> None:
    """Draw the measured and the computed profile over the position."""
    place, depths = 1e3 * rows["position_m"], 1e6 * rows[["measured", "sigma", "computed"]]
    axes.errorbar(
        place, depths["measured"], yerr=depths["sigma"], fmt="o", color="#56b4e9", markersize=2.0
    )
    axes.plot(place, depths["computed"], color="#202020", linewidth=0.8)
    axes.invert_yaxis()
    axes.set_title(row_name(rows.iloc[0].drop("position_m")))
    axes.set_xlabel("Position (mm)")
    axes.set_ylabel("Depth (µm)")
