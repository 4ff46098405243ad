import numpy as np
import pytest

from tribo.core.errors import CaseError
from tribo.core.fields import LocalConditions
from tribo.core.material import Material
from tribo.wear.archard import Archard
from tribo.wear.power import Power

STEEL = Material(young="207 GPa", poisson=0.3, hardness="4 GPa")
PRESSURE = np.linspace(0, 3e9, 12).reshape(3, 4)


def at(pressure, material=STEEL):
    return LocalConditions(pressure=pressure, speed=0.1, material=material)


def test_archard_is_depth_k_p_s():
    rate = Archard(k="3.11e-16 1/Pa").rate(at(PRESSURE))
    np.testing.assert_allclose(rate.depth_rate, 3.11e-16 * PRESSURE)


def test_archard_takes_k_as_coefficient_over_hardness():
    from_material = Archard(K=1.244e-6).rate(at(PRESSURE))
    np.testing.assert_allclose(from_material.depth_rate, 3.11e-16 * PRESSURE)
    own = Archard(K=1.244e-6, hardness="2 GPa").rate(at(PRESSURE))
    np.testing.assert_allclose(own.depth_rate, 2 * from_material.depth_rate)


def test_archard_needs_a_hardness_for_the_coefficient():
    soft = Material(young="207 GPa", poisson=0.3)
    with pytest.raises(CaseError, match="K needs a hardness"):
        Archard(K=1e-6).check(soft)


@pytest.mark.parametrize("given", [{}, {"k": 1e-15, "K": 1e-6}])
def test_archard_takes_one_coefficient(given):
    with pytest.raises(CaseError, match="exactly one of k"):
        Archard(**given)


def test_power_of_one_is_archard():
    power = Power(k="3.11e-16 1/Pa", p_exponent=1, reference_pressure="1 GPa")
    np.testing.assert_allclose(power.rate(at(PRESSURE)).depth_rate, 3.11e-16 * PRESSURE)
