"""What check foresees is what the run then does."""

import re

import pytest
from paper_models import K, archard, half_space, pair, small

from tribo import CaseError, Effect, Field, Grid, NumericalError, Simulation
from tribo.simulation.predict import predict
from tribo.stepping import plastic_groove
from tribo.stepping.explicit import Explicit


def bodies(k=K, hardness=None):
    return pair(archard(k), archard(k), (hardness, hardness))


def only_problem(model):
    (problem,) = predict(model).problems
    return problem


def number(pattern, text):
    return float(re.search(pattern, text)[1])


def test_a_sound_case_has_no_problems():
    assert predict(small()).problems == ()


def test_a_window_that_the_contact_outgrows_is_foreseen_with_the_time():
    model = small(grid=Grid((0.5e-3, 0.5e-3), (48, 48)))
    problem = only_problem(model)
    assert (problem.kind, problem.place) == ("window", "grid.size")
    with pytest.raises(NumericalError) as stopped:
        Simulation(model.case).run()
    actual = number(r"at ([\d.]+) s", str(stopped.value))
    # The contact grows as the fourth root of time: a coarse cell of 2 % shifts it by some 10 %.
    assert problem.value == pytest.approx(actual, rel=0.3)


def test_a_body_that_ends_at_the_window_cannot_outgrow_it():
    model = small(grid=Grid((0.5e-3, 0.5e-3), (48, 48)), ends_at_window=True)
    assert predict(model).problems == ()


def test_few_cells_are_counted():
    problem = only_problem(small(grid=Grid((0.7e-3, 0.7e-3), (14, 14))))
    assert (problem.kind, problem.place) == ("resolution", "grid.cells")
    assert (problem.value, problem.limit) == (6, 8)


def test_the_largest_stable_step_is_the_one_the_run_takes():
    def model(time_step):
        stepping = Explicit(type="explicit", time_step=time_step)
        return small(stepping=stepping)

    with pytest.raises(CaseError) as refused:
        predict(model(50))
    largest = number(r"largest stable step is ([\d.]+) s", str(refused.value))
    for made in (predict, lambda model: Simulation(model.case).run()):
        with pytest.raises(CaseError, match="stability limit"):
            made(model(1.01 * largest))
    assert predict(model(0.99 * largest)).problems == ()


def test_a_groove_that_does_not_settle_is_foreseen(monkeypatch):
    monkeypatch.setattr(plastic_groove, "SETTLE_PASSES", 1)
    model = small(bodies=bodies(hardness=1.5e9), contact=half_space())
    with pytest.raises(NumericalError, match="still yields"):
        predict(model)
    monkeypatch.undo()
    assert predict(model).problems == ()


def test_a_trial_that_fails_on_coarse_cells_is_told_and_does_not_stop_the_run(monkeypatch):
    def fails(*given):
        raise NumericalError("too coarse")

    monkeypatch.setattr("tribo.simulation.predict.march", fails)
    found = predict(small())
    (problem,) = found.problems
    assert problem.kind == "trial"
    assert problem.words.endswith(": too coarse")
    assert found.exit_code == 0


class Asks(Effect):
    """Asks for what only the law of one body remembers, from some path on."""

    type = "test.asks"
    provides = (Field("asked", "1", "Nothing but 0."),)

    def fields(self, contact):
        if contact.distance > 0:
            raise CaseError("no law of 'disk' remembers it", "bodies.disk.wear")
        return {"asked": dict.fromkeys(contact.materials, 0.0)}


def test_a_case_refused_on_its_way_ends_check_as_it_ends_the_run():
    model = small(effects=[Asks()])
    with pytest.raises(CaseError) as stopped:
        Simulation(model.case).run()
    found = predict(model)
    assert found.exit_code == stopped.value.exit_code == 2
    (problem,) = found.problems
    assert problem.kind == "trial"
    assert problem.words.endswith(str(stopped.value))


def test_a_softer_body_that_is_not_known_has_no_onset_of_yield():
    known = [
        predict(small(bodies=pair(archard(K), archard(K), hardness))).hertz.load_ratio
        for hardness in ((4e9, 4e9), (4e9, None))
    ]
    assert known == [pytest.approx(0.84, abs=0.01), None]
