"""Fields that are required with their scale."""

from typing import Annotated

import numpy as np

from tribo.core.fields import Field, WearRate
from tribo.core.units import Quantity
from tribo.testing.kit import names_of, outcome_of, suites
from tribo.wear.law import WearLaw

FILM = Field("zddp_film", "m", "Thickness of a film of ZDDP.", at_least=0, typical=5e-8)


class Protected(WearLaw):
    """A law of a film some 50 nm thick, which nothing here provides."""

    type = "test.protected"
    requires = (FILM,)
    k: Annotated[float, Quantity("1/Pa", above=0)] = 1e-16
    """Rate without a film."""
    thickness: Annotated[float, Quantity("m", above=0)] = 5e-8
    """Film that takes the wear to 1/e."""

    def rate(self, local):
        k = self.k * np.exp(-local.fields["zddp_film"] / self.thickness)
        return WearRate(k * local.pressure, k)


def test_the_kit_tries_a_law_at_the_scale_that_it_requires():
    (checks,) = suites(Protected, [{}], {})
    outcomes = {name: outcome_of(checks, name) for name in names_of(type(checks))}
    assert not [name for name, outcome in outcomes.items() if outcome.status == "failed"]
    assert outcomes["required_fields_matter"].status == "passed"
