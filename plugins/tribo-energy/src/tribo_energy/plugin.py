"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tribo import Array, CaseTemplate, Component, LabRow, Result, hookimpl

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
    summary = "the paper's test, worn by dissipated energy"
    return [CaseTemplate("energy.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]


def dissipated(result: Result) -> Array | None:
    """Return the energy dissipated by each step of the run, in J; None without friction."""
    energy = result.table("history")["friction_energy_J"]
    return None if np.isnan(energy).all() else energy


@hookimpl
def tribo_lab_rows(result: Result) -> list[LabRow]:
    """Offer the energy dissipated in all, and the volume lost for it."""
    energy = dissipated(result)
    if energy is None or not energy[-1] > 0:
        return []
    volume = sum(body["wear_volume_m3"] for body in result.saves()[-1]["bodies"].values())
    return [
        LabRow("dissipated energy", float(energy[-1]), "J"),
        LabRow("worn volume per dissipated energy", 1e9 * volume / float(energy[-1]), "mm³/J"),
    ]


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the worn volumes over the dissipated energy."""
    energy = dissipated(result)
    if energy is None or not energy[-1] > 0:
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
