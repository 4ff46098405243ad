"""The checks of tribo that every wear law has to pass."""

from tribo.testing import parametrize_checks

from tribo_roughening.detachment import Detachment

# The cells of the checks are 0.04 mm long.
test_detachment = parametrize_checks(
    Detachment,
    configs=[
        *Detachment.examples,
        {"k": 1e-16, "diameter": 2e-4, "thickness": 5e-7, "spread": 1, "period": 2e-4, "seed": 3},
    ],
)
