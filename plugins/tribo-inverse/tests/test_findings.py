"""What is to be known of a case before it runs."""

from typing import Annotated

import pytest
from paper_models import small
from tribo.core.units import Quantity
from tribo.effects.effect import Effect

from tribo_inverse.adjoint.sensitivity import Sensitivity, of_case


class Bath(Effect):
    """Has a temperature, and does nothing."""

    type = "test.bath"
    ambient: Annotated[float, Quantity("K", above=0)] = 300.0

    def fields(self, contact):
        return {}


def test_the_sensitivity_to_a_temperature_is_that_to_one_kelvin(monkeypatch):
    percent = {"effects.1.ambient": 3.0, "load.normal": 1.0}
    found = Sensitivity(
        "ball", "depth", percent, dict.fromkeys(percent, 0.3), percent, ((24, 24),) * 2
    )
    monkeypatch.setattr("tribo_inverse.adjoint.sensitivity.sensitivity", lambda *given: found)
    bath, load = of_case(small(effects=[Bath()]), 1e-4)
    # A per cent of 300 K is 3 K.
    assert (bath.value, bath.uncertainty) == pytest.approx((1.0, 0.1))
    assert (load.value, load.uncertainty) == (1.0, 0.3)
    assert "volume +1.00 %" in bath.words


def test_influences_below_the_error_of_the_grids_are_named_alone(monkeypatch):
    percent = {"load.normal": 1.0, "bodies.ball.wear.k": 0.2}
    found = Sensitivity(
        "ball", "depth", percent, dict.fromkeys(percent, 0.3), percent, ((24, 24),) * 2
    )
    monkeypatch.setattr("tribo_inverse.adjoint.sensitivity.sensitivity", lambda *given: found)
    load, left_out = of_case(small(), 1e-4)
    assert (load.place, left_out.value) == ("load.normal", None)
    assert left_out.words.endswith("bodies.ball.wear.k")
