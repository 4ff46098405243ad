"""The checks of tribo that every wear law has to pass."""

from tribo.testing import parametrize_checks

from tribo_roughening.detachment import Detachment

test_detachment = parametrize_checks(
    Detachment,
    configs=[
        {"k": 1e-16, "diameter": "10 um", "thickness": "0.5 um"},
        {"k": 1e-16, "diameter": 1e-5, "thickness": 5e-7, "spread": 1, "period": 1e-4, "seed": 3},
    ],
)
