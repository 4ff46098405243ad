"""Pictures of a result that frets: loops, and a map of the slip."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from tribo_fretting.cycles import SavedCycle


def loops(cycles: list[SavedCycle], frequency: float) -> Figure:
    """Draw the tangential force over the displacement at up to five saves; frequency in Hz."""
    figure = Figure(figsize=(3.35, 2.6), layout="constrained")
    axes = figure.add_subplot(xlabel="Displacement (µm)", ylabel="Tangential force (N)")
    chosen = np.unique(np.linspace(0, len(cycles) - 1, min(5, len(cycles))).round().astype(int))
    for at, shade in zip(chosen, np.linspace(0.7, 0.0, len(chosen)), strict=True):
        moved, force = cycles[at].loop()
        number = frequency * float(cycles[at].result.times[at])
        axes.plot(1e6 * moved, force, color=str(shade), label=f"{number:.0f} cycles")
    axes.legend()
    return figure


def slip_map(cycle: SavedCycle) -> Figure:
    """Draw the slip of points from one end of the stroke to the other, and the stick zone."""
    figure = Figure(figsize=(3.35, 2.8), layout="constrained")
    axes = figure.add_subplot(xlabel="x (µm)", ylabel="y (µm)")
    grid, pressed = cycle.result.grid, cycle.pressure > 0
    x, y = (1e6 * axis for axis in (grid.x, grid.y))
    slip = np.where(pressed, 1e6 * cycle.slip, np.nan)
    image = axes.pcolormesh(x, y, slip.T, vmin=0.0, shading="nearest", rasterized=True)
    figure.colorbar(image, label="Slip of a half cycle (µm)")
    for cells, look in ((pressed, "0.4"), (cycle.stuck, "w")):
        if cells.any() and not cells.all():
            axes.contour(x, y, cells.T.astype(float), [0.5], colors=look, linewidths=1.0)
    rows, columns = x[pressed.any(axis=1)], y[pressed.any(axis=0)]
    aspect = "equal" if 1 / 3 < np.ptp(rows) / np.ptp(columns) < 3 else "auto"
    axes.set(xlim=1.1 * rows[[0, -1]], ylim=1.1 * columns[[0, -1]], aspect=aspect)
    return figure
