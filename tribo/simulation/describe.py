"""The configuration of a model as plain data, in the shape of a case."""

from __future__ import annotations

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
                "surface": body.surface.config.model_dump(mode="json"),
                "material": body.material.model_dump(mode="json"),
                "wear": None if body.wear is None else body.wear.config.model_dump(mode="json"),
            }
            for body in model.bodies
        },
        "contact": model.contact.config.model_dump(mode="json"),
        "kinematics": model.kinematics.config.model_dump(mode="json"),
        "stepping": model.stepping.model_dump(mode="json"),
        "friction": None
        if model.friction_coefficient is None
        else {"coefficient": model.friction_coefficient},
        "effects": [effect.config.model_dump(mode="json") for effect in model.effects],
        "observers": [observer.config.model_dump(mode="json") for observer in model.observers],
        "output": {"save_times": list(model.save_times)},
        "stop": model.stop.model_dump(mode="json"),
    }
