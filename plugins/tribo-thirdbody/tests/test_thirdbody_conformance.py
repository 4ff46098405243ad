"""The checks of tribo that every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_thirdbody.debris import Debris

test_debris = parametrize_checks(
    Debris,
    [{"ejection_length": "0.5 m", "cover": "1 um", "fills": fills} for fills in (False, True)],
)
