"""Pictures of what changes with time: wear, the contact, friction."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from tribo.core.arrays import Array
from tribo.core.rounding import ROUND_OFF
from tribo.lab.kept import steady
from tribo.lab.units import shown_in, size, time_unit
from tribo.plotting.picture import Picture
from tribo.plotting.style import OVER, UNDER, Look, ticks
from tribo.result.read import Result

BODIES: tuple[Look, Look] = (
    {**UNDER, "marker": "o", "markersize": 7.0},
    {**OVER, "marker": "s", "markersize": 3.0},
)
LARGEST: Look = {**UNDER, "color": "#e69f00"}


@dataclass(frozen=True)
class TimePanel:
    """Times and values by label, in SI units; `off` is the half-width of a band around each."""

    what: str
    unit: str
    curves: Mapping[str, tuple[Array, Array]]
    looks: Sequence[Look] = (UNDER, OVER)
    off: Mapping[str, float] | None = None
    title: str = ""

    def draw(self, result: Result, axes: Axes, top: bool = False) -> Sequence[Artist]:
        """Draw the curves in a fitting unit; the panel at the `top` has the distance slid."""
        every = np.concatenate([values for _, values in self.curves.values()])
        shown, factor = shown_in(self.unit, every)
        time, off = time_unit(result.times), self.off or {}
        for (label, (x, values)), look in zip(self.curves.items(), self.looks, strict=False):
            axes.plot(x / size(time), values / factor, label=label.lstrip("_"), **look)
            if label in off:
                band = (values - off[label]) / factor, (values + off[label]) / factor
                axes.fill_between(x / size(time), *band, color=look["color"], alpha=0.2, lw=0.0)
        axes.set_ylabel(f"{self.what} ({shown})" if shown else self.what)
        axes.set_xlabel(f"Time ({time})")
        axes.set_xlim(left=0.0)
        if len(self.curves) > 1 or next(iter(self.curves)):
            axes.legend(loc="best")
        axes.set_ylim(bottom=0.0)
        axes.yaxis.set_major_locator(ticks(6))
        axes.ticklabel_format(axis="y", useMathText=True)
        if top:
            _distance_axis(axes, result, size(time))
        axes.set_title(self.title, loc="right", fontsize="small")
        return ()


def _distance_axis(axes: Axes, result: Result, unit: float) -> None:
    """Put the distance slid above the time where the speed is constant."""
    history = result.table("history")
    time, distance = history["time_s"], history["distance_m"]
    speed = distance[-1] / time[-1] if time[-1] > 0 else 0.0
    if speed > 0 and np.allclose(distance, speed * time, rtol=0.0, atol=ROUND_OFF * distance[-1]):
        per = speed * unit
        above = axes.secondary_xaxis(
            "top", functions=(partial(np.multiply, per), partial(np.multiply, 1.0 / per))
        )
        above.set_xlabel("Distance (m)")


def history(result: Result, name: str) -> Picture:
    """Draw what changes with time, a panel below another: one of `HISTORIES`."""
    panels = HISTORIES[name](result)
    rows = [[partial(panel.draw, result, top=panel is panels[0])] for panel in panels]
    return Picture(rows, 40.0 + 16.0 / len(rows))


def history_names(result: Result) -> list[str]:
    """Return the names of the histories that say something of a result."""
    return [name for name, panels in HISTORIES.items() if panels(result)]


def _wear(result: Result) -> list[TimePanel]:
    table = result.table("history")
    time = table["time_s"]
    looks = dict(zip(result.body_names, BODIES, strict=True))
    lost = {name: (time, table[f"bodies.{name}.wear_volume_m3"]) for name in looks}
    worn = {name: curve for name, curve in lost.items() if np.any(curve[1] > 0)}
    if not worn:
        return []
    marks: dict[str, object] = {
        "markevery": list(np.flatnonzero(np.isin(time, result.times))),
        "markerfacecolor": "white",
        "clip_on": False,
    }
    if len(time) <= 2:
        # A line between two points would claim that nothing else happened.
        marks["linestyle"] = "none"
    return [TimePanel("Volume worn", "m^3", worn, [{**looks[name], **marks} for name in worn])]


def _contact(result: Result) -> list[TimePanel]:
    table = result.table("history")
    if len(table["time_s"]) < 2:
        return []
    pressures = {"largest": "max_pressure_Pa", "centre": "centre_pressure_Pa"}
    widths = {"along sliding": "contact_half_width_x_m", "across sliding": "contact_half_width_y_m"}
    areas = {"all": "contact_area_m2", "at the hardness": "plastic_area_m2"}
    if not np.any(table["plastic_area_m2"] > 0):
        areas = {"": "contact_area_m2"}
    both = _columns(table, "Contact width", "m", widths, factor=2.0)
    cells = dict(zip(widths, result.grid.spacing, strict=True))
    return [
        _columns(table, "Pressure", "Pa", pressures, (LARGEST, OVER)),
        replace(both, off=cells, title="band: ± 1 cell"),
        _columns(table, "Contact area", "m^2", areas, (UNDER, OVER)),
    ]


def _friction(result: Result) -> list[TimePanel]:
    table, looks = result.table("history"), [{"color": OVER["color"]}]
    force = table["friction_force_N"]
    if len(force) < 2 or not np.isfinite(force).all() or steady(force):
        return []
    return [
        _columns(table, "Friction force", "N", {"": "friction_force_N"}, looks),
        _columns(table, "Work of friction", "J", {"": "friction_energy_J"}, looks),
    ]


def _columns(
    table: Mapping[str, Array],
    what: str,
    unit: str,
    names: Mapping[str, str],
    looks: Sequence[Look] = (UNDER, OVER),
    factor: float = 1.0,
) -> TimePanel:
    curves = {label: (table["time_s"], factor * table[name]) for label, name in names.items()}
    return TimePanel(what, unit, curves, looks)


HISTORIES: Mapping[str, Callable[[Result], list[TimePanel]]] = {
    "wear": _wear,
    "contact": _contact,
    "friction": _friction,
}
"""The panels of each history by its name; none where it says nothing."""
