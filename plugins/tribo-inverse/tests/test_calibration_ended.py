"""A calibration of runs that an observer ends."""

import pytest
from test_calibration_runs import BALL, BALL_K, BALL_LOSS, CASE, DISTANCE, fitting
from tribo import Finding, Observer, hookimpl
from tribo.registry.plugins import given
from tribo.registry.registry import default_registry

from tribo_inverse import calibrate


class Ends(Observer):
    """Ends the run after half of its path."""

    type = "test.ends"

    def findings(self, snapshot):
        return [Finding("stop", "far enough")] * (snapshot.state.distance > DISTANCE / 2)


class Offers:
    """What a package offers."""

    @hookimpl
    def tribo_components(self):
        return [Ends]


@pytest.fixture
def offered():
    """Let the package take part as if it were installed."""
    default_registry.cache_clear()
    default_registry().add(given(Offers()))
    yield
    default_registry.cache_clear()


@pytest.mark.usefixtures("offered")
def test_an_observer_that_ends_the_run_ends_those_of_a_calibration():
    case = {**CASE, "observers": [{"type": "test.ends"}, {"type": "progress"}]}
    found = calibrate(case, {"measured": [BALL_LOSS], "fit": fitting(BALL_K)})
    assert found.parameters["value"][0] == pytest.approx(2 * BALL, rel=1e-3, abs=0)
