"""The checks of tribo that every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_film.mixed import Mixed

test_mixed = parametrize_checks(Mixed)
