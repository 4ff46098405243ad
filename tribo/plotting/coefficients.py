"""Pictures of local wear coefficients."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from tribo.core.arrays import Array
from tribo.plotting.style import house_style, new_figure


def coefficient_map(
    factor: Array, part: Array, spacing: tuple[float, float], title: str = ""
) -> Figure:
    """Draw the factor on a wear coefficient, and how much of the prior's uncertainty is left.

    Parameters
    ----------
    factor : ndarray, shape (rows, ny)
        The factor at each cell; with one row, along y only.
    part : ndarray, shape (rows, ny)
        Its standard deviation over the prior's: at 1 the data say nothing.
    spacing : tuple of float
        Edge lengths of a cell, in m.
    title : str, optional
        Of the picture.
    """
    half = [0.5e6 * n * h for n, h in zip(factor.shape, spacing, strict=True)]
    with house_style():
        figure = new_figure(62.0)
        figure.suptitle(title)
        for axes, values, label, range_ in zip(
            figure.subplots(1, 2),
            (factor, part),
            ("factor on k", "standard deviation over prior's"),
            ((None, None), (0.0, 1.0)),
            strict=True,
        ):
            if len(values) == 1:
                y = spacing[1] * 1e6 * (np.arange(values.size) - 0.5 * (values.size - 1))
                axes.plot(y, values[0], color="#202020")
                axes.set(xlabel="y (µm)", ylabel=label, ylim=(0, None))
                continue
            image = axes.imshow(
                values.T,
                origin="lower",
                extent=(-half[0], half[0], -half[1], half[1]),
                cmap="viridis",
                vmin=range_[0],
                vmax=range_[1],
            )
            axes.set(xlabel="x (µm)", ylabel="y (µm)")
            figure.colorbar(image, ax=axes, label=label, orientation="horizontal")
    return figure
