"""The checks of tribo that every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_film.mixed import EXAMPLE, Mixed

test_mixed = parametrize_checks(Mixed)
test_mixed_by_interpolation = parametrize_checks(
    Mixed, [{**EXAMPLE, "roughness": "0.2 um", "sharing": "olver_spikes"}]
)
