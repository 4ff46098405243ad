"""The checks of tribo that every wear law and every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction

# The checks let the traction follow the pressure, as its slope says.
# A wide onset, since runs follow each point through it.
LATE = {"threshold_traction": "50 MPa", "threshold_energy": "600 MJ/m^2", "threshold_spread": 2}
test_dissipation = parametrize_checks(
    Dissipation, [{"alpha": "3.11e-6 mm^3/J"}, {"alpha": "3.11e-6 mm^3/J", **LATE}]
)
test_friction_traction = parametrize_checks(FrictionTraction)
