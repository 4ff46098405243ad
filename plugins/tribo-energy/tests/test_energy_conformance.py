"""The checks of tribo that every wear law and every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction

# The checks let the traction follow the pressure, as its slope says.
test_dissipation = parametrize_checks(Dissipation)
test_friction_traction = parametrize_checks(FrictionTraction)
