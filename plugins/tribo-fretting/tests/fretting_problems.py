"""A ball on a flat under a load, and how it is dragged."""

from typing import NamedTuple

import numpy as np
from tribo import Array, ContactProblem, ContactSystem, DcFft, Grid, Material

from tribo_fretting.cerruti import cerruti, tangential_compliances
from tribo_fretting.closed_forms import tangential_compliance
from tribo_fretting.projected_cg import Drag, dragged

LOAD, MU, RADIUS = 100.0, 0.6, 10e-3
K = 1e-15
STEEL = {"young": "207 GPa", "poisson": 0.3}


class Ball(NamedTuple):
    """A ball of 10 mm on a like flat, after its normal contact."""

    grid: Grid
    problem: ContactProblem
    pressure: Array
    contact_radius: float
    materials: tuple[Material, Material]

    @property
    def compliance(self) -> float:
        return tangential_compliance(self.materials)

    def dragged(self, displacement, mu=MU, components=1) -> Drag:
        compliances = tangential_compliances(self.materials)
        operator = cerruti(self.grid.cells, self.grid.spacing, compliances, components)
        return dragged(operator, displacement, mu * self.pressure)

    def force(self, drag):
        return drag.traction[0].sum() * self.grid.cell_area

    def energy(self, drag):
        size = np.hypot.reduce(drag.traction)
        return 4 * np.sum(size * drag.slip) * self.grid.cell_area


def ball(cells, poisson=0.3) -> Ball:
    material = Material(young=207e9, poisson=poisson)
    modulus = 0.5 * material.young / (1 - poisson**2)
    contact_radius = (3 * LOAD * RADIUS / (4 * modulus)) ** (1 / 3)
    grid = Grid(3 * contact_radius, cells)
    x, y = grid.mesh
    problem = ContactProblem(ContactSystem(grid, modulus, LOAD), (x**2 + y**2) / (2 * RADIUS), LOAD)
    pressure = DcFft(tolerance=1e-11).solve(problem).pressure
    return Ball(grid, problem, pressure, contact_radius, (material, material))


def case(cells=24, amplitude="2.2 um", k=K, **changes):
    """A ball of 10 mm on a flat, 100 N, for 1e5 cycles."""
    motion = {"type": "fretting.motion", "amplitude": amplitude, "frequency": "20 Hz"}
    motion |= {"cycles": 1e5} | changes.pop("motion", {})
    law = changes.pop("law", {"type": "archard", "k": k})
    return {
        "grid": {"size": changes.pop("size", "0.5 mm"), "cells": cells},
        "load": {"normal": LOAD},
        "friction": {"coefficient": MU},
        "bodies": {
            "ball": {
                "surface": {"type": "sphere", "radius": "10 mm"},
                "material": STEEL,
                "wear": law,
            },
            "flat": {"surface": {"type": "flat"}, "material": STEEL},
        },
        "kinematics": motion,
        **changes,
    }
