"""Pictures of what changes with time: wear, pressure, the size of the contact, fields of models."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

from tribo.core.arrays import Array
from tribo.plotting.kept import kept_fields, steady
from tribo.plotting.style import OVER, UNDER, Look, house_style, legend_below, new_figure, ticks
from tribo.plotting.units import height_unit, shown_in, size, time_unit
from tribo.result.read import Result

BODIES: tuple[Look, Look] = (
    {**UNDER, "marker": "o", "markersize": 7.0},
    {**OVER, "marker": "s", "markersize": 3.0},
)
LARGEST: Look = {**UNDER, "color": "#e69f00"}
AT_SAVES: Look = {"linestyle": ":", "linewidth": 0.8, "clip_on": False}
"""Joins values that are known at the saves only."""
_DECADE = 10.0
"""Values that span more than this factor are drawn on a logarithmic scale."""

Curves = Mapping[str, tuple[Array, Array]]
"""Times and values, in SI units, by label."""


def wear_history(result: Result) -> Figure:
    """Draw the volume and the mass that each body has lost against time.

    Markers are the saves; a line joins them where there are steps between, or
    more than two. Mass has a panel of its own; it is left out without densities.
    """
    history, unit = result.table("history"), time_unit(result.times)
    time = history["time_s"]
    looks = dict(zip(result.body_names, BODIES, strict=True))
    volumes = {name: history[f"bodies.{name}.wear_volume_m3"] for name in looks}
    worn = [name for name in looks if np.any(volumes[name] > 0)] or list(looks)
    densities = {name: result.body(name).density for name in worn}
    masses = {name: volumes[name] * d for name, d in densities.items() if d is not None}
    drawn = [("Volume worn", "mm³", {name: volumes[name] for name in worn})]
    if masses:
        drawn.append(("Mass worn", "mg", masses))
    marked: dict[str, object] = {
        "markevery": list(np.flatnonzero(np.isin(time, result.times))),
        "markerfacecolor": "white",
        "clip_on": False,
    }
    if len(time) <= 2:
        # A line between two points would claim that nothing else happened.
        marked["linestyle"] = "none"
    curves: list[Line2D] = []
    with house_style():
        figure = new_figure(50.0 * len(drawn) + 5.0)
        panels = figure.subplots(len(drawn), 1, sharex=True, squeeze=False)[:, 0]
        for axes, (what, lost, values) in zip(panels, drawn, strict=True):
            for name, value in values.items():
                look = {**looks[name], **marked, "label": name.lstrip("_")}
                curves += axes.plot(time / size(unit), value / size(lost), **look)
            axes.set_ylabel(f"{what} ({lost})")
            _from_zero(axes)
        panels[-1].set_xlabel(f"Time ({unit})")
        legend_below(figure, curves[: len(worn)])
    return figure


def contact_history(result: Result) -> Figure:
    """Draw the largest and central pressure and both half-widths, to a cell, against time."""
    history, spacing = with_rests(result), result.grid.spacing
    time = history["time_s"]
    pressures = {
        label: (time, history[f"{name}_pressure_Pa"])
        for label, name in (("largest", "max"), ("centre", "centre"))
    }
    widths = {
        f"{label} sliding": (time, history[f"contact_half_width_{axis}_m"])
        for axis, label in zip("xy", ("along", "across"), strict=True)
    }
    figure = _over_time(
        result,
        ("Pressure", "Pa", pressures, (LARGEST, OVER)),
        ("Contact half-width", "m", widths),
    )
    unit = height_unit(max(spacing))
    cells = dict.fromkeys(f"{cell / size(unit):.3g}" for cell in spacing)
    figure.axes[1].set_title(f"± 1 cell, {' × '.join(cells)} {unit}", loc="right", fontsize=7.0)
    return figure


def with_rests(result: Result) -> dict[str, Array]:
    """Return the history with a row more where each step of a rest begins, and where it ends.

    A row has the load and the friction force of the step before it. A line from row to row would
    creep all along a rest, a long step, to what the load is from its first moment on; only a load
    that goes in straight lines does so.
    """
    history = result.table("history")
    stages = (result.case_tables.get("load") or {}).get("normal")
    straight = isinstance(stages, list | tuple) and any(stage.get("at") for stage in stages)
    resting = np.diff(history["distance_m"]) == 0
    starts = np.flatnonzero(resting | np.append(False, resting)[:-1])
    rows = {"time_s": starts, "friction_force_N": starts + 1}
    later = starts + (resting[starts] & (not straight))
    return {
        name: np.insert(column, starts + 1, column[rows.get(name, later)])
        for name, column in history.items()
    }


def friction_history(result: Result) -> Figure:
    """Draw the friction force and its work against time."""
    history, looks = with_rests(result), [{"color": OVER["color"]}]
    force, work = (
        {"": (history["time_s"], history[name])}
        for name in ("friction_force_N", "friction_energy_J")
    )
    return _over_time(
        result,
        ("Friction force", "N", force, looks, _from_zero),
        ("Work of friction", "J", work, looks, _from_zero),
    )


def real_contact(result: Result) -> Figure:
    """Draw the real contact area against time, and the part of it at the hardness."""
    history = result.table("history")
    areas = {"all": history["contact_area_m2"], "at the hardness": history["plastic_area_m2"]}
    curves = {label: (history["time_s"], area) for label, area in areas.items() if np.any(area > 0)}
    return _over_time(result, ("Real contact area", "m^2", curves, (UNDER, OVER), _from_zero))


def roughness_history(result: Result) -> Figure:
    """Draw the root mean square height Sq of rough bodies within the contact against time."""
    history = result.table("history")
    labels = {name: f"bodies.{name}.Sq_m" for name in result.body_names}
    curves = {
        name: (history["time_s"], history[label])
        for name, label in labels.items()
        if label in history
    }
    return _over_time(result, ("Sq in the contact", "m", curves))


def fields_history(result: Result) -> Figure:
    """Draw what the effects provide and what models keep against time, a panel for each.

    Of a field it is the largest value and the mean in the contact, with a mark at each save.
    """
    looks = [
        {**look, **AT_SAVES, "marker": mark, "markersize": size}
        for look, mark, size in ((LARGEST, "o", 6.0), (OVER, "s", 3.0))
    ]
    panels = []
    for field in kept_fields(result):
        values = field.over_time(result).items()
        curves = {label: (result.times, each) for label, each in values}
        panels.append((field.name.capitalize(), field.unit, curves, looks, _around))
    figure = _over_time(result, *panels)
    figure.axes[0].set_title("at the saves; not known between", loc="right", fontsize=7.0)
    return figure


def _over_time(result: Result, *panels: tuple[Any, ...]) -> Figure:
    """Draw panels below each other, each of what `_draw` takes of it."""
    with house_style():
        figure = new_figure(12.0 + 40.0 * len(panels))
        rows = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axes, panel in zip(rows, panels, strict=True):
            _draw(axes, result, *panel)
            axes.label_outer()
    return figure


def _draw(
    axes: Axes,
    result: Result,
    what: str,
    unit: str,
    curves: Curves,
    looks: Sequence[Look] = (UNDER, OVER),
    scale: Callable[[Axes, Array], None] | None = None,
) -> None:
    """Draw curves over time, in a fitting unit where `unit` is of SI."""
    every = np.concatenate([values for _, values in curves.values()])
    shown, factor = shown_in(unit, every)
    time = time_unit(result.times)
    for (label, (x, values)), look in zip(curves.items(), looks, strict=False):
        style = {"marker": "o" if len(x) == 1 else "none", **look}
        axes.plot(x / size(time), values / factor, label=label, **style)
    axes.set_ylabel(f"{what} ({shown})" if shown else what)
    axes.set_xlabel(f"Time ({time})")
    axes.set_xlim(left=0.0)
    if len(curves) > 1 or next(iter(curves)):
        axes.legend(loc="best")
    (scale or _fit_scale)(axes, every)


def _from_zero(axes: Axes, _: Array | None = None) -> None:
    axes.set_ylim(bottom=0.0)
    axes.yaxis.set_major_locator(ticks(6))
    axes.ticklabel_format(axis="y", useMathText=True)
    axes.set_xlim(left=0.0)


def _around(axes: Axes, values: Array) -> None:
    """Take a scale with zero but for values that vary far from it, as a temperature."""
    low = float(np.min(values))
    if steady(values):
        # The limits of matplotlib would show rounding.
        axes.update_datalim([(0.0, 0.0)])
        axes.autoscale_view()
    if low >= 0 and (steady(values) or low < 0.5 * np.max(values)):
        _from_zero(axes)


def _fit_scale(axes: Axes, values: Array) -> None:
    """Take a logarithmic scale where values span more than a decade, else one from zero."""
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
