"""Rates of the energy law and its friction traction, without a run."""

import numpy as np
import pytest
from tribo import ContactConditions, ContactSystem, Grid, LocalConditions, Material

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction

MU = 0.1
STEEL = Material(young="207 GPa", poisson=0.3)
PRESSURE = np.linspace(0, 3e9, 12).reshape(3, 4)


def traction(pressure):
    friction = np.full_like(pressure, MU)
    contact = ContactConditions(
        system=ContactSystem(
            Grid((1e-3, 1e-3), pressure.shape), 1e11, 10.0, materials={"ball": STEEL, "disk": STEEL}
        ),
        pressure=pressure,
        speed=0.1,
        time=1.0,
        distance=0.1,
        swept=frozenset({"disk"}),
        fields={"friction_coefficient": {"ball": friction, "disk": friction}},
    )
    return FrictionTraction().fields(contact)


def rate(pressure, energy=0.0, **config):
    fields = {name: bodies["ball"] for name, bodies in traction(pressure).items()}
    law = Dissipation(**{"alpha": "3.11e-6 mm^3/J", **config})
    state = {"dissipated_energy": np.full_like(pressure, energy)}
    return law.rate(LocalConditions(pressure, 0.1, STEEL, fields, state))


CONFIGS = [
    {},
    {"threshold_traction": "120 MPa"},
    {"threshold_energy": "1 GJ/m^2"},
    {"threshold_energy": "1 GJ/m^2", "threshold_traction": "120 MPa"},
]


@pytest.mark.parametrize("config", CONFIGS)
@pytest.mark.parametrize("energy", [0.0, 1.005e9, 2e9])
def test_derivative_is_that_of_depth_through_the_traction(config, energy):
    # Rates are piecewise linear in pressure, so differences are exact but for rounding.
    # Nudged, so that no pressure sits on a threshold.
    pressure, step = PRESSURE + 2e6, 1e6
    up, down = rate(pressure + step, energy, **config), rate(pressure - step, energy, **config)
    np.testing.assert_allclose(
        rate(pressure, energy, **config).depth_slope,
        (up.depth_rate - down.depth_rate) / (2 * step),
        rtol=1e-9,
        atol=1e-9 * 3.11e-16,
    )
