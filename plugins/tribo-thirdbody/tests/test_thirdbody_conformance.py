"""The checks of tribo that every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_thirdbody.debris import Debris

test_debris = parametrize_checks(Debris)
