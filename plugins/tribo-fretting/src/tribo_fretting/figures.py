"""Pictures of a result that frets: loops, and a map of the slip."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tribo.kernel_api import Layout, Scale, field_picture, shown_in

from tribo_fretting.cycles import SavedCycle


def loops(cycles: list[SavedCycle], frequency: float) -> Figure:
    """Draw the tangential force over the displacement at up to five saves; frequency in Hz."""
    figure = Figure(figsize=(3.35, 2.6), layout="constrained")
    axes = figure.add_subplot(xlabel="Displacement (µm)", ylabel="Tangential force (N)")
    chosen = np.unique(np.linspace(0, len(cycles) - 1, min(5, len(cycles))).round().astype(int))
    for at, shade in zip(chosen, np.linspace(0.7, 0.0, len(chosen)), strict=True):
        moved, force = cycles[at].loop()
        number = frequency * cycles[at].result.times[at]
        axes.plot(1e6 * moved, force, color=str(shade), label=f"{number:.0f} cycles")
    axes.legend()
    return figure


def slip_map(cycle: SavedCycle) -> Figure:
    """Draw the slip of points from one end of the stroke to the other, and the stick zone."""

    def edge(axes: Axes, shown: Layout) -> Sequence[Artist]:
        if cycle.stuck.any():
            axes.contour(*shown.positions(), cycle.stuck.T.astype(float), [0.5], colors="black")
        return ()

    scale = Scale("Slip of a half cycle", *shown_in("m", cycle.slip))
    pressed, grid = cycle.pressure > 0, cycle.result.grid
    return field_picture(cycle.slip, pressed, grid, scale, "", more=edge).figure()
