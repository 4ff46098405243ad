"""How hot the contact of a result was."""

from __future__ import annotations

from collections.abc import Callable

from matplotlib.figure import Figure
from tribo import Array, LabRow, Result, hookimpl

from tribo_thermal.flash import TEMPERATURE


def temperatures(result: Result) -> dict[str, Array]:
    """Return the highest temperature of each body at each save, in °C; empty without `Flash`."""
    kept = {name: result.body(name).effects.get(TEMPERATURE.name) for name in result.body_names}
    return {
        name: at.max(axis=(1, 2)) - 273.15
        for name, at in kept.items()
        if at is not None and len(at) > 1
    }


@hookimpl
def tribo_lab_rows(result: Result) -> list[LabRow]:
    """Offer the highest temperature of each body at any save."""
    return [
        LabRow(f"highest temperature of {name} in the contact", float(at.max()), "°C")
        for name, at in temperatures(result).items()
    ]


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the temperature of each body over time."""
    found = temperatures(result)

    def draw() -> Figure:
        figure = Figure(figsize=(3.35, 2.5), layout="constrained")
        axes = figure.add_subplot(xlabel="Time, s", ylabel="Temperature in the contact, °C")
        for name, at in found.items():
            axes.plot(result.times, at, marker=".", label=name)
        axes.legend()
        return figure

    return {"contact_temperature": draw} if found else {}
