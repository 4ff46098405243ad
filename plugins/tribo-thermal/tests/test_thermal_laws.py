"""Rates of the laws that follow the temperature, without a run."""

import numpy as np
import pytest
from tribo import CaseError, LocalConditions, Material

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.softening import Softening

STEEL = Material(young="207 GPa", poisson=0.3, hardness="4 GPa")
PRESSURE = np.array([[0.0, 1e8, 2e9]])


def coefficient(law, temperature, material=STEEL):
    """Depth per metre and pascal, after a check that it is the derivative too."""
    fields = {"temperature": np.full_like(PRESSURE, temperature)}
    rate = law.rate(LocalConditions(PRESSURE, 0.1, material, fields))
    np.testing.assert_allclose(rate.depth_rate, rate.depth_slope * PRESSURE)
    return rate.depth_slope[0, 0]


def arrhenius(energy="50 kJ/mol"):
    return Arrhenius(k=3e-16, activation_energy=energy, reference_temperature="90 degC")


def softening(**config):
    given = {"K": 1.2e-6, "softening": "0.001 1/K", "reference_temperature": 300.0, **config}
    return Softening(**given)


@pytest.mark.parametrize("energy", ["50 kJ", "50 kPa/mol", "50 kJ/mol K", -1.0])
def test_an_energy_is_per_mole(energy):
    with pytest.raises(CaseError, match=r"per mole|is a pressure|at least 0"):
        arrhenius(energy)


@pytest.mark.parametrize(
    ("temperature", "part"), [(300.0, 1.0), (800.0, 0.5), (1200.0, 0.1), (3000.0, 0.1)]
)
def test_hardness_falls_linearly_to_its_floor(temperature, part):
    assert coefficient(softening(), temperature) == pytest.approx(
        1.2e-6 / (4e9 * part), rel=1e-6, abs=0
    )


def test_softening_needs_a_hardness():
    soft = Material(young="207 GPa", poisson=0.3)
    with pytest.raises(CaseError, match="hardness is needed"):
        softening().check(soft)
    softening(hardness="2 GPa").check(soft)
