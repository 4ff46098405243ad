"""The checks of tribo that every wear law and every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_thermal.arrhenius import Arrhenius
from tribo_thermal.flash import Flash
from tribo_thermal.softening import Softening

test_flash = parametrize_checks(Flash)
test_flash_by_body = parametrize_checks(
    Flash,
    [
        {"ambient": 363.0, "heat_paths": {"ball": {"length": "5 mm", "area": "78 mm^2"}}},
        {"ambient": 363.0, "heat_fraction": {"ball": 0.7, "disk": 0.3}},
    ],
)
test_flash_in_time = parametrize_checks(
    Flash,
    [
        {
            "ambient": 363.0,
            "heat_paths": {"ball": {"length": "5 mm", "area": "78 mm^2", "capacity": "4 J/K"}},
        }
    ],
)
test_arrhenius = parametrize_checks(Arrhenius)
test_softening = parametrize_checks(Softening)
