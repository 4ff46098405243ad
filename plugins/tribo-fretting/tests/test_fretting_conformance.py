"""The checks of tribo that every motion and every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_fretting.motion import Fretting
from tribo_fretting.partial_slip import PartialSlip

STAGES = [{"until": "1 hour", "amplitude": "3 um"}, {"until": "2 hour", "amplitude": "5 um"}]

test_motion = parametrize_checks(
    Fretting,
    [
        {"amplitude": "3 um", "frequency": "20 Hz", "cycles": 1e5},
        {"amplitude": STAGES, "frequency": "20 Hz", "duration": "2 hour"},
    ],
)
test_partial_slip = parametrize_checks(
    PartialSlip, [{"amplitude": "10 um", "direction": "free", "stiffness": "200 N/um"}]
)
