"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tribo import Array, CaseTemplate, Column, Component, Result, hookimpl

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction

EXAMPLE = Path(__file__).with_name("ball_on_disk.toml")


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer wear by dissipated energy, and the friction traction."""
    return (Dissipation, FrictionTraction)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer the paper's test, worn by dissipated energy."""
    summary = "The paper's test, worn by dissipated energy."
    return [CaseTemplate("energy.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]


def dissipated(result: Result) -> Array:
    """Return the energy dissipated by each step of the run, in J; NaN where there is none."""
    energy = result.table("history")["friction_energy_J"]
    return np.where(energy[-1] > 0, energy, np.nan)


def volume_per_energy(result: Result) -> float:
    """Return the volume that both bodies lost for each J, in m³/J."""
    volume = sum(body["wear_volume_m3"] for body in result.saves()[-1]["bodies"].values())
    return float(volume / dissipated(result)[-1])


@hookimpl
def tribo_quantities() -> list[Column]:
    """Offer the energy dissipated in all, and the volume lost for it."""
    per = "worn volume per dissipated energy"
    return [
        Column("dissipated_energy", "J", "dissipated energy", lambda each: dissipated(each)[-1]),
        Column("worn_volume_per_energy", "m^3/J", per, volume_per_energy),
    ]


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the worn volumes over the dissipated energy."""
    energy = dissipated(result)
    if np.isnan(energy[-1]):
        return {}

    def draw() -> Figure:
        figure = Figure(figsize=(3.35, 2.5))
        axes = figure.add_subplot(xlabel="Dissipated energy (J)", ylabel="Worn volume (mm³)")
        history = result.table("history")
        # Bodies that wear alike both show: a narrow dashed line over a wide one.
        for name, look, width in zip(result.body_names, ("-", "--"), (2.4, 1.1), strict=True):
            volume = 1e9 * history[f"bodies.{name}.wear_volume_m3"]
            axes.plot(energy, volume, look, linewidth=width, label=name)
        axes.legend()
        return figure

    return {"worn_volume_over_energy": draw}
