"""The paper's hour, ball and disk both wearing, against the rigid limit."""

from __future__ import annotations

import tomllib
from typing import Any

from tribo.closed_forms.ball_on_track import ball_on_track
from tribo.simulation.march import begin, march
from tribo.simulation.measure import measure
from tribo.simulation.run import Simulation
from tribo.templates import template
from tribo.verification.check import Check, Found, Quantity
from tribo.verification.problems import LOAD, RADIUS, WEAR_COEFFICIENT


def _paper(cells: int, placement: float) -> Found:
    case: dict[str, Any] = tomllib.loads(template("ball_on_disk"))
    case["grid"] |= {"size": "1.4 mm", "cells": cells}
    case["output"] = {}
    model = Simulation(case).model
    state = begin(model)
    for accepted in march(model, state):
        state = accepted.state
    end = measure(model, state)
    exact = ball_on_track(
        end.distance,
        load=LOAD,
        radius=RADIUS,
        track_length=2e-3,
        ball_wear_coefficient=WEAR_COEFFICIENT,
        flat_wear_coefficient=WEAR_COEFFICIENT,
    )
    ball, disk = end.bodies["ball"], end.bodies["disk"]
    return {
        "depth of the ball": (float(exact.ball_depth[0]), ball.centre_wear_depth),
        "depth of the disk": (float(exact.flat_depth[0]), disk.max_wear_depth),
        "half-width along": (float(exact.half_width_along[0]), end.half_width_x),
        "half-width across": (float(exact.half_width_across[0]), end.half_width_y),
        "pressure at the centre": (float(exact.centre_pressure[0]), end.centre_pressure),
        "volume of the ball": (float(exact.ball_volume[0]), ball.wear_volume),
        "volume of the disk": (float(exact.flat_volume[0]), disk.wear_volume),
    }


ELASTIC = "the bodies are elastic; 0.6 % by an independent elastic run"
CHECKS = (
    Check(
        "the paper's hour, ball and disk",
        "rigid limit: tribo.closed_forms.ball_on_track",
        _paper,
        (
            Quantity("depth of the ball", "m", 1e-2, note=ELASTIC),
            Quantity("depth of the disk", "m", 1e-2, note=ELASTIC),
            Quantity("half-width along", "m", 3e-2, note="counted: half a cell is 1.5 %"),
            Quantity("half-width across", "m", 3e-2, note="counted: half a cell is 1.5 %"),
            Quantity("pressure at the centre", "Pa", 2e-2, note=ELASTIC),
            Quantity("volume of the ball", "m^3", 1e-10, note="V = kFs, exact"),
            Quantity("volume of the disk", "m^3", 1e-10, note="V = kFs, exact"),
        ),
        levels=(96,),
        cost=4.0,
    ),
)
