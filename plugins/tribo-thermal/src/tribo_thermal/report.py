"""How hot the contact of a result was."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure
from tribo import Array, ContactConditions, LabRow, Material, Result

from tribo_thermal.flash import TEMPERATURE, Flash


def temperatures(result: Result) -> dict[str, Array]:
    """Return the temperature of each body in the contact at each save, in K.

    The speed at a save is the mean since the save before. Empty where the
    case has no `Flash`, or nothing slid.
    """
    case = result.case
    effects = case.get("effects", ())
    asked = [effect for effect in effects if effect["type"] == "thermal.flash"]
    if not asked or len(result.times) < 2:
        return {}
    flash = Flash.model_validate(asked[0])
    friction = np.full((1, 1), float(case["friction"]["coefficient"]))
    materials = {name: Material(**body["material"]) for name, body in case["bodies"].items()}
    speeds = np.diff(result.distances) / np.diff(result.times)
    found = [
        flash.fields(
            ContactConditions(
                grid=result.grid,
                pressure=result.pressure(save),
                speed=float(speeds[max(save - 1, 0)]),
                time=float(result.times[save]),
                distance=float(result.distances[save]),
                friction_coefficient=float(friction[0, 0]),
                materials=materials,
                swept=frozenset(name for name in materials if result.body(name).swept),
                fields={"friction_coefficient": dict.fromkeys(materials, friction)},
            )
        )[TEMPERATURE.name]
        for save in range(len(result.times))
    ]
    return {name: np.array([float(at[name].max()) for at in found]) for name in materials}


def lab_rows(result: Result) -> list[LabRow]:
    """Return the highest temperature of each body at any save."""
    return [
        LabRow(f"highest temperature of {name} in the contact", float(at.max()) - 273.15, "°C")
        for name, at in temperatures(result).items()
    ]


def figures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Return how to draw the temperature of each body over time."""
    found = temperatures(result)

    def draw() -> Figure:
        figure = Figure(figsize=(3.35, 2.5), layout="constrained")
        axes = figure.add_subplot(xlabel="Time, s", ylabel="Temperature in the contact, °C")
        for name, at in found.items():
            axes.plot(result.times, at - 273.15, marker=".", label=name)
        axes.legend()
        return figure

    return {"contact_temperature": draw} if found else {}
