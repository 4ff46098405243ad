"""The checks of tribo that every motion and every effect has to pass."""

from tribo.testing import parametrize_checks

from tribo_fretting.motion import Fretting
from tribo_fretting.partial_slip import PartialSlip

test_motion = parametrize_checks(Fretting)
test_partial_slip = parametrize_checks(
    PartialSlip, [{"amplitude": "10 um", "direction": "free", "stiffness": "200 N/um"}]
)
