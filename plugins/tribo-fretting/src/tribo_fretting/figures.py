"""Loops and the slip of a result, and the running conditions of a sweep, in pictures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from tribo import Array, Result
from tribo.kernel_api import Layout, Scale, field_picture, shown_in

from tribo_fretting.motion import Fretting

POINTS = 16
"""Of the first loading, from which a loop is drawn."""


def loop(result: Result, save: int) -> tuple[Array, Array]:
    """Return the displacement of the rig (m) and the tangential force (N) along a cycle at a save.

    From the first loading, by Masing's rule: the branches are twice as large. The motion of the
    result must be `fretting.motion`.
    """
    case, grid, motion = result.case, result.grid, result.case.kinematics
    assert isinstance(motion, Fretting)
    field, body = "friction_coefficient", result.body_names[0]
    mu = case.friction.coefficient if case.friction else result.field(field, save, body)
    limit = mu * result.field("pressure", save)
    materials = {name: body.material for name, body in case.bodies.items()}
    amplitude = motion.amplitude_at(float(result.times[save]))
    first = np.zeros((POINTS + 1, 2))
    for point in range(1, POINTS + 1):
        drag = motion.first_loading(grid, materials, limit, amplitude * point / POINTS)
        first[point] = drag.displacement, np.sum(drag.traction[0]) * grid.cell_area
    back = first[-1] - 2 * first
    moved, force = np.concatenate([back, -back]).T
    return moved, force


def loops(result: Result, frequency: float) -> Figure:
    """Draw the tangential force over the displacement at up to five saves; frequency in Hz."""
    figure = Figure(figsize=(3.35, 2.6), layout="constrained")
    axes = figure.add_subplot(xlabel="Displacement (µm)", ylabel="Tangential force (N)")
    chosen = np.unique(np.linspace(0, len(result.times) - 1, 5).round().astype(int))
    for save, shade in zip(chosen, np.linspace(0.7, 0.0, len(chosen)), strict=True):
        moved, force = loop(result, save)
        number = frequency * result.times[save]
        axes.plot(1e6 * moved, force, color=str(shade), label=f"{number:.0f} cycles")
    axes.legend()
    axes.locator_params(axis="x", nbins=5)
    return figure


def slip_map(result: Result) -> Figure:
    """Draw the slip of points in the last cycle, and the edge of the stick zone."""
    slip, pressed = result.field("slip", -1, result.body_names[0]), result.field("pressure", -1) > 0
    stuck = pressed & (slip == 0)

    def edge(axes: Axes, shown: Layout) -> Sequence[Artist]:
        if stuck.any():
            axes.contour(*shown.positions(), stuck.T.astype(float), [0.5], colors="black")
        return ()

    scale = Scale("Slip of a cycle", *shown_in("m", slip))
    return field_picture(slip, pressed, result.grid, scale, "", more=edge).figure()


def running_conditions(runs: pd.DataFrame) -> Figure:
    """Draw the stick part over load and amplitude, from the table of a sweep over both."""
    figure = Figure(figsize=(3.35, 2.6), layout="constrained")
    axes = figure.add_subplot(xlabel="Load (N)", ylabel="Amplitude (µm)")
    load, amplitude = runs["load.normal_N"], 1e6 * runs["kinematics.amplitude_m"]
    dots = axes.scatter(load, amplitude, c=runs["stick_part"], vmin=0, vmax=1, zorder=2)
    figure.colorbar(dots, label="Part that sticks (0: gross slip)")
    return figure
