"""What the laws that follow the temperature refuse, and where the hardness ends."""

import numpy as np
import pytest
from tribo import CaseError, LocalConditions, Material

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.softening import Softening


@pytest.mark.parametrize("energy", ["50 kJ", "50 kPa/mol", "50 kJ/mol K", -1.0])
def test_an_energy_is_per_mole(energy):
    with pytest.raises(CaseError, match=r"per mole|is a pressure|at least 0"):
        Arrhenius(k=3e-16, activation_energy=energy, reference_temperature="90 degC")


def test_hardness_is_needed_and_falls_to_a_tenth_at_most():
    law = Softening(K=1.2e-6, softening="0.001 1/K", reference_temperature=300.0)
    soft = Material(young="207 GPa", poisson=0.3)
    with pytest.raises(CaseError, match="hardness is needed"):
        law.check(soft)
    law = law.model_copy(update={"hardness": 4e9})
    law.check(soft)
    fields = {"temperature": np.full((1, 1), 3000.0)}
    rate = law.rate(LocalConditions(np.full((1, 1), 1e8), 0.1, soft, fields))
    assert rate.depth_rate[0, 0] == pytest.approx(1.2e-6 * 1e8 / 0.4e9, rel=1e-9, abs=0)
