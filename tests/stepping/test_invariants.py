"""What must hold at every step: that a run keeps it, and stops where a part does not."""

from dataclasses import replace

import numpy as np
import pytest
from paper_models import K, archard, flat, last, named, small, sphere, states, steel

from tribo import Result, Simulation
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.core.errors import CaseError, NumericalError
from tribo.core.grid import Grid
from tribo.core.rounding import SAME
from tribo.result.summary import worst
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.stepping.invariants import hold
from tribo.surfaces.surface import Surface


class Rough(Surface):
    """White noise of 1 µm, down to single cells, on a ball or on nothing."""

    type = "test.rough"
    radius: float = np.inf

    def height(self, grid):
        x, y = grid.mesh
        noise = np.random.default_rng(1).normal(scale=1e-6, size=grid.cells)
        return noise - (x**2 + y**2) / (2 * self.radius)


def one_body(surface=None, law=None, **changes):
    ball = named("ball", surface or sphere(), steel(), law or archard())
    return small(bodies=[ball, named("disk", flat(), steel())], **changes)


def time_step(factor):
    """A part of the largest stable one of `one_body`."""
    model = one_body()
    return factor * 2 * 0.58069 * model.grid.spacing[0] / (K * model.contact.system.modulus) / 0.1


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"stepping": Implicit(pressure_tolerance=1.0, depth_tolerance=0.1)},
        {"stepping": Explicit(time_step=0.9 * time_step(1.0))},
        {"contact": Periodic(), "load": 500.0, "surface": Rough()},
        {"surface": Rough(radius=5e-3), "grid": Grid((1.2e-3, 1.2e-3), (64, 64))},
        {"surface": Rough(radius=5e-3), "stepping": Explicit(time_step=0.9 * time_step(1.0))},
    ],
    ids=["ball", "long steps", "explicit", "periodic", "rough ball", "rough, explicit"],
)
def test_nothing_is_held_against_a_sound_run(changes):
    held = [state.invariants for state in states(one_body(**changes))]
    assert len(held) > 5
    assert max(each.regrowth for each in held) == 0
    assert max(each.volume for each in held) < 1e-3 * SAME


def test_explicit_steps_need_a_solver_that_states_its_stability():
    class Silent(DcFft):
        def smallest_compliance(self, system):
            return None

    model = one_body(contact=Silent(), stepping=Explicit(time_step=time_step(0.5)))
    with pytest.raises(CaseError, match=r"smallest compliance.*implicit"):
        last(model)


@pytest.mark.parametrize(
    ("exposure", "words"),
    [
        (lambda e: setattr(e, "volume", lambda depth: 0.99 * type(e).volume(e, depth)), "0.01"),
        (lambda e: setattr(e, "volume", lambda depth: np.nan), "nan of it"),
        (
            lambda e: setattr(e, "average", lambda rate: rate - 0.01 * rate.max()),
            "grows back by",
        ),
        (lambda e: setattr(e, "average", lambda r: 1.01 * r), "wear volume is off"),
    ],
    ids=["volume", "nan", "regrowth", "average"],
)
def test_a_motion_that_miscounts_wear_stops_the_run(exposure, words):
    model = one_body()
    exposure(model.cycle.maps["ball"])
    with pytest.raises(NumericalError, match=rf"^step 1, at .*{words}.*; .*kinematics"):
        last(model)


@pytest.mark.parametrize("what", ["complementarity", "penetration"])
def test_a_solver_that_owns_to_a_poor_contact_stops_the_run(what, tmp_path):
    class Sloppy(DcFft):
        _calls: int = 0

        def solve(self, problem, start=None):
            self._calls += 1
            solution = super().solve(problem, start)
            poor = replace(solution.residuals, **{what: 0.05})
            return solution if self._calls < 6 else replace(solution, residuals=poor)

    simulation = Simulation(one_body(contact=Sloppy()))
    path = tmp_path / "run.h5"
    with pytest.raises(NumericalError, match=r"^step 3, at .*0\.05, and 0\.01 is allowed; .*toler"):
        simulation.run(path)
    with Result.open(path) as result:
        assert result.status == "failed"
        assert len(result.table("history")["time_s"]) == 3


def test_the_load_balance_is_measured_and_not_taken_on_trust():
    class Boasts(DcFft):
        def solve(self, problem, start=None):
            solution = super().solve(problem, start)
            best = replace(solution.residuals, force=0.0)
            return replace(solution, pressure=(1 + 3e-7) * solution.pressure, residuals=best)

    result = Simulation(one_body(contact=Boasts())).run()
    assert worst(result)["force_error"] == pytest.approx(3e-7, rel=1e-3)


def test_a_depth_that_is_not_finite_stops_the_run():
    before, after = states(one_body())[:2]
    ball = after.bodies["ball"]
    lost = replace(ball, plastic=np.full_like(ball.plastic, np.inf))
    with pytest.raises(NumericalError, match=r"^step 1, .* plastic depth of ball is not finite"):
        hold(before, replace(after, bodies={**after.bodies, "ball": lost}))
