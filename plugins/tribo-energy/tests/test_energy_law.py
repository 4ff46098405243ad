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


def test_friction_traction_is_mu_p_on_both_bodies():
    answer = traction(PRESSURE)["friction_traction"]
    np.testing.assert_allclose(answer["ball"], 0.1 * PRESSURE)
    np.testing.assert_array_equal(answer["ball"], answer["disk"])


def test_depth_is_alpha_times_the_energy_of_a_metre():
    answer = rate(PRESSURE)
    np.testing.assert_allclose(answer.depth_rate, 3.11e-15 * MU * PRESSURE)
    np.testing.assert_allclose(answer.state_rates["dissipated_energy"], MU * PRESSURE)


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


def test_nothing_wears_below_the_threshold_traction():
    depth = rate(PRESSURE, threshold_traction="120 MPa").depth_rate
    assert np.all(depth[PRESSURE <= 1.2e9] == 0)
    np.testing.assert_allclose(
        depth[PRESSURE > 1.2e9], 3.11e-15 * (MU * PRESSURE[PRESSURE > 1.2e9] - 120e6)
    )


def test_the_onset_of_wear_costs_exactly_the_threshold_energy():
    # Integrated over the energy of a point, depth/α is ΣE − E_th once the onset is over.
    threshold, pressure = 1e9, np.full((1, 1), 1e9)
    energy = np.linspace(0, 3e9, 3001)
    per_energy = [
        rate(pressure, e, threshold_energy=threshold).depth_rate[0, 0] / (3.11e-15 * MU * 1e9)
        for e in energy
    ]
    assert per_energy[0] == 0
    assert np.trapezoid(per_energy, energy) == pytest.approx(2e9, rel=1e-9)
