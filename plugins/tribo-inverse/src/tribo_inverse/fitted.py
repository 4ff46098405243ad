"""A picture of computed over measured values of a calibration."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from tribo.kernel_api import SINGLE_COLUMN, house_style, legend_below, new_figure, ticks

from tribo_inverse.calibration.quantities import row_name

FIT = 4.0
"""Height of a measured value in the picture of a fit, in mm."""
NAME = 1.25
"""Width of a letter of its name, in mm."""


def fit_picture(data: pd.DataFrame) -> Figure:
    """Draw the computed over the measured values of a calibration, with standard deviations.

    Parameters
    ----------
    data : DataFrame
        A row for each measured value, as `data` of a calibration: ``body``,
        ``quantity``, ``measured``, ``sigma`` and ``computed``; ``test`` and
        ``time_s`` where it has them.

    Returns
    -------
    Figure
        The values, relative to the measured ones.

    Examples
    --------
    >>> import pandas as pd
    >>> from tribo_inverse import fit_picture
    >>> row = {"body": "ball", "quantity": "mass", "measured": 2e-9, "sigma": 1e-10}
    >>> fit_picture(pd.DataFrame([row | {"computed": 1.9e-9}])).axes[0].get_xlabel()
    'Relative to the measured value'
    """
    measured, computed = data["measured"].to_numpy(float), data["computed"].to_numpy(float)
    rows = np.arange(len(data))[::-1]
    names = list(map(row_name, data.itertuples()))
    with house_style():
        # Long names make the picture wider, not its axes narrower.
        room = NAME * max(map(len, names), default=0)
        height = 18.0 + FIT * max(len(data), 3)
        figure = new_figure(height, max(SINGLE_COLUMN, 45.0 + room))
        axes = figure.subplots()
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
        legend_below(figure, axes.get_legend_handles_labels()[0])
    return figure
