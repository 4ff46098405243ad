"""What this package offers to tribo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from tribo import Array, CaseTemplate, Column, Component, Result, hookimpl

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.flash import TEMPERATURE, Flash
from tribo_thermal.softening import Softening

EXAMPLE = Path(__file__).with_name("ball_on_disk.toml")


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer the contact temperature, and Archard's law with what follows it."""
    return (Flash, Arrhenius, Softening)


@hookimpl
def tribo_templates() -> list[CaseTemplate]:
    """Offer the paper's test in its warm bath, with wear that follows the temperature."""
    summary = "The paper's test, with wear that follows the temperature of the contact."
    return [CaseTemplate("thermal.ball_on_disk", summary, EXAMPLE.read_text(encoding="utf-8"))]


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer cases of the contact temperature."""
    return (Path(__file__).with_name("cases"),)


def temperatures(result: Result) -> dict[str, Array]:
    """Return the highest temperature of each body at each save, in K; empty without `Flash`."""
    kept = {name: result.body(name).effects.get(TEMPERATURE.name) for name in result.body_names}
    return {
        name: at.max(axis=(1, 2)) for name, at in kept.items() if at is not None and len(at) > 1
    }


def highest(result: Result, body: str) -> float:
    """Return the highest temperature of a body at any save, in K; NaN without `Flash`."""
    return float(np.max(temperatures(result).get(body, np.nan)))


@hookimpl
def tribo_quantities() -> list[Column]:
    """Offer the highest temperature of each body at any save."""
    meaning = "highest contact temperature"
    return [Column("highest_temperature", "K", meaning, highest, of_bodies=True)]


@hookimpl
def tribo_figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Offer the temperature of each body over time."""
    found = temperatures(result)

    def draw() -> Figure:
        figure = Figure(figsize=(3.35, 2.5))
        axes = figure.add_subplot(xlabel="Time (s)", ylabel="Temperature in the contact (K)")
        axes.set_title("at the saves; not known between", loc="right", fontsize=7)
        # The marks of the second lie within the first's where both are as hot.
        for (name, at), look, size in zip(found.items(), ("o:", "s:"), (6, 3), strict=True):
            axes.plot(result.times, at, look, markersize=size, linewidth=0.8, label=name)
        axes.legend()
        return figure

    return {"contact_temperature": draw} if found else {}
