"""A law, an effect with a state on each body, and a motion of one's own, in one script.

Each is checked as a package's would be, then all serve in one case. Takes about twenty seconds::

    python examples/own_models.py
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated

import numpy as np

from tribo import (
    Array,
    Case,
    ContactConditions,
    Effect,
    Exposure,
    Field,
    Grid,
    Kinematics,
    LocalConditions,
    Passing,
    Position,
    Quantity,
    Stationary,
    WearLaw,
    WearRate,
)
from tribo.testing import check

FILM = Field("film", "m", "Thickness of the film.", at_least=0, typical=2e-8)


class Shielded(WearLaw):
    """dh/ds = k p/(1 + h/h₀): a film of thickness h shields the metal below."""

    type = "own.shielded"
    requires = (FILM,)
    k: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-15
    """Specific wear rate of the bare metal."""
    depth: Annotated[float, Quantity("m", above=0)] = 2e-8
    """Thickness h₀ of a film that halves it."""

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the depth per metre, and its slope in the pressure."""
        slope = self.k / (1 + local.fields["film"] / self.depth)
        return WearRate(slope * local.pressure, slope)


class Film(Effect):
    """dh/ds = growth p (1 − h/limit) − loss h: pressure makes it, sliding takes it off."""

    type = "own.film"
    reach = "point"
    state_fields = (FILM,)
    on: str = "ball"
    """The body that it lies on."""
    growth: Annotated[float, Quantity("1/Pa", at_least=0)] = 4e-16
    """Thickness per metre and pressure that comes on bare metal."""
    limit: Annotated[float, Quantity("m", above=0)] = 5e-8
    """Thickness at which no more comes."""
    loss: Annotated[float, Quantity("1/m", at_least=0)] = 2.0
    """Part of it that goes per metre, where there is pressure."""

    def carrier(self) -> str:
        """Return the body whose surface carries it."""
        return self.on

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        """Return by how much it grows per second."""
        film, pressed = contact.state["film"], contact.pressure > 0
        grown = self.growth * contact.pressure * (1 - film / self.limit)
        return {"film": contact.speed * (grown - self.loss * film * pressed)}


class Rosette(Kinematics):
    """Round a rosette of three leaves, r = R cos 3φ, at one speed; the last body moves."""

    type = "own.rosette"
    radius: Annotated[float, Quantity("m", above=0)] = 2e-4
    """Length R of a leaf."""
    speed: Annotated[float, Quantity("m/s", above=0)] = 0.02
    """Sliding speed."""
    duration: Annotated[float, Quantity("s", above=0)] = 10.0
    """How long it slides."""
    positions: int = 49
    """In how many places of the path the contact is solved, an odd number."""

    @property
    def end_time(self) -> float:
        """Time at which the motion ends, in s."""
        return self.duration

    def distance_at(self, time: float) -> float:
        """Return the sliding distance at a time, in m."""
        return self.speed * time

    def places(self) -> Array:
        """Return the ends of as many stretches of the path as there are positions, in m."""
        turn = np.linspace(-0.5 * math.pi, 0.5 * math.pi, self.positions + 1)
        return self.radius * np.cos(3 * turn)[:, None] * np.array([np.cos(turn), np.sin(turn)]).T

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the part of the path at each position, and the way that it goes there."""
        steps = np.diff(self.places(), axis=0)
        lengths = np.hypot(*steps.T)
        ways, shares = steps / lengths[:, None], lengths / np.sum(lengths)
        return [Position(s, heading=(x, y)) for s, (x, y) in zip(shares, ways, strict=True)]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return where the window lies on the last body at each position."""
        ends = self.places()
        cells = np.round(0.5 * (ends[1:] + ends[:-1]) / grid.spacing).astype(int)
        along, across = (cells[self.positions // 2] - cells).T
        beyond = 0 if grid.period is not None else np.max(np.abs(along))
        path = float(np.sum(np.hypot(*np.diff(ends, axis=0).T)))
        moved = Passing(grid, (along + beyond).tolist(), path, across.tolist())
        return {bodies[0]: Stationary(grid), bodies[1]: moved}


STEEL = {"young": "210 GPa", "poisson": 0.3}
CASE = {
    "grid": {"size": ["0.7 mm", "1 mm"], "cells": [42, 60]},
    "load": {"normal": "10 N"},
    "bodies": {
        "ball": {"surface": {"type": "sphere", "radius": "5 mm"}, "material": STEEL},
        "plate": {"surface": "flat", "material": STEEL},
    },
    "contact": {"plasticity": False},
}


def case() -> Case:
    """Return the case: each body has its film, and the state of both has one name."""
    bodies = {name: {**body, "wear": Shielded()} for name, body in CASE["bodies"].items()}
    effects = (Film(on="ball"), Film(on="plate"))
    return Case(**{**CASE, "bodies": bodies, "kinematics": Rosette(), "effects": effects})


def main() -> None:
    """Check the models, and run the case."""
    for model in (Shielded, Film, Rosette):
        print(check(model))
    result = case().run()
    result.show()
    for body in ("ball", "plate"):
        film = 1e9 * result.field("film", len(result.times) - 1, body)
        print(f"film on the {body}: {film.min():.1f} to {film.max():.1f} nm")


if __name__ == "__main__":
    main()
