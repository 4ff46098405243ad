"""A wear law of one's own: nothing wears below a threshold pressure.

The script runs a case in Python; ``tribo run my.toml --plugin own_law.py`` adds the law to a file::

    python examples/own_law.py
"""

from typing import Annotated

import numpy as np

from tribo import Body, Case, Grid, LocalConditions, Material, Quantity, WearLaw, WearRate


class Threshold(WearLaw):
    """dh/ds = k max(p - p_min, 0)."""

    examples = ({"k": 1e-15, "p_min": "1 GPa"},)
    k: Annotated[float, Quantity("1/Pa", at_least=0)]
    """Specific wear rate above the threshold."""
    p_min: Annotated[float, Quantity("Pa", at_least=0)]
    """Pressure below which nothing wears."""

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the depth per metre of sliding, and its derivative in pressure."""
        excess = np.maximum(local.pressure - self.p_min, 0.0)
        return WearRate(self.k * excess, self.k * (excess > 0))


if __name__ == "__main__":
    steel = Material(young="207 GPa", poisson=0.3)
    law = Threshold(k=3.11e-16, p_min="150 MPa")
    case = Case(
        grid=Grid(size="0.8 mm", cells=48),
        load="20 N",
        bodies={
            "pin": Body(surface={"type": "sphere", "radius": "5 mm"}, material=steel, wear=law),
            "disk": Body(surface="flat", material=steel),
        },
        kinematics={"type": "unidirectional", "speed": 0.1, "distance": 200, "track_length": 0.1},
    )
    case.run().show()
