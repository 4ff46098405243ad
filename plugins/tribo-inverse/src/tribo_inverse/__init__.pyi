from tribo_inverse.adjoint.gradient import Gradient as Gradient
from tribo_inverse.adjoint.gradient import gradient as gradient
from tribo_inverse.adjoint.objective import Deepest as Deepest
from tribo_inverse.adjoint.objective import Depth as Depth
from tribo_inverse.adjoint.objective import EndTime as EndTime
from tribo_inverse.adjoint.objective import Pressure as Pressure
from tribo_inverse.adjoint.objective import Volume as Volume
from tribo_inverse.adjoint.unknowns import value_and_gradient as value_and_gradient
from tribo_inverse.adjoint.view import Seeds as Seeds
from tribo_inverse.adjoint.view import View as View
from tribo_inverse.calibration.calibrate import Calibration as Calibration
from tribo_inverse.calibration.calibrate import calibrate as calibrate
from tribo_inverse.calibration.choice import Choice as Choice
from tribo_inverse.calibration.choice import choose_case as choose_case
from tribo_inverse.calibration.plan import Plan as Plan
from tribo_inverse.calibration.plan import plan_tests as plan_tests
from tribo_inverse.fitted import fit_picture as fit_picture

__all__: list[str]
