"""Pictures of what changes with time: wear, pressure and the size of the contact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

from tribo.core.arrays import Array
from tribo.plotting.style import (
    BODY_STROKES,
    OVER,
    Stroke,
    house_style,
    legend_below,
    new_figure,
    ticks,
)
from tribo.plotting.units import MG, MM3, height_unit, length_unit, pressure_unit, time_unit
from tribo.plotting.window import number_of_saves
from tribo.result.read import Result

ALONG = Stroke("#56b4e9", width=2.4)
LARGEST = Stroke("#e69f00", width=2.4)
CENTRE = ACROSS = OVER
_DECADE = 10.0
"""Values that span more than this factor are drawn on a logarithmic scale."""


def wear_history(result: Result) -> Figure:
    """Draw the volume and the mass that each body has lost against time.

    Markers are the saves; a line joins them where there are steps between, or
    more than two. Mass is on the right where all densities are equal,
    else in a panel of its own; it is left out without densities.

    Parameters
    ----------
    result : Result
        What to draw.

    Returns
    -------
    Figure
        The picture.

    Raises
    ------
    CaseError
        If there is no save.
    """
    number_of_saves(result)
    bodies = [result.body(name) for name in result.body_names]
    history, saves = result.table("history"), result.table("saves")
    worn = [b for b in bodies if np.any(history[_volume(b.name)] > 0)] or bodies
    densities = {body.density for body in worn}
    weighed = [body for body in worn if body.density is not None]
    common = densities.pop() if len(densities) == 1 else None
    rows = 2 if weighed and common is None else 1
    unit = time_unit(result.times)
    with house_style():
        figure = new_figure(50.0 * rows + 12.0)
        panels = figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0]
        strokes = dict(zip((body.name for body in bodies), BODY_STROKES, strict=True))
        factors: list[Mapping[str, float]] = [{body.name: MM3 for body in worn}]
        if rows == 2:
            factors.append({b.name: MG * b.density for b in weighed if b.density is not None})
        curves: list[Line2D] = []
        for axes, factor in zip(panels, factors, strict=True):
            drawn = [
                _draw_body(axes, history, saves, unit.factor, name, scale, strokes[name])
                for name, scale in factor.items()
            ]
            curves = curves or drawn
            _from_zero(axes)
            # Volumes may need a power of ten; everything else has a fitting unit.
            axes.ticklabel_format(axis="y", useMathText=True)
        panels[0].set_ylabel("Volume worn (mm³)")
        if rows == 2:
            panels[1].set_ylabel("Mass worn (mg)")
        elif common is not None:
            to_mass = common * MG / MM3
            right = panels[0].secondary_yaxis(
                "right", functions=(lambda v: v * to_mass, lambda m: m / to_mass)
            )
            right.ticklabel_format(axis="y", useMathText=True)
            right.set_ylabel("Mass worn (mg)")
            right.yaxis.set_major_locator(ticks(6))
        panels[-1].set_xlabel(f"Time ({unit.name})")
        legend_below(figure, curves)
    return figure


def contact_history(result: Result) -> Figure:
    """Draw the largest and central pressure and both half-widths against time.

    A half-width is known to a cell, so that it grows in steps; the line goes
    through their middles.

    Parameters
    ----------
    result : Result
        What to draw.

    Returns
    -------
    Figure
        The picture.

    Raises
    ------
    CaseError
        If there is no save.
    """
    number_of_saves(result)
    history, unit = result.table("history"), time_unit(result.times)
    time = unit.of(history["time_s"])
    largest, centre = history["max_pressure_Pa"], history["centre_pressure_Pa"]
    widths = [history["contact_half_width_x_m"], history["contact_half_width_y_m"]]
    spacing = result.grid.spacing
    stress = pressure_unit(float(np.max(largest)))
    length = length_unit(float(np.max(widths)))
    marker = "o" if len(time) == 1 else ""
    with house_style():
        figure = new_figure(88.0)
        upper, lower = figure.subplots(2, 1, sharex=True)
        _draw_pair(
            upper,
            (
                (LARGEST, time, stress.of(largest), "largest"),
                (CENTRE, time, stress.of(centre), "centre"),
            ),
            marker,
        )
        upper.set_ylabel(f"Pressure ({stress.name})")
        _fit_scale(upper, largest, centre)
        (t_along, along), (t_across, across) = (
            _through_steps(time, width, cell) for width, cell in zip(widths, spacing, strict=True)
        )
        _draw_pair(
            lower,
            (
                (ALONG, t_along, length.of(along), "along sliding"),
                (ACROSS, t_across, length.of(across), "across sliding"),
            ),
            marker,
        )
        lower.set_title(f"± 1 cell, {_cells(spacing)}", loc="right", fontsize=7.0)
        lower.set_ylabel(f"Contact half-width ({length.name})")
        _fit_scale(lower, *widths)
        lower.set_xlim(left=0.0)
        lower.set_xlabel(f"Time ({unit.name})")
    return figure


def _volume(body: str) -> str:
    return f"bodies.{body}.wear_volume_m3"


def _draw_body(
    axes: Axes,
    history: Mapping[str, Array],
    saves: Mapping[str, Array],
    per_second: float,
    name: str,
    scale: float,
    stroke: Stroke,
) -> Line2D:
    """Draw every step as a line with its saves marked."""
    time = history["time_s"]
    if len(time) <= 2:
        # A line between two points would claim that nothing else happened.
        stroke = replace(stroke, dashes="none")
    return stroke.draw(
        axes,
        per_second * time,
        scale * history[_volume(name)],
        name,
        clip_on=False,
        markevery=list(np.flatnonzero(np.isin(time, saves["time_s"]))),
        markerfacecolor="white",
    )


def _draw_pair(axes: Axes, curves: Sequence[tuple[Stroke, Array, Array, str]], marker: str) -> None:
    for stroke, time, values, label in curves:
        stroke.draw(axes, time, values, label, **({"marker": marker} if marker else {}))
    axes.legend(loc="best")


def _through_steps(time: Array, width: Array, cell: float) -> tuple[Array, Array]:
    """Return a line through a width that grows in steps, nowhere more than a cell from it.

    A plateau between steps of a cell is left with its middle; larger steps stay
    as they are.
    """
    steps = np.diff(width)
    ends = np.append(np.flatnonzero(steps), len(width) - 1)
    starts = np.append(0, ends[:-1] + 1)
    small = np.concatenate(([False], np.abs(steps[ends[:-1]]) < 1.5 * cell, [False]))
    middle = small[:-1] & small[1:]
    times = np.where(middle, 0.5 * (time[starts] + time[ends]), time[starts])
    last = ~middle & (ends > starts)
    order = np.argsort(np.append(times, time[ends[last]]), kind="stable")
    return (
        np.append(times, time[ends[last]])[order],
        np.append(width[starts], width[ends[last]])[order],
    )


def _cells(spacing: tuple[float, float]) -> str:
    """Say how large a cell is."""
    unit = height_unit(max(spacing))
    sizes = [f"{unit.factor * size:.3g}" for size in spacing]
    return f"{' × '.join(dict.fromkeys(sizes))} {unit.name}"


def _from_zero(axes: Axes) -> None:
    axes.set_ylim(bottom=0.0)
    axes.yaxis.set_major_locator(ticks(6))
    axes.set_xlim(left=0.0)


def _fit_scale(axes: Axes, *curves: Array) -> None:
    """Take a logarithmic scale where values span more than a decade, else one from zero."""
    values = np.concatenate(curves)
    values = values[values > 0]
    span = float(np.max(values) / np.min(values)) if values.size else 1.0
    if span <= _DECADE:
        _from_zero(axes)
        return
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(
        LogLocator(subs=(1.0, 2.0, 5.0) if span < _DECADE**2.5 else (1.0,))
    )
    axes.yaxis.set_major_formatter(ScalarFormatter())
    axes.yaxis.set_minor_formatter(NullFormatter())
