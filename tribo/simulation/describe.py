"""The configuration of a model as plain data, in the shape of a case."""

from __future__ import annotations

from typing import Any

from tribo.interfaces.component import Component
from tribo.simulation.calling import calling
from tribo.simulation.model import Model


def describe(model: Model) -> dict[str, object]:
    """Return the case that `model` amounts to, in SI units, ready for JSON.

    A model composed from a case gives that case back, with its defaults
    filled in; one made from objects gives the case that would make it.
    """
    return {
        "requires": list(model.requires),
        "grid": {
            "size": list(model.grid.size),
            "cells": list(model.grid.cells),
            "ends_at_window": model.ends_at_window,
        },
        "load": {"normal": model.load},
        "bodies": {
            body.name: {
                "surface": _dump(body.surface, body.name),
                "material": body.material.model_dump(mode="json"),
                "wear": None if body.wear is None else _dump(body.wear, body.name),
            }
            for body in model.bodies
        },
        "contact": _dump(model.contact),
        "kinematics": _dump(model.kinematics),
        "stepping": model.stepping.model_dump(mode="json"),
        "friction": None
        if model.friction_coefficient is None
        else {"coefficient": model.friction_coefficient},
        "effects": [_dump(effect) for effect in model.effects],
        "observers": [_dump(observer) for observer in model.observers],
        "output": {"save_times": list(model.save_times)},
        "stop": model.stop.model_dump(mode="json"),
    }


def _dump(component: Component, body: str | None = None) -> dict[str, Any]:
    with calling(component, body):
        return component.model_dump(mode="json")
