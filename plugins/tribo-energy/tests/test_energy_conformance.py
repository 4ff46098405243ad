"""The checks of tribo that every wear law and every effect has to pass."""

from tribo.testing import example_configs, parametrize_checks

from tribo_energy.dissipation import Dissipation
from tribo_energy.traction import FrictionTraction

# The checks vary the pressure and hold the fields, so to them the traction has no slope.
HELD = {"friction_traction": 1e8, "friction_traction_slope": 0.0}
plain, *with_thresholds = example_configs(Dissipation)

test_plain = parametrize_checks(
    Dissipation,
    [plain],
    fields=HELD,
    expected_failures={
        "runs_under_implicit_stepping": "a traction that is held jumps where contact begins, so "
        "steps have no solution; test_energy_run.py runs it with one that follows the pressure"
    },
)
test_with_thresholds = parametrize_checks(Dissipation, with_thresholds, fields=HELD)
test_friction_traction = parametrize_checks(FrictionTraction, example_configs(FrictionTraction))
